// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippHalfEdgeMesh_h
#define tippHalfEdgeMesh_h

#include "Triangulation/Buffer.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace tipp
{

/// Triangles of 32 bytes in one array: slots 0..2 hold the vertices, counter-clockwise, and slots
/// 4..6 the neighbours. A half-edge is named by the slot of the vertex opposite to it, h = 8 t + i,
/// and slot h + 4 holds its twin, so that the neighbour's apex is one load away. Slots 3 and 7
/// repeat slots 6 and 4: the twins of the previous and of the next half-edge are in h + 3 and h + 5
/// without a look at which of the three h is.
class HalfEdgeMesh
{
public:
  using Index = std::int32_t;

  static Index triangleOf(Index h) { return h & ~7; }

  /// Names are never negative, and extending them without a sign is free on most processors.
  static std::size_t offset(Index name) { return std::uint32_t(name); }

  static Index twinOf(const Index* slots, Index h) { return slots[offset(h) + 4]; }
  static Index twinOfNext(const Index* slots, Index h) { return slots[offset(h) + 5]; }
  static Index twinOfPrevious(const Index* slots, Index h) { return slots[offset(h) + 3]; }

  /// The repeated slot of half-edge 0 is 7, that of 2 is 3; 1 has none, and its own is written
  /// twice.
  static void setTwin(Index* slots, Index h, Index twin)
  {
    slots[offset(h) + 4] = twin;
    slots[offset(h + 7 - 3 * (h & 3))] = twin;
  }

  Index vertex(Index h) const { return this->Slots[h]; }
  Index twin(Index h) const { return twinOf(this->Slots.data(), h); }

  Index* slots() { return this->Slots.data(); }
  const Index* slots() const { return this->Slots.data(); }

  /// The end of the triangles, as the name (8 t) that the next one gets.
  Index end() const { return this->End; }
  void setEnd(Index end) { this->End = end; }

  void clear() { this->End = 0; }

  /// Gives the memory back, too.
  void release() { *this = HalfEdgeMesh(); }

  std::size_t bytes() const { return this->Slots.size() * sizeof(Index); }

  /// Room for so many triangles in all; the names of those there stay.
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
