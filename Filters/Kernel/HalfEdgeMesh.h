// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippHalfEdgeMesh_h
#define tippHalfEdgeMesh_h

#include "Arrays/Buffer.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace tipp
{

/// Triangles in one array, 32 bytes (8 slots) each: slots 0..2 hold the vertices,
/// counter-clockwise, and slots 4..6 the neighbours. A half-edge is identified by the slot of the
/// vertex opposite to it, h = 8 t + i, and slot h + 4 holds its twin, so that the neighbour's apex
/// is one load away. Slots 3 and 7 repeat slots 6 and 4, so that the twins of the previous and of
/// the next half-edge are in h + 3 and h + 5 whichever of the three h is.
class HalfEdgeMesh
{
public:
  using Index = std::int32_t;

  static Index triangleOf(Index h) { return h & ~7; }

  ///@{
  /// The next and the previous half-edge of the same triangle. Without branches, which would often
  /// be mispredicted: h & 3 is 0, 1 or 2.
  static Index next(Index h) { return h + 1 - 3 * (h >> 1 & 1); }
  static Index previous(Index h) { return h - 1 + 3 * (~(h | h >> 1) & 1); }
  ///@}

  /// Converts a half-edge to an array offset. Half-edges are never negative, and zero-extension is
  /// free on most processors.
  static std::size_t offset(Index name) { return std::uint32_t(name); }

  static Index twinOf(const Index* slots, Index h) { return slots[offset(h) + 4]; }
  static Index twinOfNext(const Index* slots, Index h) { return slots[offset(h) + 5]; }
  static Index twinOfPrevious(const Index* slots, Index h) { return slots[offset(h) + 3]; }

  /// Sets the twin of half-edge h. Half-edge 0's twin is repeated in slot 7, half-edge 2's in slot
  /// 3. Half-edge 1's is not repeated; its own slot is written twice.
  static void setTwin(Index* slots, Index h, Index twin)
  {
    slots[offset(h) + 4] = twin;
    slots[offset(h + 7 - 3 * (h & 3))] = twin;
  }

  Index vertex(Index h) const { return this->Slots[h]; }
  Index twin(Index h) const { return twinOf(this->Slots.data(), h); }

  Index* slots() { return this->Slots.data(); }
  const Index* slots() const { return this->Slots.data(); }

  /// One past the last triangle: 8 t, where t is the number of triangles.
  Index end() const { return this->End; }
  void setEnd(Index end) { this->End = end; }

  void clear() { this->End = 0; }

  /// Removes all triangles and frees their memory.
  void release() { *this = HalfEdgeMesh(); }

  std::size_t bytes() const { return this->Slots.size() * sizeof(Index); }

  /// Reserves memory for `triangles` triangles in total. Existing triangles keep their indices.
  void reserve(std::size_t triangles)
  {
    if (8 * triangles <= this->Slots.size())
    {
      return;
    }
    const std::size_t slack = this->End > 0 ? triangles : 0;
    Buffer<Index> larger(8 * triangles + slack);
    std::copy(this->Slots.begin(), this->Slots.begin() + this->End, larger.begin());
    this->Slots = std::move(larger);
  }

  void link(Index h, Index g)
  {
    setTwin(this->Slots.data(), h, g);
    setTwin(this->Slots.data(), g, h);
  }

private:
  Buffer<Index> Slots;
  Index End = 0;
};

} // namespace tipp

#endif
