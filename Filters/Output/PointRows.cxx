// SPDX-License-Identifier: BSD-3-Clause
#include "Output/PointRows.h"

#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"

#include <algorithm>
#include <cstring>

namespace tipp
{
namespace
{

std::vector<PointRows::Column> columnsOf(vtkPointSet* input)
{
  std::vector<PointRows::Column> columns;
  vtkPointData* data = input->GetPointData();
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = data->GetArray(i);
    const bool isOwn = array && array != data->GetGlobalIds() && array->GetName() &&
      std::string(array->GetName()) != vtkDataSetAttributes::GhostArrayName();
    if (isOwn && array->GetDataTypeSize() > 0)
    {
      const int components = array->GetNumberOfComponents();
      columns.push_back({ array->GetName(), array->GetDataType(), components,
        std::size_t(components) * std::size_t(array->GetDataTypeSize()) });
    }
  }
  return columns;
}

void write(const std::vector<PointRows::Column>& columns, ByteWriter& writer)
{
  writer.value(std::uint64_t(columns.size()));
  for (const PointRows::Column& column : columns)
  {
    writer.text(column.Name);
    writer.value(column.Type);
    writer.value(column.Components);
    writer.value(std::uint64_t(column.Size));
  }
}

std::vector<PointRows::Column> readColumns(ByteReader& reader)
{
  std::vector<PointRows::Column> columns;
  for (std::uint64_t n = reader.value<std::uint64_t>(); n > 0; --n)
  {
    PointRows::Column column;
    column.Name = reader.text();
    column.Type = reader.value<int>();
    column.Components = reader.value<int>();
    column.Size = reader.value<std::uint64_t>();
    columns.push_back(column);
  }
  return columns;
}

bool same(const PointRows::Column& a, const PointRows::Column& b)
{
  return a.Name == b.Name && a.Type == b.Type && a.Components == b.Components;
}

} // namespace

PointRows::PointRows(Communicator& ranks, vtkPointSet* input)
{
  const bool hasPoints = input->GetNumberOfPoints() > 0;
  vtkDataArray* ids = hasPoints ? input->GetPointData()->GetGlobalIds() : nullptr;
  ByteWriter writer;
  writer.value(char(hasPoints));
  writer.value(char(ids != nullptr));
  writer.value(char(hasPoints && input->GetPoints()->GetDataType() != VTK_FLOAT));
  write(hasPoints ? columnsOf(input) : std::vector<Column>(), writer);
  ByteWriter agreed;
  bool first = true;
  bool allIds = true;
  bool anyDoubles = false;
  std::vector<Column> common;
  for (const Bytes& bytes : ranks.gather(writer.take()))
  {
    ByteReader reader(bytes);
    if (!reader.value<char>())
    {
      continue;
    }
    allIds = reader.value<char>() && allIds;
    anyDoubles = reader.value<char>() || anyDoubles;
    const std::vector<Column> columns = readColumns(reader);
    common.erase(std::remove_if(common.begin(), common.end(),
                   [&](const Column& column)
                   {
                     return std::none_of(columns.begin(), columns.end(),
                       [&](const Column& other) { return same(column, other); });
                   }),
      common.end());
    common = first ? columns : common;
    first = false;
  }
  agreed.value(char(allIds && !first));
  agreed.value(char(anyDoubles));
  write(common, agreed);
  const Bytes bytes = ranks.broadcast(agreed.take());
  ByteReader reader(bytes);
  this->GivenIds = reader.value<char>() != 0;
  this->Doubles = reader.value<char>() != 0;
  this->Columns = readColumns(reader);
  if (!hasPoints)
  {
    return;
  }
  this->Coordinates = input->GetPoints()->GetData();
  for (const Column& column : this->Columns)
  {
    this->Arrays.push_back(input->GetPointData()->GetArray(column.Name.c_str()));
    this->Values.push_back(static_cast<const char*>(this->Arrays.back()->GetVoidPointer(0)));
  }
  if (this->GivenIds)
  {
    vtkNew<vtkIdTypeArray> exact; // a double would round ids beyond 2^53
    exact->DeepCopy(ids);
    const vtkIdType* values = exact->GetPointer(0);
    this->GlobalIds.assign(values, values + exact->GetNumberOfTuples());
  }
}

void PointRows::describe(RankPoints& points) const
{
  points.GlobalIds = this->GlobalIds.empty() ? nullptr : this->GlobalIds.data();
  points.RowSize = 3 * sizeof(double);
  for (const Column& column : this->Columns)
  {
    points.RowSize += column.Size;
  }
  points.PackRow = [this](std::size_t i, char* to)
  {
    double place[3];
    this->Coordinates->GetTuple(vtkIdType(i), place);
    std::memcpy(to, place, sizeof(place));
    to += sizeof(place);
    for (std::size_t c = 0; c < this->Columns.size(); ++c)
    {
      const std::size_t size = this->Columns[c].Size;
      std::memcpy(to, this->Values[c] + i * size, size);
      to += size;
    }
  };
}

} // namespace tipp
