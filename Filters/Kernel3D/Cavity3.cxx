// SPDX-License-Identifier: BSD-3-Clause
#include "Kernel3D/Cavity3.h"

#include "Kernel/Lanes.h"
#include "Predicates/ExactPredicates.h"

#include <algorithm>
#include <array>
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

/// The corners of the facet opposite to corner i, such that orientation3(p, ...) is that of the
/// tetrahedron with p instead of corner i.
constexpr Index FacetCorners[4][3] = { { 1, 2, 3 }, { 0, 3, 2 }, { 0, 1, 3 }, { 0, 2, 1 } };

inline Index positionOf(const Index* v, Index vertex)
{
  return Index(v[1] == vertex) + 2 * Index(v[2] == vertex) + 3 * Index(v[3] == vertex);
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
  this->Numbers.clear();
  this->EdgeTable.resize(MostInTable * MostInTable);
  this->extend(points, count);
}

void Cavity3::extend(const Point3* points, std::size_t count)
{
  this->Points = points;
  this->Predicates.restart(points, count);
  this->Numbers.resize(count, NoNumber);
}

/// Whether all finite vertices of a tetrahedron are in the territory.
inline bool Cavity3::isOwn(const Index* v) const
{
  const std::uint8_t* const owners = this->Within.Owners;
  const std::uint8_t own = this->Within.Own;
  return (v[0] == 0 || owners[v[0]] == own) && owners[v[1]] == own && owners[v[2]] == own &&
    owners[v[3]] == own;
}

/// Walks to a tetrahedron that contains the point. If the point is outside of the hull, the walk
/// ends at an infinite tetrahedron whose hull facet separates the point from the hull.
template <bool IsShared>
inline Cavity3::Location Cavity3::locate(const TetrahedronMesh& mesh, const Point3& p)
{
  const Index* const slots = mesh.slots();
  const Point3* const points = this->Points;
  Index cell = this->Recent;
  Index from = 4; // opposite to the facet that the walk crossed last; 4: none yet
  while (slots[cell] != 0)
  {
    const Index* const v = slots + cell;
    bool isOnFacet = false;
    Index next = 4;
    for (Index i = 0; i < 4 && next == 4; ++i)
    {
      if (i == from)
      {
        continue;
      }
      const Index* const f = FacetCorners[i];
      const int side =
        this->Predicates.orientation(p, points[v[f[0]]], points[v[f[1]]], points[v[f[2]]]);
      isOnFacet |= side == 0;
      next = side < 0 ? i : next;
    }
    if (next == 4)
    {
      for (Index i = 0; isOnFacet && i < 4; ++i)
      {
        if (points[v[i]] == p)
        {
          return { cell, v[i] };
        }
      }
      return { cell, 0 };
    }
    const Index across = v[next + 4];
    cell = TetrahedronMesh::cellOf(across);
    from = across & 3;
    if (IsShared && !this->isOwn(slots + cell))
    {
      return { NoCell, 0 };
    }
  }
  return { cell, 0 };
}

