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

/// The integers of a VTK array as signed integers of 32 or 64 bits in plain memory: the array's own
/// memory if that is their form, else a copy. What is asked is the array itself, since a
/// vtkCellArray of VTK 9.6 has more kinds of storage than its IsStorage64Bit() tells apart.
class VTKTIPPIO_EXPORT PlainIds
{
public:
  /// No ids.
  PlainIds() = default;
  explicit PlainIds(vtkDataArray* array);

  const void* data() const;
  /// Whether they have 64 bits.
  bool isWide() const;
  std::int64_t count() const;

  /// As ids of 64 bits, which copies those of 32.
  PlainIds widened() const;

private:
  vtkSmartPointer<vtkDataArray> Array;
};

/// A cell array of any storage: its offsets and point ids, both of the same width.
struct VTKTIPPIO_EXPORT PlainCells
{
  explicit PlainCells(vtkCellArray* cells);

  PlainIds Offsets; ///< one more than cells
  PlainIds Ids;
};

} // namespace tipp

#endif
