// SPDX-License-Identifier: BSD-3-Clause
#include "Output/RunStatistics.h"

#include "vtkDataObject.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"
#include "vtkTable.h"
#include "vtkTypeUInt64Array.h"

namespace tipp
{
namespace
{

template <typename Array, typename Values>
vtkSmartPointer<Array> makeArray(const std::string& name, const Values& values)
{
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name.c_str());
  for (const auto& value : values)
  {
    array->InsertNextValue(value);
  }
  return array;
}

vtkSmartPointer<vtkAbstractArray> arrayOf(const Figures& figures)
{
  return std::visit(
    [&](const auto& values) -> vtkSmartPointer<vtkAbstractArray>
    {
      using Value = typename std::decay_t<decltype(values)>::value_type;
      if constexpr (std::is_same_v<Value, std::string>)
      {
        return makeArray<vtkStringArray>(figures.Array, values);
      }
      else if constexpr (std::is_same_v<Value, double>)
      {
        return makeArray<vtkDoubleArray>(figures.Array, values);
      }
      else if constexpr (std::is_same_v<Value, std::uint64_t>)
      {
        return makeArray<vtkTypeUInt64Array>(figures.Array, values);
      }
      else
      {
        return makeArray<vtkIdTypeArray>(figures.Array, values);
      }
    },
    figures.Values);
}

} // namespace

void fillStatisticsTable(const RunStatistics& statistics, vtkTable* table)
{
  vtkFieldData* const totals = table->GetFieldData();
  const auto add = [&](const Figures& figures, bool isColumn)
  {
    if (figures.Array.empty())
    {
      return;
    }
    const vtkSmartPointer<vtkAbstractArray> array = arrayOf(figures);
    isColumn ? table->AddColumn(array) : void(totals->AddArray(array));
  };
  for (const Figures& total : statistics.Totals)
  {
    add(total, false);
  }
  for (const FigureList& list : statistics.Lists)
  {
    for (const Figures& column : list.Columns)
    {
      add(column, list.IsTable);
    }
  }
}

void addDuplicatesAndRejected(const std::vector<Duplicate>& duplicates,
  const std::vector<PointId>& rejected, vtkDataObject* output)
{
  std::vector<PointId> points;
  std::vector<PointId> representatives;
  for (const Duplicate& duplicate : duplicates)
  {
    points.push_back(duplicate.Point);
    representatives.push_back(duplicate.Representative);
  }
  vtkFieldData* const data = output->GetFieldData();
  data->AddArray(makeArray<vtkIdTypeArray>("DuplicatePointIds", points));
  data->AddArray(makeArray<vtkIdTypeArray>("DuplicateRepresentativeIds", representatives));
  data->AddArray(makeArray<vtkIdTypeArray>("RejectedPointIds", rejected));
}

} // namespace tipp