/// Tests p against the spheres of the four neighbours of a finite tetrahedron, in one vector. Bit i
/// of the result: p is certainly inside the sphere of neighbour i. Bit i of `certain`: the sign is
/// certain. Both bits are 0 for a neighbour at infinity.
//
// With the neighbour's apex e, and a, b, c from FacetCorners, orientation3(e, a, b, c) is negative,
// and so is the determinant of inSphereValue() if p is inside.
inline unsigned Cavity3::conflictsAcross(
  const Index* slots, Index cell, const Point3& p, unsigned& certain)
{
  const Index* const v = slots + cell;
  const Point3* const points = this->Points;
  const Point3& v0 = points[v[0]];
  const Point3& v1 = points[v[1]];
  const Point3& v2 = points[v[2]];
  const Point3& v3 = points[v[3]];
  const Index apexes[4] = { slots[v[4]], slots[v[5]], slots[v[6]], slots[v[7]] };
  const Point3& e0 = points[apexes[0]];
  const Point3& e1 = points[apexes[1]];
  const Point3& e2 = points[apexes[2]];
  const Point3& e3 = points[apexes[3]];
  const Quad x = Quad{ v0.x, v1.x, v2.x, v3.x } - p.x;
  const Quad y = Quad{ v0.y, v1.y, v2.y, v3.y } - p.y;
  const Quad z = Quad{ v0.z, v1.z, v2.z, v3.z } - p.z;
  const Quad ex = Quad{ e0.x, e1.x, e2.x, e3.x } - p.x;
  const Quad ey = Quad{ e0.y, e1.y, e2.y, e3.y } - p.y;
  const Quad ez = Quad{ e0.z, e1.z, e2.z, e3.z } - p.z;
  const Quad lift = x * x + y * y + z * z;
  const Quad eLift = ex * ex + ey * ey + ez * ez;
  const Quad ax = __builtin_shufflevector(x, x, 1, 0, 0, 0);
  const Quad ay = __builtin_shufflevector(y, y, 1, 0, 0, 0);
  const Quad az = __builtin_shufflevector(z, z, 1, 0, 0, 0);
  const Quad aLift = __builtin_shufflevector(lift, lift, 1, 0, 0, 0);
  const Quad bx = __builtin_shufflevector(x, x, 2, 3, 1, 2);
  const Quad by = __builtin_shufflevector(y, y, 2, 3, 1, 2);
  const Quad bz = __builtin_shufflevector(z, z, 2, 3, 1, 2);
  const Quad bLift = __builtin_shufflevector(lift, lift, 2, 3, 1, 2);
  const Quad cx = __builtin_shufflevector(x, x, 3, 2, 3, 1);
  const Quad cy = __builtin_shufflevector(y, y, 3, 2, 3, 1);
  const Quad cz = __builtin_shufflevector(z, z, 3, 2, 3, 1);
  const Quad cLift = __builtin_shufflevector(lift, lift, 3, 2, 3, 1);
  const Quad ab = ax * by - bx * ay;
  const Quad bc = bx * cy - cx * by;
  const Quad ac = ax * cy - cx * ay;
  const Quad ea = ex * ay - ax * ey;
  const Quad eb = ex * by - bx * ey;
  const Quad ec = ex * cy - cx * ey;
  const Quad abc = az * bc - bz * ac + cz * ab;
  const Quad ebc = ez * bc - bz * ec + cz * eb;
  const Quad eac = ez * ac - az * ec + cz * ea;
  const Quad eab = ez * ab - az * eb + bz * ea;
  const Quad determinant = (eLift * abc - aLift * ebc) + (bLift * eac - cLift * eab);
  // The same error bound as in isCertain().
  const Quad lifts = (eLift + aLift) + (bLift + cLift);
  const Quad square = lifts * lifts;
  const Quad bound = (9 * 0x1p-106) * (square * square) * lifts + 1e-280;
  certain = bitsOfLanes(determinant * determinant > bound);
  for (unsigned i = 0; i < 4; ++i)
  {
    certain &= ~(unsigned(apexes[i] == 0) << i);
  }
  return certain & bitsOfLanes(determinant < 0);
}

/// Finds the tetrahedra in conflict with p (the cavity), starting from `found`, and the cavity's
/// boundary. Returns false if the cavity leaves the territory.
template <bool IsShared>
inline bool Cavity3::findConflicts(TetrahedronMesh& mesh, const Point3& p, Index found)
{
  const Index* const slots = mesh.slots();
  std::uint8_t* const marks = mesh.marks();
  this->Removed.assign(1, found);
  this->Boundary.clear();
  marks[found / 8] = TetrahedronMesh::InConflict;
  for (std::size_t k = 0; k < this->Removed.size(); ++k)
  {
    const Index cell = this->Removed[k];
    unsigned certain = 0;
    const unsigned inside = slots[cell] != 0 ? this->conflictsAcross(slots, cell, p, certain) : 0;
    for (Index i = 0; i < 4; ++i)
    {
      const Index across = slots[cell + i + 4];
      const Index beyond = TetrahedronMesh::cellOf(across);
      if (marks[beyond / 8] == TetrahedronMesh::InConflict)
      {
        continue;
      }
      bool isIn = (inside >> i & 1) != 0;
      if (__builtin_expect((certain >> i & 1) == 0, 0))
      {
        isIn = slots[beyond] != 0 ? this->Predicates.isInFiniteConflict(slots + beyond, p)
                                  : this->Predicates.isInInfiniteConflict(slots, beyond, p);
      }
      if (isIn)
      {
        if (IsShared && !this->isOwn(slots + beyond))
        {
          return false;
        }
        marks[beyond / 8] = TetrahedronMesh::InConflict;
        this->Removed.push_back(beyond);
      }
      else
      {
        this->Boundary.push_back({ cell + i, across, 0 });
      }
    }
  }
  return true;
}

