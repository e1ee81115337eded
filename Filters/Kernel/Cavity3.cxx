// SPDX-License-Identifier: BSD-3-Clause
#include "Kernel/Cavity3.h"

#include "Kernel/Pairs.h"
#include "Parallel/Instructions.h"
#include "Predicates/ExactPredicates3.h"

#include <algorithm>
#include <stdexcept>

namespace tipp
{
namespace
{

using Index = TetrahedronMesh::Index;

/// Four doubles in one vector. Used for local variables only: how a function passes such a vector
/// depends on the instruction set.
using Quad = double __attribute__((vector_size(32)));
using QuadMask = long long __attribute__((vector_size(32)));

/// Four points, with their lift or another value.
using QuadPoint = LiftedPoint<Quad>;

/// Returns the points in another order.
template <int A, int B, int C, int D>
[[gnu::always_inline]] inline QuadPoint permuted(const QuadPoint& p)
{
  return { __builtin_shufflevector(p.x, p.x, A, B, C, D),
    __builtin_shufflevector(p.y, p.y, A, B, C, D), __builtin_shufflevector(p.z, p.z, A, B, C, D),
    __builtin_shufflevector(p.lift, p.lift, A, B, C, D) };
}

/// The differences of four points from another one.
struct Differences
{
  Quad x;
  Quad y;
  Quad z;
};

/// Returns the differences of points[v[0..3]] from p. Reads the number behind each point, too.
[[gnu::always_inline]] inline Differences differences(
  const Point3* points, const Index* v, const Point3& p)
{
  using InMemory = double __attribute__((vector_size(32), aligned(8), may_alias));
  const Quad from = { p.x, p.y, p.z, 0 };
  const Quad a = *reinterpret_cast<const InMemory*>(points + v[0]) - from;
  const Quad b = *reinterpret_cast<const InMemory*>(points + v[1]) - from;
  const Quad c = *reinterpret_cast<const InMemory*>(points + v[2]) - from;
  const Quad d = *reinterpret_cast<const InMemory*>(points + v[3]) - from;
  const Quad xzOfAB = __builtin_shufflevector(a, b, 0, 4, 2, 6);
  const Quad xzOfCD = __builtin_shufflevector(c, d, 0, 4, 2, 6);
  const Quad yOfAB = __builtin_shufflevector(a, b, 1, 5, 3, 7);
  const Quad yOfCD = __builtin_shufflevector(c, d, 1, 5, 3, 7);
  return { __builtin_shufflevector(xzOfAB, xzOfCD, 0, 1, 4, 5),
    __builtin_shufflevector(yOfAB, yOfCD, 0, 1, 4, 5),
    __builtin_shufflevector(xzOfAB, xzOfCD, 2, 3, 6, 7) };
}

/// Returns a bit for each lane of the mask: lane i sets bit i.
inline unsigned bitsOfLanes(const QuadMask& mask)
{
  return bitsOf(__builtin_shufflevector(mask, mask, 0, 1)) |
    bitsOf(__builtin_shufflevector(mask, mask, 2, 3)) << 2;
}

} // namespace

void Cavity3::restart(const Point3* points, std::size_t count)
{
  this->Recent = 0;
  this->Free.clear();
  this->Filling.restart();
  this->extend(points, count);
}

void Cavity3::extend(const Point3* points, std::size_t count)
{
  this->Points = points;
  this->Predicates.restart(points, count);
  this->Filling.extend(count);
}

/// Tests on which sides of a tetrahedron's facets p is, in one vector. Bit i of the result: p is
/// certainly beyond the facet opposite to corner i. Bit i of `inside`: it is certainly not.
//
// The determinants are those of orientation3(p, a, b, c), with a, b, c from FacetCorners. But for
// rounding, the product of sizes is at least the permanent in the error bound of orientation3().
inline unsigned Cavity3::facetsBefore(const Index* v, const Point3& p, unsigned& inside) const
{
  const auto [x, y, z] = differences(this->Points, v, p);
  const Quad size = (x < 0 ? -x : x) + (y < 0 ? -y : y) + (z < 0 ? -z : z);
  const QuadPoint corners = { x, y, z, size };
  const auto [ax, ay, az, aSize] = permuted<1, 0, 0, 0>(corners);
  const auto [bx, by, bz, bSize] = permuted<2, 3, 1, 2>(corners);
  const auto [cx, cy, cz, cSize] = permuted<3, 2, 3, 1>(corners);
  const Quad determinant =
    (az * (bx * cy - cx * by) - bz * (ax * cy - cx * ay)) + cz * (ax * by - bx * ay);
  // After an overflow the last term is NaN, and both comparisons are false.
  const Quad bound =
    8e-16 * (aSize * bSize * cSize) + 1e-300 * (1.0 + aSize + bSize + cSize) + 0.0 * determinant;
  inside = bitsOfLanes(determinant > bound);
  return bitsOfLanes(-determinant > bound);
}

/// Walks to a tetrahedron that contains the point. If the point is outside of the hull, the walk
/// ends at an infinite tetrahedron whose hull facet separates the point from the hull.
//
// A walk among other threads may read tetrahedra that are removed or reused. All their corners and
// neighbours are valid indices, so it ends somewhere, or is given up.
template <typename Access>
inline Cavity3::Location Cavity3::locate(const TetrahedronMesh& mesh, const Point3& p)
{
  constexpr int mostSteps = 1 << 16; // among other threads
  const Index* const slots = mesh.slots();
  const Point3* const points = this->Points;
  Location at = { this->Recent, 0, {} };
  Index from = 4; // opposite to the facet that the walk crossed last; 4: none yet
  for (int step = 0; !Access::IsShared || step < mostSteps; ++step)
  {
    const Index* const cell = slots + at.Cell;
    const Index v[4] = { Access::load(cell[0]), Access::load(cell[1]), Access::load(cell[2]),
      Access::load(cell[3]) };
    if (Access::IsClaimed)
    {
      std::copy_n(v, 4, at.Corners.begin());
    }
    if (v[0] == 0)
    {
      return at;
    }
    unsigned inside = 0;
    const unsigned before = this->facetsBefore(v, p, inside) & ~(1U << from);
    const unsigned unknown = 15 & ~(before | inside | 1U << from);
    bool isOnFacet = false;
    Index next = before != 0 ? Index(__builtin_ctz(before)) : 4;
    for (Index i = 0; unknown != 0 && i < 4 && next == 4; ++i)
    {
      if ((unknown >> i & 1) != 0)
      {
        const Index* const f = TetrahedronMesh::FacetCorners[i];
        const int side =
          this->Predicates.orientation(p, points[v[f[0]]], points[v[f[1]]], points[v[f[2]]]);
        isOnFacet |= side == 0;
        next = side < 0 ? i : next;
      }
    }
    if (next == 4)
    {
      for (Index i = 0; isOnFacet && i < 4; ++i)
      {
        at.EqualTo = points[v[i]] == p ? v[i] : at.EqualTo;
      }
      return at;
    }
    const Index across = Access::load(cell[next + 4]);
    at.Cell = TetrahedronMesh::cellOf(across);
    from = across & 3;
  }
  return { NoCell, 0, {} };
}

/// Tests p against the spheres of the four neighbours of a tetrahedron, in one vector. Both masks
/// of the result are 0 for a neighbour at infinity, and for all neighbours of an infinite
/// tetrahedron: the coordinates of vertex 0 are NaN.
//
// With the neighbour's apex e, and a, b, c from FacetCorners, orientation3(e, a, b, c) is negative,
// and so is the determinant of inSphereValue() if p is inside.
inline void Cavity3::testNeighbours(const Index* slots, const Point3& p, TestedCell& tested) const
{
  const Links& across = tested.Across;
  const Index apexes[4] = { slots[across[0]], slots[across[1]], slots[across[2]],
    slots[across[3]] };
  const auto [x, y, z] = differences(this->Points, slots + tested.Cell, p);
  const auto [ex, ey, ez] = differences(this->Points, apexes, p);
  const QuadPoint corners = { x, y, z, x * x + y * y + z * z };
  const QuadPoint e = { ex, ey, ez, ex * ex + ey * ey + ez * ez };
  const auto [determinant, lifts] = inSphereValue(
    e, permuted<1, 0, 0, 0>(corners), permuted<2, 3, 1, 2>(corners), permuted<3, 2, 3, 1>(corners));
  // The same error bound as in isCertain().
  const Quad square = lifts * lifts;
  const Quad bound = (9 * 0x1p-106) * (square * square) * lifts + 1e-280;
  tested.Certain = bitsOfLanes(determinant * determinant > bound);
  tested.Inside = tested.Certain & bitsOfLanes(determinant < 0);
}

/// Reads the links of a claimed tetrahedron. Returns false if another thread claims or has just
/// removed a neighbour.
//
// If a thread replaces a neighbour, it changes the link before it frees the neighbour. So if the
// neighbour is live and the link is still the same, it is the neighbour, and it stays.
template <typename Access>
inline bool Cavity3::readLinks(const TetrahedronMesh& mesh, Index cell, Links& across) const
{
  const Index* const links = mesh.slots() + cell + 4;
  for (std::size_t i = 0; i < 4; ++i)
  {
    across[i] = Access::load(links[i]);
  }
  bool areStable = true;
  for (std::size_t i = 0; Access::IsClaimed && i < 4; ++i)
  {
    const std::uint8_t mark = Access::markOf(mesh.marks()[across[i] / 8]);
    areStable &= mark == TetrahedronMesh::Live || mark == this->Claim;
    areStable &= Access::load(links[i]) == across[i];
  }
  return areStable;
}

/// Claims the tetrahedron where a walk has ended. Returns false if it is another thread's, or if p
/// is not in its circumsphere.
//
// The corners are compared too, because the walk has seen that p is at none of them. The sphere is
// tested because the walk may have entered the tetrahedron from one that is no longer its
// neighbour.
template <typename Access>
inline bool Cavity3::claimFirst(TetrahedronMesh& mesh, const Point3& p, const Location& at)
{
  this->Removed.clear();
  this->Boundary.clear();
  const Index* const v = mesh.slots() + at.Cell;
  if (Access::IsInRegion &&
    !std::all_of(v, v + 4, [&](const Index& corner) { return this->isOwn(Access::load(corner)); }))
  {
    return false;
  }
  if (!Access::claim(mesh.marks()[at.Cell / 8], this->Claim))
  {
    return false;
  }
  this->Removed.makeRoom(1);
  *this->Removed.end() = at.Cell;
  this->Removed.setEnd(this->Removed.end() + 1);
  if (!Access::IsShared)
  {
    return true;
  }
  const Point3* const points = this->Points;
  if (Access::IsClaimed && !std::equal(v, v + 4, at.Corners.begin()))
  {
    return false;
  }
  return v[0] != 0 ? this->Predicates.isInFiniteConflict(v, p)
                   : this->Predicates.orientation(p, points[v[1]], points[v[2]], points[v[3]]) > 0;
}

/// Tests p against an infinite neighbour of the cavity. The test may read the neighbour's finite
/// neighbour, so the neighbour is claimed meanwhile. Returns false if it cannot be claimed.
template <typename Access>
[[gnu::noinline]] bool Cavity3::testInfinite(
  TetrahedronMesh& mesh, Index cell, const Point3& p, bool& isIn)
{
  std::uint8_t& mark = mesh.marks()[cell / 8];
  if (Access::IsClaimed && !Access::claim(mark, this->Claim))
  {
    return false;
  }
  Links across;
  const bool areStable = this->readLinks<Access>(mesh, cell, across);
  isIn = areStable && this->Predicates.isInInfiniteConflict(mesh.slots(), cell, p);
  if (Access::IsClaimed)
  {
    Access::setMark(mark, TetrahedronMesh::Live);
  }
  return areStable;
}

/// Tests the neighbours of Removed[k]. Returns false if another thread is at work there.
template <typename Access>
inline bool Cavity3::testCell(
  const TetrahedronMesh& mesh, std::size_t k, const Point3& p, TestedCell& tested) const
{
  const Index* const slots = mesh.slots();
  tested.Cell = this->Removed[k];
  if (!this->readLinks<Access>(mesh, tested.Cell, tested.Across))
  {
    return false;
  }
  tested.Certain = 0;
  tested.Inside = 0;
  if (slots[tested.Cell] != 0)
  {
    this->testNeighbours(slots, p, tested);
  }
  // The neighbours of a tetrahedron that will soon be tested.
  constexpr std::size_t ahead = 4;
  const Index* const links =
    slots + this->Removed[std::min(k + ahead, this->Removed.size() - 1)] + 4;
  for (Index i = 0; i < 4; ++i)
  {
    __builtin_prefetch(slots + TetrahedronMesh::cellOf(Access::load(links[i])));
  }
  return true;
}

/// Tests with exact predicates which of the `uncertain` neighbours are in conflict with p. Returns
/// false if another thread is at work there.
template <typename Access>
inline bool Cavity3::decide(
  TetrahedronMesh& mesh, unsigned uncertain, const Point3& p, TestedCell& tested)
{
  const Index* const slots = mesh.slots();
  for (Index i = 0; i < 4; ++i)
  {
    if ((uncertain >> i & 1) == 0)
    {
      continue;
    }
    const Index beyond = TetrahedronMesh::cellOf(tested.Across[i]);
    bool isIn = false;
    if (slots[beyond] != 0)
    {
      isIn = this->Predicates.isInFiniteConflict(slots + beyond, p);
    }
    else if (!this->testInfinite<Access>(mesh, beyond, p, isIn))
    {
      return false;
    }
    tested.Inside |= unsigned(isIn) << i;
  }
  return true;
}

/// Whether the neighbours of the mask `in` are in this thread's region. Their corners are, but for
/// those opposite to the common facets.
inline bool Cavity3::areInRegion(const Index* slots, unsigned in, const Links& across) const
{
  unsigned isOther = 0;
  for (Index i = 0; i < 4; ++i)
  {
    isOther |= unsigned(this->Regions[slots[across[i]]] != this->Region) << i;
  }
  bool areOwn = true;
  for (unsigned rest = in & isOther; rest != 0; rest &= rest - 1)
  {
    areOwn &= this->isOwn(slots[across[std::size_t(__builtin_ctz(rest))]]);
  }
  return areOwn;
}

/// Adds the neighbours in conflict to Removed, and the facets of the others to Boundary. Returns
/// false if another thread is at work there.
//
// There is hardly a branch: which neighbours are in conflict cannot be predicted, and while a
// mispredicted branch is resolved the next tetrahedron is not tested.
template <typename Access>
inline bool Cavity3::addTested(TetrahedronMesh& mesh, const Point3& p, TestedCell& tested)
{
  std::uint8_t* const marks = mesh.marks();
  const std::uint8_t own = this->Claim;
  unsigned isOpen = 0;
  for (Index i = 0; i < 4; ++i)
  {
    isOpen |= unsigned(Access::markOf(marks[tested.Across[i] / 8]) != own) << i;
  }
  const unsigned uncertain = isOpen & ~tested.Certain;
  if (__builtin_expect(uncertain != 0, 0) && !this->decide<Access>(mesh, uncertain, p, tested))
  {
    return false;
  }
  const unsigned in = isOpen & tested.Inside;
  if (Access::IsInRegion && !this->areInRegion(mesh.slots(), in, tested.Across))
  {
    return false;
  }
  const unsigned out = isOpen & ~tested.Inside;
  this->Removed.makeRoom(4);
  this->Boundary.makeRoom(4);
  Index* removed = this->Removed.end();
  CavityFacet3* boundary = this->Boundary.end();
  bool areClaimed = true;
  for (Index i = 0; i < 4; ++i)
  {
    const Index across = tested.Across[i];
    const bool isIn = (in >> i & 1) != 0;
    areClaimed = areClaimed && Access::claimIf(isIn, marks[across / 8], own);
    *boundary = { tested.Cell + i, across };
    boundary += out >> i & 1;
    *removed = TetrahedronMesh::cellOf(across);
    removed += isIn && areClaimed ? 1 : 0;
  }
  this->Removed.setEnd(removed);
  this->Boundary.setEnd(boundary);
  return areClaimed;
}

/// Finds the tetrahedra in conflict with p (the cavity), starting from the claimed one, and the
/// cavity's boundary. Returns false if another thread is at work there.
//
// Two are tested at a time, so that one is computed while the other waits for memory.
template <typename Access>
inline bool Cavity3::findConflicts(TetrahedronMesh& mesh, const Point3& p)
{
  std::array<TestedCell, 2> tested;
  for (std::size_t k = 0; k < this->Removed.size();)
  {
    const std::size_t count = std::min(this->Removed.size() - k, tested.size());
    for (std::size_t i = 0; i < count; ++i, ++k)
    {
      if (!this->testCell<Access>(mesh, k, p, tested[i]))
      {
        return false;
      }
    }
    for (std::size_t i = 0; i < count; ++i)
    {
      if (!this->addTested<Access>(mesh, p, tested[i]))
      {
        return false;
      }
    }
  }
  return true;
}

/// Reserves as many free tetrahedra as the boundary has facets. Throws std::length_error if there
/// are not enough indices.
inline void Cavity3::makeRoom(TetrahedronMesh& mesh)
{
  const std::size_t count = this->Boundary.size();
  if (this->Free.size() >= count)
  {
    return;
  }
  const std::size_t needed = mesh.end() / 8 + (count - this->Free.size());
  if (needed > TetrahedronMesh::MostSlots / 8)
  {
    throw std::length_error("too many points for one partition: use more partitions");
  }
  if (needed > mesh.capacity())
  {
    mesh.reserve(needed + needed / 2);
  }
  while (this->Free.size() < count)
  {
    mesh.marks()[mesh.end() / 8] = TetrahedronMesh::Free;
    this->Free.push_back(mesh.end());
    mesh.setEnd(mesh.end() + 8);
  }
}

/// As makeRoom(), while other threads do the same. Returns false if the mesh has no memory left.
inline bool Cavity3::takeRoom(TetrahedronMesh& mesh)
{
  constexpr std::uint64_t together = 1024;
  const auto most = std::min<std::uint64_t>(mesh.capacity(), TetrahedronMesh::MostSlots / 8);
  while (this->Free.size() < this->Boundary.size())
  {
    const std::uint64_t begin = this->SharedEnd->fetch_add(8 * together);
    if (begin / 8 + together > most)
    {
      this->SharedEnd->fetch_sub(8 * together);
      return false;
    }
    // Other threads' walks may enter a tetrahedron before it is complete.
    std::fill_n(mesh.slots() + begin, 8 * together, Index(0));
    for (std::uint64_t cell = begin / 8; cell < begin / 8 + together; ++cell)
    {
      mesh.marks()[cell] = TetrahedronMesh::Free;
      this->Free.push_back(Index(8 * cell));
    }
  }
  return true;
}

/// Fills the cavity that findConflicts() has found with new tetrahedra.
template <typename Access>
inline void Cavity3::retriangulate(TetrahedronMesh& mesh, Index vertex)
{
  const Index* const made = &this->Free.back();
  this->Filling.fill<Access>(mesh, vertex, this->Boundary, made);
  // The walk to the next vertex must start at a finite tetrahedron. Other threads may already
  // change the new ones, so the removed ones are read.
  std::size_t last = this->Boundary.size() - 1;
  const auto isFinite = [&mesh](Index inside)
  { return (inside & 3) == 0 || mesh.slots()[TetrahedronMesh::cellOf(inside)] != 0; };
  while (!isFinite(this->Boundary[last].Inside))
  {
    --last;
  }
  this->Recent = made[-std::ptrdiff_t(last)];
  this->Free.resize(this->Free.size() - this->Boundary.size());
  this->setMarks<Access>(mesh, TetrahedronMesh::Free);
  this->Free.insert(this->Free.end(), this->Removed.begin(), this->Removed.end());
}

/// Sets the marks of the removed tetrahedra.
template <typename Access>
inline void Cavity3::setMarks(TetrahedronMesh& mesh, std::uint8_t mark) const
{
  for (const Index cell : this->Removed)
  {
    Access::setMark(mesh.marks()[cell / 8], mark);
  }
}

/// If another thread has removed the tetrahedron where the next walk would start, chooses the first
/// finite one in the mesh.
inline void Cavity3::renewStart(const TetrahedronMesh& mesh)
{
  using Access = SharedAccess3;
  const auto isStart = [&mesh](Index cell)
  {
    return Access::markOf(mesh.marks()[cell / 8]) == TetrahedronMesh::Live &&
      Access::load(mesh.slots()[cell]) != 0;
  };
  for (Index cell = 0; !isStart(this->Recent) && cell < mesh.end(); cell += 8)
  {
    this->Recent = cell;
  }
}

/// Inserts a vertex, or adds it to `found` if it coincides with an earlier one. Returns false, and
/// changes nothing, if another thread is at work at the vertex or if the shared mesh has no memory
/// left.
template <typename Access>
inline bool Cavity3::insertOne(TetrahedronMesh& mesh, Index vertex, std::vector<Coincidence>& found)
{
  const Point3& p = this->Points[vertex];
  if (Access::IsClaimed)
  {
    this->renewStart(mesh);
  }
  const Location at = this->locate<Access>(mesh, p);
  if (Access::IsShared && at.Cell == NoCell)
  {
    return false;
  }
  if (__builtin_expect(at.EqualTo != 0, 0))
  {
    found.push_back({ vertex, at.EqualTo });
    return true;
  }
  const bool isFound =
    this->claimFirst<Access>(mesh, p, at) && this->findConflicts<Access>(mesh, p);
  if (!isFound || (Access::IsShared && !this->takeRoom(mesh)))
  {
    this->setMarks<Access>(mesh, TetrahedronMesh::Live);
    return false;
  }
  if (!Access::IsShared)
  {
    this->makeRoom(mesh);
  }
  this->retriangulate<Access>(mesh, vertex);
  return true;
}

void Cavity3::insert(TetrahedronMesh& mesh, Index first, Index end, std::vector<Coincidence>& found)
{
  this->Claim = TetrahedronMesh::InConflict;
  runWithManyRegisters(Instructions::Best,
    [&]
    {
      for (Index vertex = first; vertex < end; ++vertex)
      {
        this->insertOne<AloneAccess3>(mesh, vertex, found);
      }
    });
}

void Cavity3::share(std::uint8_t thread, std::atomic<std::uint64_t>& end)
{
  this->Claim = static_cast<std::uint8_t>(TetrahedronMesh::Claimed + thread);
  this->SharedEnd = &end;
}

template <typename Access>
void Cavity3::insertEach(TetrahedronMesh& mesh, const Index* begin, const Index* end,
  std::vector<Index>& left, std::vector<Coincidence>& found)
{
  runWithManyRegisters(Instructions::Best,
    [&]
    {
      for (const Index* vertex = begin; vertex != end; ++vertex)
      {
        if (!this->insertOne<Access>(mesh, *vertex, found))
        {
          left.push_back(*vertex);
        }
      }
    });
}

void Cavity3::insertShared(TetrahedronMesh& mesh, const Index* begin, const Index* end,
  std::vector<Index>& left, std::vector<Coincidence>& found)
{
  this->insertEach<SharedAccess3>(mesh, begin, end, left, found);
}

void Cavity3::shareRegions(
  const std::uint8_t* regions, std::uint8_t region, std::atomic<std::uint64_t>& end)
{
  this->Claim = TetrahedronMesh::InConflict;
  this->SharedEnd = &end;
  this->Regions = regions;
  this->Region = region;
}

void Cavity3::insertInRegion(TetrahedronMesh& mesh, const Index* begin, const Index* end,
  std::vector<Index>& left, std::vector<Coincidence>& found)
{
  this->insertEach<RegionAccess3>(mesh, begin, end, left, found);
}

} // namespace tipp
