// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippInsertionOrder_h
#define tippInsertionOrder_h

#include "Arrays/Buffer.h"
#include "Kernel/Pairs.h"
#include "Parallel/Instructions.h"
#include "Predicates/Geometry.h"
#include "vtkTIPPFiltersModule.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// An order of points along a space-filling curve: 64-bit entries, each with a key in the high bits
/// and the point's index in the low ones.
class CurveOrder
{
public:
  static constexpr unsigned IndexBits = 28;

  std::size_t size() const { return this->Entries.size(); }

  /// The input index of the k-th point to insert.
  std::uint32_t operator[](std::size_t k) const
  {
    return static_cast<std::uint32_t>(this->Entries[k] & IndexMask);
  }

  /// Reserves memory for `points` points.
  void reserve(std::size_t points)
  {
    this->Entries.reserve(points);
    this->Scratch.reserve(points);
  }

  std::size_t bytes() const
  {
    return (this->Entries.capacity() + this->Scratch.capacity()) * sizeof(std::uint64_t);
  }

  /// Forgets the order and frees its memory.
  void release()
  {
    Uninitialised<std::uint64_t>().swap(this->Entries);
    Uninitialised<std::uint64_t>().swap(this->Scratch);
  }

protected:
  static constexpr std::uint64_t IndexMask = (std::uint64_t(1) << IndexBits) - 1;

  /// A range of entries.
  struct EntryRange
  {
    std::size_t Begin;
    std::size_t End;
  };

  template <unsigned passes, unsigned digitBits, unsigned lowest>
  void sortByDigits(EntryRange range);
  void addRuns(EntryRange within, std::vector<EntryRange>& runs) const;
  template <typename Curve>
  void sortRuns(const typename Curve::Point* points, std::vector<EntryRange> runs);

  Uninitialised<std::uint64_t> Entries;
  Uninitialised<std::uint64_t> Scratch;
};

/// Positions along a Hilbert curve of 16 levels. Without branches and tables, so that compilers
/// vectorise loops over many cells. Inline, because InsertionOrder.cxx compiles the loops for
/// several sets of instructions.
///
/// From the coarsest bits of x and y to the finest, the curve is in one of four states (s, f):
/// whether x and y are swapped, and whether they are complemented. At a level with bits x and y, u
/// = g ^ x and v = g ^ y with g = f ^ s (x ^ y) are the bits in the curve's frame, the key gets the
/// bits u and u ^ v = x ^ y, and the next state is
///   s' = s ^ !v     = s !d ^ f    ^ !y
///   f' = f ^ u !v   = s d  ^ f !d ^ x !y     where d = x ^ y,
/// an affine function over GF(2). So the states at all levels follow from the levels' functions by
/// composing runs of doubling length (Hillis, Steele 1986), with one bit of a word for each level.
struct HilbertSteps
{
  std::uint32_t SS, SF, FS, FF; ///< s' = SS s ^ SF f ^ S, f' = FS s ^ FF f ^ F
  std::uint32_t S, F;

  /// Composes each level's function with that of the run that ends `levels` levels coarser. The
  /// bits shifted in beyond the coarsest level give the initial state, (0, 0).
  HilbertSteps composed(unsigned levels) const
  {
    const HilbertSteps e{ this->SS >> levels, this->SF >> levels, this->FS >> levels,
      this->FF >> levels, this->S >> levels, this->F >> levels };
    return { (this->SS & e.SS) ^ (this->SF & e.FS), (this->SS & e.SF) ^ (this->SF & e.FF),
      (this->FS & e.SS) ^ (this->FF & e.FS), (this->FS & e.SF) ^ (this->FF & e.FF),
      (this->SS & e.S) ^ (this->SF & e.F) ^ this->S,
      (this->FS & e.S) ^ (this->FF & e.F) ^ this->F };
  }
};

/// Moves the lower 16 bits to the even bit positions.
inline std::uint32_t spreadBits(std::uint32_t bits)
{
  bits = (bits | bits << 8) & 0x00ff00ffU;
  bits = (bits | bits << 4) & 0x0f0f0f0fU;
  bits = (bits | bits << 2) & 0x33333333U;
  return (bits | bits << 1) & 0x55555555U;
}

/// The position of cell (x, y) along the curve; x and y must be below 2^16.
inline std::uint32_t hilbertKey(std::uint32_t x, std::uint32_t y)
{
  constexpr std::uint32_t all = 0xffff;
  const std::uint32_t d = x ^ y;
  const HilbertSteps level{ ~d & all, all, d, ~d & all, ~y & all, x & ~y };
  const HilbertSteps run = level.composed(1).composed(2).composed(4).composed(8);
  const std::uint32_t s = run.S >> 1;
  const std::uint32_t f = run.F >> 1;
  return spreadBits(f ^ (s & d) ^ x) << 1 | spreadBits(d);
}

/// The order in which the kernel inserts points in the plane: rounds, each along a Hilbert curve.
/// It depends only on the coordinates and on the points' indices in the array.
class InsertionOrder : public CurveOrder
{
public:
  explicit InsertionOrder(Instructions instructions = Instructions::Best)
    : Allowed(instructions)
  {
  }

  /// Computes the order of `count` points. It is valid until the next call.
  void compute(const Point2* points, std::size_t count);

  /// Frees the memory if it is large; the order is invalid then.
  void releaseIfLarge();

private:
  bool hasManyTies(unsigned lowest) const;

  const Instructions Allowed;
};

/// The same for points in space.
class VTKTIPPFILTERS_EXPORT InsertionOrder3 : public CurveOrder
{
public:
  /// Computes the order of `count` < 2^IndexBits points; replaces the previous order.
  void compute(const Point3* points, std::size_t count);

  /// For each round the position in the order that follows its last point; ascending.
  const std::vector<std::size_t>& roundEnds() const { return this->RoundEnds; }

private:
  std::vector<std::size_t> RoundEnds;
};

} // namespace tipp

#endif
