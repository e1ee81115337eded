// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTetrahedronMesh_h
#define tippTetrahedronMesh_h

#include "Arrays/Buffer.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace tipp
{

/// Tetrahedra in one array, 32 bytes (8 slots) and a mark each: slots 0..3 hold the vertices, so
/// that orientation3() of them is positive, and slots 4..7 the neighbours. A facet is identified by
/// the slot of the vertex opposite to it, f = 8 t + i, and slot f + 4 holds the same facet of the
/// neighbour, so that the neighbour's apex is one load away.
class TetrahedronMesh
{
public:
  using Index = std::uint32_t;

  enum Mark : std::uint8_t
  {
    Live,
    InConflict, ///< with the vertex that is being inserted
    New,        ///< made by the current insertion
    Free
  };

  static constexpr Index MostSlots = ~Index(0) & ~Index(7);

  static Index cellOf(Index facet) { return facet & ~Index(7); }

  Index* slots() { return this->Slots.data(); }
  const Index* slots() const { return this->Slots.data(); }
  std::uint8_t* marks() { return this->Marks.data(); }
  const std::uint8_t* marks() const { return this->Marks.data(); }

  /// One past the last tetrahedron, in slots.
  Index end() const { return this->End; }
  void setEnd(Index end) { this->End = end; }

  std::size_t capacity() const { return this->Marks.size(); }
  std::size_t bytes() const { return this->Slots.size() * sizeof(Index) + this->Marks.size(); }

  void clear() { this->End = 0; }
  void release() { *this = TetrahedronMesh(); }

  /// Reserves memory for `cells` tetrahedra in total. Untouched pages are not committed.
  void reserve(std::size_t cells)
  {
    if (cells <= this->capacity())
    {
      return;
    }
    Buffer<Index> slots(8 * cells);
    Buffer<std::uint8_t> marks(cells);
    std::copy_n(this->Slots.begin(), this->End, slots.begin());
    std::copy_n(this->Marks.begin(), this->End / 8, marks.begin());
    this->Slots = std::move(slots);
    this->Marks = std::move(marks);
  }

  void link(Index f, Index g)
  {
    this->Slots[f + 4] = g;
    this->Slots[g + 4] = f;
  }

private:
  Buffer<Index> Slots;
  Buffer<std::uint8_t> Marks;
  Index End = 0;
};

} // namespace tipp

#endif
