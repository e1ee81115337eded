// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTableArrays_h
#define tippTableArrays_h

#include "Triangulation/Triangulate.h"

#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkSmartPointer.h"
#include "vtkTable.h"

#include <cstdint>
#include <vector>

namespace tipp
{

/// Returns an array with the value get(item) for each item.
template <typename Array, typename Items, typename Get>
vtkSmartPointer<Array> arrayOf(const char* name, const Items& items, Get&& get)
{
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name);
  for (const auto& item : items)
  {
    array->InsertNextValue(get(item));
  }
  return array;
}

template <typename Items, typename Get>
vtkSmartPointer<vtkIdTypeArray> idsOf(const char* name, const Items& items, Get&& get)
{
  return arrayOf<vtkIdTypeArray>(name, items, get);
}

inline void addTotal(const char* name, std::int64_t value, vtkFieldData* totals)
{
  totals->AddArray(
    idsOf(name, std::vector<std::int64_t>{ value }, [](std::int64_t v) { return v; }));
}

/// Adds a row for each stage.
inline void addStages(const std::vector<TriangulationStatistics::Stage>& stages, vtkTable* table)
{
  using Stage = TriangulationStatistics::Stage;
  std::int64_t number = 0;
  table->AddColumn(idsOf("Stage", stages, [&number](const Stage&) { return number++; }));
  table->AddColumn(
    idsOf("ActivePartitions", stages, [](const Stage& s) { return s.ActivePartitions; }));
  table->AddColumn(idsOf("MeshTriangles", stages, [](const Stage& s) { return s.MeshTriangles; }));
}

} // namespace tipp

#endif
