// SPDX-License-Identifier: BSD-3-Clause
#include "Kernel/DelaunayKernel3.h"

#include "Kernel/ParallelInsertion3.h"
#include "Predicates/ExactPredicates3.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

namespace tipp
{

/// Three points are collinear if their projections along all three axes are.
bool areCollinear(const Point3& a, const Point3& b, const Point3& c)
{
  return orientation({ a.x, a.y }, { b.x, b.y }, { c.x, c.y }) == 0 &&
    orientation({ a.y, a.z }, { b.y, b.z }, { c.y, c.z }) == 0 &&
    orientation({ a.z, a.x }, { b.z, b.x }, { c.z, c.x }) == 0;
}

bool DelaunayKernel3::triangulate(
  const Point3* points, std::size_t count, const Monitor& proceed, int threads, std::size_t more)
{
  this->Mesh.clear();
  this->Duplicates.clear();
  this->Coincidences.clear();
  this->Points.reserve(1 + count + more + 1);
  this->Points.resize(1);
  // So that no filter of a predicate decides for the vertex at infinity.
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  this->Points[0] = { none, none, none };
  this->PointIndices.reserve(1 + count + more);
  this->PointIndices.resize(1);
  this->append(points, count);
  if (!this->makeFirst())
  {
    return true;
  }
  // A uniform distribution makes seven tetrahedra per point, including a few free ones. Threads
  // cannot enlarge the mesh, so they get more.
  const std::size_t cellsPerPoint = threads > 1 ? 9 : 7;
  this->Mesh.reserve(cellsPerPoint * (count + more) + 64);
  if (!this->insertAll(proceed, threads))
  {
    this->Mesh.clear();
    this->Dimension = -1;
    return false;
  }
  this->takeCoincidences();
  return true;
}

void DelaunayKernel3::add(const Point3* points, std::size_t count)
{
  const Index first = this->vertexEnd();
  this->append(points, count);
  this->Opened.extend(this->Points.data(), this->Points.size());
  this->insertRange(first, this->vertexEnd(), {});
  this->takeCoincidences();
}

/// Adds vertices in the order of insertion.
void DelaunayKernel3::append(const Point3* points, std::size_t count)
{
  const std::size_t first = this->Points.size();
  const std::size_t before = first - 1; // points
  if (before + count >= std::size_t(1) << InsertionOrder3::IndexBits)
  {
    throw std::length_error("too many points for one partition: use more partitions");
  }
  this->Order.compute(points, count);
  this->Points.reserve(first + count + 1); // Cavity3 reads the number behind each point
  this->Points.resize(first + count);
  this->PointIndices.resize(first + count);
  for (std::size_t k = 0; k < count; ++k)
  {
    this->Points[first + k] = points[this->Order[k]];
    this->PointIndices[first + k] = static_cast<std::uint32_t>(before + this->Order[k]);
  }
  this->Order.release();
}

/// Moves four points that are not coplanar to the front, and makes their tetrahedron and its
/// infinite neighbours. Returns false if there are no such points.
bool DelaunayKernel3::makeFirst()
{
  this->Dimension = -1;
  const std::size_t end = this->Points.size();
  std::size_t next = 1;
  const auto& at = this->Points;
  // Finds the first point from `next` on that does not depend on those before `to`, and swaps it to
  // position `to`.
  const auto extend = [&](std::size_t to, const auto& isDependent)
  {
    while (next < end && isDependent(at[next]))
    {
      ++next;
    }
    if (next == end)
    {
      return false;
    }
    std::swap(this->Points[to], this->Points[next]);
    std::swap(this->PointIndices[to], this->PointIndices[next]);
    ++this->Dimension;
    ++next;
    return true;
  };
  if (!extend(1, [](const Point3&) { return false; }) ||
    !extend(2, [&](const Point3& p) { return p == at[1]; }) ||
    !extend(3, [&](const Point3& p) { return areCollinear(at[1], at[2], p); }) ||
    !extend(4, [&](const Point3& p) { return orientation3(at[1], at[2], at[3], p) == 0; }))
  {
    return false;
  }
  if (orientation3(at[1], at[2], at[3], at[4]) < 0)
  {
    std::swap(this->Points[1], this->Points[2]);
    std::swap(this->PointIndices[1], this->PointIndices[2]);
  }
  this->Mesh.reserve(64);
  Index* const slots = this->Mesh.slots();
  constexpr Index corners[5][4] = { { 1, 2, 3, 4 }, { Infinite, 2, 4, 3 }, { Infinite, 1, 3, 4 },
    { Infinite, 1, 4, 2 }, { Infinite, 1, 2, 3 } };
  for (Index t = 0; t < 5; ++t)
  {
    std::copy_n(corners[t], 4, slots + 8 * t);
    this->Mesh.marks()[t] = TetrahedronMesh::Live;
  }
  for (Index i = 0; i < 4; ++i)
  {
    // Infinite tetrahedron i + 1 is on the facet opposite to corner i, which is vertex i + 1.
    // Across its facet opposite to vertex v is infinite tetrahedron v, the one that lacks v.
    this->Mesh.link(i, 8 * (i + 1));
    for (Index j = 1; j < 4; ++j)
    {
      const Index other = corners[i + 1][j];
      const Index* const there = corners[other];
      const auto position = static_cast<Index>(std::find(there, there + 4, i + 1) - there);
      this->Mesh.link(8 * (i + 1) + j, 8 * other + position);
    }
  }
  this->Mesh.setEnd(40);
  return true;
}

/// Inserts vertices in this thread only. Returns false if `proceed` did.
bool DelaunayKernel3::insertRange(Index first, Index end, const Monitor& proceed)
{
  constexpr Index block = 1 << 12;
  for (; first < end; first += std::min(block, end - first))
  {
    if (proceed && !proceed(first))
    {
      return false;
    }
    this->Opened.insert(this->Mesh, first, std::min(end, first + block), this->Coincidences);
  }
  return true;
}

bool DelaunayKernel3::insertAll(const Monitor& proceed, int threads)
{
  this->Opened.restart(this->Points.data(), this->Points.size());
  std::optional<ParallelInsertion3> together;
  Index first = 5;
  for (const std::size_t last : this->Order.roundEnds())
  {
    const auto end = static_cast<Index>(last + 1);
    if (end <= first)
    {
      continue;
    }
    const bool isLarge = threads > 1 && end - first >= ParallelInsertion3::Few;
    if (isLarge && !together)
    {
      together.emplace(this->Mesh, this->Points.data(), this->Points.size(), this->Opened, threads);
    }
    if (!(isLarge ? together->insert(first, end, proceed, this->Coincidences)
                  : this->insertRange(first, end, proceed)))
    {
      return false;
    }
    first = end;
  }
  return true;
}

/// Makes the lowest index of the points at a vertex the vertex's point; the others become
/// duplicates.
void DelaunayKernel3::takeCoincidences()
{
  for (const Cavity3::Coincidence& found : this->Coincidences)
  {
    std::uint32_t point = this->PointIndices[found.Vertex];
    std::uint32_t& own = this->PointIndices[found.Representative];
    if (point < own)
    {
      std::swap(point, own);
    }
    this->Duplicates.push_back({ point, found.Representative });
  }
  this->Coincidences.clear();
}

void DelaunayKernel3::release()
{
  this->Mesh.release();
  Uninitialised<Point3>().swap(this->Points);
  Uninitialised<std::uint32_t>().swap(this->PointIndices);
  this->Duplicates = {};
  this->Coincidences = {};
  this->Opened = {};
  this->Dimension = -1;
}

std::size_t DelaunayKernel3::bytes() const
{
  return this->Mesh.bytes() + this->Points.capacity() * sizeof(Point3) +
    this->PointIndices.capacity() * sizeof(std::uint32_t);
}

} // namespace tipp
