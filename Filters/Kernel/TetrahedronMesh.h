// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTetrahedronMesh_h
#define tippTetrahedronMesh_h

#include "Arrays/Buffer.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace tipp
{

/// Tetrahedra in one array, each with 8 slots of 32 bits and a mark. A tetrahedron is identified by
/// its first slot t. Slots t .. t + 3 hold the vertices, in an order whose orientation3() is
/// positive; slots t + 4 .. t + 7 hold the neighbours. A facet is identified by the slot of the
/// opposite vertex, f = t + i. Slot f + 4 holds the same facet as the neighbour identifies it, so
/// that one load gives the neighbour's opposite vertex.
class TetrahedronMesh
{
public:
  using Index = std::uint32_t;

  enum Mark : std::uint8_t
  {
    Live,
    InConflict, ///< with the vertex being inserted
    New,        ///< made by the current insertion
    Free,
    Claimed ///< Claimed + k: by thread k of those that share the mesh
  };

  /// The largest end(): slots are 32-bit indices.
  static constexpr Index MostSlots = ~Index(0) & ~Index(7);

  /// The corners of the facet opposite to corner i, such that orientation3(p, ...) is that of the
  /// tetrahedron with p instead of corner i.
  static constexpr Index FacetCorners[4][3] = { { 1, 2, 3 }, { 0, 3, 2 }, { 0, 1, 3 },
    { 0, 2, 1 } };

  /// Returns the tetrahedron that a facet belongs to.
  static Index cellOf(Index facet) { return facet & ~Index(7); }

  /// Returns which of the four corners v[0..3] is `vertex`.
  static Index positionOf(const Index* v, Index vertex)
  {
    return Index(v[1] == vertex) + 2 * Index(v[2] == vertex) + 3 * Index(v[3] == vertex);
  }

  Index* slots() { return this->Slots.data(); }
  const Index* slots() const { return this->Slots.data(); }
  std::uint8_t* marks() { return this->Marks.data(); }
  const std::uint8_t* marks() const { return this->Marks.data(); }

  /// One past the last tetrahedron, in slots. Tetrahedra below it may be free.
  Index end() const { return this->End; }
  void setEnd(Index end) { this->End = end; }

  /// The number of tetrahedra that fit into the reserved memory.
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

  /// Makes two tetrahedra neighbours; f and g are the common facet in each of them.
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

/// Access to a mesh that no other thread uses.
struct AloneAccess3
{
  static constexpr bool IsShared = false;   ///< whether other threads change the mesh
  static constexpr bool IsClaimed = false;  ///< whether tetrahedra must be claimed from others
  static constexpr bool IsInRegion = false; ///< whether each thread has a region

  static TetrahedronMesh::Index load(const TetrahedronMesh::Index& slot) { return slot; }
  static void store(TetrahedronMesh::Index& slot, TetrahedronMesh::Index value) { slot = value; }
  static std::uint8_t markOf(const std::uint8_t& mark) { return mark; }
  static void setMark(std::uint8_t& mark, std::uint8_t value) { mark = value; }
  static bool claim(std::uint8_t& mark, std::uint8_t own)
  {
    mark = own;
    return true;
  }
  /// Claims the tetrahedron if `isIn`, without a branch. Its mark is Live or `own`, InConflict.
  static bool claimIf(bool isIn, std::uint8_t& mark, std::uint8_t own)
  {
    mark = static_cast<std::uint8_t>(mark | (own & (0U - unsigned(isIn))));
    return true;
  }
};

/// Access to a mesh that several threads change. To remove a tetrahedron, a thread first claims it:
/// it sets the tetrahedron's mark to its own one. Then it checks that all neighbours are live or
/// claimed by itself. Of two threads that claim neighbouring tetrahedra, at least one sees the
/// claim of the other and withdraws, because claims and checks are in one total order. So the
/// neighbours of a claimed and checked tetrahedron are neither removed nor reused, and a thread may
/// link its new tetrahedra to them. Only the owner of a claim changes corners or marks. All other
/// reads may return old values, which are checked once the tetrahedron is claimed.
//
// C++17 has no std::atomic_ref, so these are the compilers' functions. On x86-64 the loads and
// stores are plain instructions.
struct SharedAccess3
{
  static constexpr bool IsShared = true;
  static constexpr bool IsClaimed = true;
  static constexpr bool IsInRegion = false;

  static TetrahedronMesh::Index load(const TetrahedronMesh::Index& slot)
  {
    return __atomic_load_n(&slot, __ATOMIC_ACQUIRE);
  }
  static void store(TetrahedronMesh::Index& slot, TetrahedronMesh::Index value)
  {
    __atomic_store_n(&slot, value, __ATOMIC_RELEASE);
  }
  static std::uint8_t markOf(const std::uint8_t& mark)
  {
    return __atomic_load_n(&mark, __ATOMIC_SEQ_CST);
  }
  static void setMark(std::uint8_t& mark, std::uint8_t value)
  {
    __atomic_store_n(&mark, value, __ATOMIC_RELEASE);
  }
  /// Returns false if the tetrahedron is not live.
  static bool claim(std::uint8_t& mark, std::uint8_t own)
  {
    std::uint8_t live = TetrahedronMesh::Live;
    return __atomic_compare_exchange_n(
      &mark, &live, own, false, __ATOMIC_SEQ_CST, __ATOMIC_SEQ_CST);
  }
  static bool claimIf(bool isIn, std::uint8_t& mark, std::uint8_t own)
  {
    return !isIn || claim(mark, own);
  }
};

/// Access to a mesh that several threads change, each of which has a region of space. A thread only
/// removes tetrahedra all of whose vertices, but for the one at infinity, are in its region. Then
/// no other thread removes a neighbour of these, and no other thread has a tetrahedron next to that
/// neighbour: its facets share two vertices with that of the neighbour, one of which is finite. So
/// links and marks of removed tetrahedra and of their neighbours are the thread's own, and claims
/// are not needed.
///
/// Others' walks may enter tetrahedra that are removed or reused. If all vertices that a walk reads
/// are in its thread's region, no other thread has written them: others write only vertices of
/// their regions, into tetrahedra that had only such vertices or were free. So the tetrahedron is
/// one of the mesh.
struct RegionAccess3 : AloneAccess3
{
  static constexpr bool IsShared = true;
  static constexpr bool IsInRegion = true;

  static TetrahedronMesh::Index load(const TetrahedronMesh::Index& slot)
  {
    return SharedAccess3::load(slot);
  }
  static void store(TetrahedronMesh::Index& slot, TetrahedronMesh::Index value)
  {
    SharedAccess3::store(slot, value);
  }
};

} // namespace tipp

#endif
