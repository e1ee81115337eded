// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCellArrays_h
#define tippCellArrays_h

#include "Files/IOError.h"
#include "Parallel/ParallelFor.h"
#include "vtkTIPPIOModule.h"

#include "vtkSmartPointer.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <type_traits>

class vtkCellArray;
class vtkDataArray;

namespace tipp
{

/// Returns the array itself if its tuples are contiguous in memory, else a contiguous copy.
VTKTIPPIO_EXPORT vtkSmartPointer<vtkDataArray> contiguous(vtkDataArray* array);

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

/// Whether VTK has this cell type.
bool isCellType(int type);

/// The number of vertices of a cell type; 0 if it varies.
int cellSizeOf(int type);

/// Whether a cell of the type can have `size` vertices.
bool isCellSize(int type, std::int64_t size);

/// Number of values that a thread checks at a time.
constexpr std::int64_t checkedAtOnce = 1 << 16;
constexpr const char* repairAdvice = "; repair it or write it again.";

/// Checks the cells of one vtkCellArray with ids of type Id.
template <typename Id>
class CellArrayCheck
{
public:
  CellArrayCheck(
    const PlainCells& cells, const std::string& name, const std::string& what, int threads)
    : Offsets(static_cast<const Id*>(cells.Offsets.data()))
    , Cells(std::max<std::int64_t>(cells.Offsets.count() - 1, 0))
    , Ids(static_cast<const Id*>(cells.Ids.data()))
    , Count(cells.Ids.count())
    , Name(name)
    , What(what)
    , Threads(threads)
  {
  }

  /// Checks that offsets ascend from 0 to at most the number of ids, and that each cell has at
  /// least `least` vertices and, if types are given, as many as its type allows.
  void offsets(std::int64_t least, const unsigned char* types) const
  {
    if (this->Cells == 0)
    {
      return;
    }
    forChunks(this->Cells, checkedAtOnce, this->Threads, {},
      [&](std::int64_t begin, std::int64_t end, int)
      {
        if (!types || !this->areAlike(types, begin, end))
        {
          this->requireSizes(begin, end, least);
          for (std::int64_t i = begin; types && i < end; ++i)
          {
            this->requireSize(i, types[i]);
          }
        }
      });
    if (this->Offsets[0] != 0 || std::int64_t(this->Offsets[this->Cells]) > this->Count)
    {
      this->fail("begin at vertex id " + std::to_string(this->Offsets[0]) + " and end at " +
        std::to_string(this->Offsets[this->Cells]) + " of " + std::to_string(this->Count));
    }
  }

  /// Call after offsets(): checks that all ids are in [0, count); `item` is for errors, such as
  /// "point".
  void ids(std::int64_t count, const std::string& item) const
  {
    const std::int64_t used = this->Cells > 0 ? std::int64_t(this->Offsets[this->Cells]) : 0;
    const auto last = Unsigned(std::min<std::int64_t>(count - 1, std::numeric_limits<Id>::max()));
    forChunks(used, checkedAtOnce, this->Threads, {},
      [&](std::int64_t begin, std::int64_t end, int)
      {
        Unsigned all = 0; // negative if an id is, or is too large
        for (std::int64_t i = begin; i < end; ++i)
        {
          const auto id = Unsigned(this->Ids[i]);
          all |= id | (last - id);
        }
        if (count == 0 || Id(all) < 0)
        {
          this->failAtId(begin, count, item);
        }
      });
  }

private:
  using Unsigned = std::make_unsigned_t<Id>;

  [[noreturn]] void fail(const std::string& problem) const
  {
    throw IOError(this->Name, "its " + this->What + " " + problem + repairAdvice);
  }

  std::int64_t size(std::int64_t cell) const
  {
    return std::int64_t(this->Offsets[cell + 1]) - std::int64_t(this->Offsets[cell]);
  }

  /// Whether all cells are of one type of fixed size and have that size: most meshes are like that,
  /// and one pass over the offsets is enough.
  bool areAlike(const unsigned char* types, std::int64_t begin, std::int64_t end) const
  {
    const auto size = Unsigned(cellSizeOf(types[begin]));
    if (size == 0 || this->Offsets[begin] < 0 || this->Offsets[end] < 0 ||
      std::memcmp(types + begin, types + begin + 1, std::size_t(end - begin - 1)) != 0)
    {
      return false;
    }
    Unsigned different = 0; // branch-free, so that it is vectorised
    for (std::int64_t i = begin; i < end; ++i)
    {
      different |= Unsigned(this->Offsets[i + 1]) - Unsigned(this->Offsets[i]) - size;
    }
    // No sum wraps around: two non-negative offsets are too close for that.
    static_assert(checkedAtOnce < (std::int64_t(1) << 24));
    return different == 0;
  }

  void requireSizes(std::int64_t begin, std::int64_t end, std::int64_t least) const
  {
    Unsigned all = 0; // negative if an offset is, or if a size is below the minimum
    for (std::int64_t i = begin; i < end; ++i)
    {
      const auto next = Unsigned(this->Offsets[i + 1]);
      all |= next | (next - Unsigned(this->Offsets[i]) - Unsigned(least));
    }
    for (std::int64_t i = begin; Id(all) < 0 && i < end; ++i)
    {
      if (this->Offsets[i] < 0 || this->Offsets[i + 1] < this->Offsets[i])
      {
        this->fail("have offsets that do not ascend: " + std::to_string(this->Offsets[i + 1]) +
          " after " + std::to_string(this->Offsets[i]) + " at number " + std::to_string(i));
      }
      if (this->size(i) < least)
      {
        this->fail("have one of " + std::to_string(this->size(i)) + " vertices, number " +
          std::to_string(i) + ", where " + std::to_string(least) + " are the least");
      }
    }
  }

  void failAtId(std::int64_t begin, std::int64_t count, const std::string& item) const
  {
    const auto isGood = [&](Id id) { return id >= 0 && std::int64_t(id) < count; };
    const Id* const bad = std::find_if_not(this->Ids + begin, this->Ids + this->Count, isGood);
    const Id* const offset =
      std::upper_bound(this->Offsets, this->Offsets + this->Cells, Id(bad - this->Ids));
    this->fail("refer to " + item + " " + std::to_string(*bad) + " at number " +
      std::to_string(offset - this->Offsets - 1) + ", but there are " + std::to_string(count) +
      " " + item + "s");
  }

  void requireSize(std::int64_t cell, int type) const
  {
    if (!isCellSize(type, this->size(cell)))
    {
      throw IOError(this->Name,
        "its cell " + std::to_string(cell) + " is of type " + std::to_string(type) +
          (isCellType(type)
              ? ", which cannot have " + std::to_string(this->size(cell)) + " vertices"
              : ", which VTK does not know") +
          repairAdvice);
    }
  }

  const Id* Offsets;
  std::int64_t Cells;
  const Id* Ids;
  std::int64_t Count;
  const std::string& Name;
  const std::string& What;
  int Threads;
};

} // namespace tipp

#endif