/// Reserves as many free tetrahedra as the boundary has facets. Throws std::length_error if indices
/// do not suffice.
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
  const std::uint64_t most =
    std::min<std::uint64_t>(mesh.capacity(), TetrahedronMesh::MostSlots / 8);
  while (this->Free.size() < this->Boundary.size())
  {
    const std::uint64_t begin = this->Within.End->fetch_add(8 * together);
    if (begin / 8 + together > most)
    {
      this->Within.End->fetch_sub(8 * together);
      return false;
    }
    for (std::uint64_t cell = begin / 8; cell < begin / 8 + together; ++cell)
    {
      mesh.marks()[cell] = TetrahedronMesh::Free;
      this->Free.push_back(Index(8 * cell));
    }
  }
  return true;
}

/// Makes a tetrahedron for each facet of the boundary: a copy of the removed one, whose corner
/// opposite to the facet is replaced by `vertex`.
inline void Cavity3::makeCells(TetrahedronMesh& mesh, Index vertex)
{
  Index* const slots = mesh.slots();
  const Index* free = this->Free.data() + this->Free.size();
  for (Facet& facet : this->Boundary)
  {
    const Index old = TetrahedronMesh::cellOf(facet.Inside);
    const Index i = facet.Inside & 3;
    const Index made = *--free;
    for (Index corner = 0; corner < 4; ++corner)
    {
      slots[made + corner] = slots[old + corner];
    }
    slots[made + i] = vertex;
    slots[made + i + 4] = facet.Outside;
    slots[facet.Outside + 4] = made + i;
    mesh.marks()[made / 8] = TetrahedronMesh::Live;
    facet.Made = made;
  }
  this->Free.resize(this->Free.size() - this->Boundary.size());
}

/// Links new tetrahedra by a table of the boundary's edges: two of them are neighbours if their
/// facets share an edge, which they traverse in opposite directions. Returns false if the boundary
/// has too many vertices for the table.
inline bool Cavity3::linkByEdges(TetrahedronMesh& mesh)
{
  // A triangulated sphere of n vertices has 2 n - 4 facets.
  if (this->Boundary.size() > 2 * MostInTable - 4)
  {
    return false;
  }
  Index* const slots = mesh.slots();
  std::array<Index, MostInTable + 1> vertices;
  unsigned count = 0;
  std::array<std::array<std::uint16_t, 3>, 2 * MostInTable> edges;
  for (std::size_t k = 0; k < this->Boundary.size(); ++k)
  {
    const Index made = this->Boundary[k].Made;
    const Index* const f = FacetCorners[this->Boundary[k].Inside & 3];
    std::array<unsigned, 3> numbers;
    for (std::size_t i = 0; i < 3; ++i)
    {
      const Index v = slots[made + f[i]];
      const unsigned known = this->Numbers[v];
      const bool isNew = known == NoNumber;
      vertices[count] = v;
      numbers[i] = isNew ? count : known;
      this->Numbers[v] = static_cast<std::uint8_t>(numbers[i]);
      count += isNew ? 1 : 0;
    }
    for (std::size_t i = 0; i < 3; ++i)
    {
      const unsigned from = numbers[(i + 1) % 3];
      const unsigned to = numbers[(i + 2) % 3];
      this->EdgeTable[from * MostInTable + to] = made + f[i];
      edges[k][i] = static_cast<std::uint16_t>(to * MostInTable + from);
    }
  }
  for (std::size_t k = 0; k < this->Boundary.size(); ++k)
  {
    const Index made = this->Boundary[k].Made;
    const Index* const f = FacetCorners[this->Boundary[k].Inside & 3];
    for (std::size_t i = 0; i < 3; ++i)
    {
      slots[made + f[i] + 4] = this->EdgeTable[edges[k][i]];
    }
  }
  for (unsigned i = 0; i < count; ++i)
  {
    this->Numbers[vertices[i]] = NoNumber;
  }
  return true;
}

/// Does the same for any number of vertices: starts at a facet of a new tetrahedron, and goes
/// around its edge through removed tetrahedra to the neighbour's facet.
[[gnu::noinline]] void Cavity3::linkAround(TetrahedronMesh& mesh)
{
  Index* const slots = mesh.slots();
  std::uint8_t* const marks = mesh.marks();
  // Let each removed tetrahedron refer to the new one on its facet.
  for (const Facet& facet : this->Boundary)
  {
    slots[facet.Inside + 4] = facet.Made + (facet.Inside & 3);
    marks[facet.Made / 8] = TetrahedronMesh::New;
  }
  for (const Facet& facet : this->Boundary)
  {
    for (Index j = 0; j < 4; ++j)
    {
      if (j == (facet.Inside & 3))
      {
        continue;
      }
      Index cell = TetrahedronMesh::cellOf(facet.Inside);
      Index before = facet.Inside & 3; // opposite to the facet that was crossed last
      Index after = j;                 // opposite to the facet to cross next
      Index across = slots[cell + after + 4];
      while (marks[across / 8] != TetrahedronMesh::New)
      {
        const Index carried = slots[cell + before];
        cell = TetrahedronMesh::cellOf(across);
        before = across & 3;
        after = positionOf(slots + cell, carried);
        across = slots[cell + after + 4];
      }
      slots[facet.Made + j + 4] = TetrahedronMesh::cellOf(across) + before;
    }
  }
  for (const Facet& facet : this->Boundary)
  {
    marks[facet.Made / 8] = TetrahedronMesh::Live;
  }
}

