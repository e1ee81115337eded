// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPlainIds_h
#define tippPlainIds_h

#include "vtkTIPPIOModule.h"

#include "vtkSmartPointer.h"

#include <cstdint>

class vtkCellArray;
class vtkDataArray;

namespace tipp
{

/// The integers of a VTK array as signed 32-bit or 64-bit integers in contiguous memory: the
/// array's own memory if it has that form, else a copy. The array itself is inspected, since a
/// vtkCellArray of VTK 9.6 has more kinds of storage than its IsStorage64Bit() distinguishes.
class VTKTIPPIO_EXPORT PlainIds
{
public:
  /// No ids.
  PlainIds() = default;
  explicit PlainIds(vtkDataArray* array);

  const void* data() const;
  /// Whether the integers have 64 bits.
  bool isWide() const;
  std::int64_t count() const;

  /// As 64-bit integers; 32-bit ones are copied.
  PlainIds widened() const;

private:
  vtkSmartPointer<vtkDataArray> Array;
};

/// A cell array of any storage: its offsets and point ids, both of the same width.
struct VTKTIPPIO_EXPORT PlainCells
{
  explicit PlainCells(vtkCellArray* cells);

  PlainIds Offsets; ///< number of cells + 1
  PlainIds Ids;
};

} // namespace tipp

#endif
