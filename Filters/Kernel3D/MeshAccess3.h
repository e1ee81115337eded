// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippMeshAccess3_h
#define tippMeshAccess3_h

#include "Kernel3D/TetrahedronMesh.h"

#include <cstdint>

namespace tipp
{

/// Access to a mesh that no other thread uses.
struct AloneAccess3
{
  static constexpr bool IsShared = false;

  static TetrahedronMesh::Index load(const TetrahedronMesh::Index& slot) { return slot; }
  static void store(TetrahedronMesh::Index& slot, TetrahedronMesh::Index value) { slot = value; }
  static std::uint8_t markOf(const std::uint8_t& mark) { return mark; }
  static void setMark(std::uint8_t& mark, std::uint8_t value) { mark = value; }
  static bool claim(std::uint8_t& mark, std::uint8_t own)
  {
    mark = own;
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
};

} // namespace tipp

#endif
