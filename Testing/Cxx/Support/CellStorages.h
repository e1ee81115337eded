// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCellStorages_h
#define tippCellStorages_h

#include "vtkCellArray.h"
#include "vtkShortArray.h"
#include "vtkSmartPointer.h"
#include "vtkTypeInt32Array.h"
#include "vtkTypeInt64Array.h"
#include "vtkVersionMacros.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

/// The storages that vtkCellArray has in the VTK of this build.
enum class CellStorage
{
  Int32,
  Int64,
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 6, 0)
  FixedSizeInt32,
  FixedSizeInt64,
  GenericShort,
  GenericMixed,
#endif
};

inline std::vector<std::pair<std::string, CellStorage>> cellStorages()
{
  return
  {
    { "Int32", CellStorage::Int32 }, { "Int64", CellStorage::Int64 },
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 6, 0)
      { "FixedSizeInt32", CellStorage::FixedSizeInt32 },
      { "FixedSizeInt64", CellStorage::FixedSizeInt64 },
      { "Generic with ids of 16 bits", CellStorage::GenericShort },
      { "Generic with offsets of 32 bits and ids of 64", CellStorage::GenericMixed },
#endif
  };
}

template <typename Array>
vtkSmartPointer<Array> arrayOf(const std::vector<std::int64_t>& values)
{
  const auto array = vtkSmartPointer<Array>::New();
  for (const std::int64_t value : values)
  {
    array->InsertNextValue(typename Array::ValueType(value));
  }
  return array;
}

/// Cells of `size` points each.
inline vtkSmartPointer<vtkCellArray> storedCells(
  CellStorage storage, const std::vector<std::int64_t>& ids, int size)
{
  std::vector<std::int64_t> offsets;
  for (std::size_t at = 0; at <= ids.size(); at += std::size_t(size))
  {
    offsets.push_back(std::int64_t(at));
  }
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  switch (storage)
  {
    case CellStorage::Int32:
      cells->SetData(arrayOf<vtkTypeInt32Array>(offsets), arrayOf<vtkTypeInt32Array>(ids));
      break;
    case CellStorage::Int64:
      cells->SetData(arrayOf<vtkTypeInt64Array>(offsets), arrayOf<vtkTypeInt64Array>(ids));
      break;
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 6, 0)
    case CellStorage::FixedSizeInt32:
      cells->SetData(size, arrayOf<vtkTypeInt32Array>(ids));
      break;
    case CellStorage::FixedSizeInt64:
      cells->SetData(size, arrayOf<vtkTypeInt64Array>(ids));
      break;
    case CellStorage::GenericShort:
      cells->SetData(static_cast<vtkDataArray*>(arrayOf<vtkTypeInt64Array>(offsets)),
        static_cast<vtkDataArray*>(arrayOf<vtkShortArray>(ids)));
      break;
    case CellStorage::GenericMixed:
      cells->SetData(static_cast<vtkDataArray*>(arrayOf<vtkTypeInt32Array>(offsets)),
        static_cast<vtkDataArray*>(arrayOf<vtkTypeInt64Array>(ids)));
      break;
#endif
  }
  return cells;
}

#endif