/// Fills the cavity that findConflicts() has found with new tetrahedra.
inline void Cavity3::retriangulate(TetrahedronMesh& mesh, Index vertex)
{
  this->makeCells(mesh, vertex);
  if (!this->linkByEdges(mesh))
  {
    this->linkAround(mesh);
  }
  std::uint8_t* const marks = mesh.marks();
  for (const Index removed : this->Removed)
  {
    marks[removed / 8] = TetrahedronMesh::Free;
  }
  this->Free.insert(this->Free.end(), this->Removed.begin(), this->Removed.end());
  // The walk to the next vertex must start at a finite tetrahedron.
  const Index* const slots = mesh.slots();
  std::size_t last = this->Boundary.size() - 1;
  while (slots[this->Boundary[last].Made] == 0)
  {
    --last;
  }
  this->Recent = this->Boundary[last].Made;
}

inline void Cavity3::insertAll(
  TetrahedronMesh& mesh, Index first, Index end, std::vector<Coincidence>& found)
{
  for (Index vertex = first; vertex < end; ++vertex)
  {
    const Location at = this->locate<false>(mesh, this->Points[vertex]);
    if (__builtin_expect(at.EqualTo != 0, 0))
    {
      found.push_back({ vertex, at.EqualTo });
      continue;
    }
    this->findConflicts<false>(mesh, this->Points[vertex], at.Cell);
    this->makeRoom(mesh);
    this->retriangulate(mesh, vertex);
  }
}

/// Returns false, and changes nothing, if the vertex cannot be inserted within the territory.
inline bool Cavity3::insertOne(TetrahedronMesh& mesh, Index vertex, std::vector<Coincidence>& found)
{
  const Location at = this->locate<true>(mesh, this->Points[vertex]);
  if (at.Cell == NoCell)
  {
    return false;
  }
  if (at.EqualTo != 0)
  {
    found.push_back({ vertex, at.EqualTo });
    return true;
  }
  if (!this->findConflicts<true>(mesh, this->Points[vertex], at.Cell) || !this->takeRoom(mesh))
  {
    for (const Index cell : this->Removed)
    {
      mesh.marks()[cell / 8] = TetrahedronMesh::Live;
    }
    return false;
  }
  this->retriangulate(mesh, vertex);
  return true;
}

void Cavity3::insert(TetrahedronMesh& mesh, Index first, Index end, std::vector<Coincidence>& found)
{
  runWith(Instructions::Best, [&] { this->insertAll(mesh, first, end, found); });
}

/// Continues at another start of the territory. The current tetrahedra may be an island that no
/// walk leaves. A start may have been removed meanwhile, but no other thread changes it.
void Cavity3::moveOn(const TetrahedronMesh& mesh)
{
  const std::vector<Index>& starts = *this->Within.Starts;
  for (std::size_t i = 0; i < starts.size(); ++i)
  {
    const Index start = starts[this->NextStart++ % starts.size()];
    const Index* const v = mesh.slots() + start;
    if (mesh.marks()[start / 8] == TetrahedronMesh::Live && v[0] != 0 && this->isOwn(v))
    {
      this->Recent = start;
      return;
    }
  }
}

void Cavity3::insertWithin(TetrahedronMesh& mesh, const Index* begin, const Index* end,
  std::vector<Index>& left, std::vector<Coincidence>& found)
{
  runWith(Instructions::Best,
    [&]
    {
      for (const Index* vertex = begin; vertex != end; ++vertex)
      {
        if (this->insertOne(mesh, *vertex, found))
        {
          this->Failures = 0;
          continue;
        }
        left.push_back(*vertex);
        // The walk from another start is long, so move on less and less often.
        constexpr std::size_t patience = 64;
        if (++this->Failures >= patience && (this->Failures & (this->Failures - 1)) == 0)
        {
          this->moveOn(mesh);
        }
      }
    });
}

} // namespace tipp
