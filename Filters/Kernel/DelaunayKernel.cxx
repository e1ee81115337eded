// SPDX-License-Identifier: BSD-3-Clause
#include "Kernel/DelaunayKernel.h"

#include <algorithm>
#include <limits>
#include <mutex>
#include <utility>

namespace tipp
{

DelaunayKernel::DelaunayKernel(Instructions instructions)
  : Order(instructions)
  , Allowed(instructions)
{
  this->clear();
}

void DelaunayKernel::clear()
{
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  this->Mesh.clear();
  this->Points.assign(1, Point2{ nan, nan });
  this->PointIndices.assign(1, 0);
  this->Duplicates.clear();
  this->PointEnd = 0;
  this->Pending = 1;
  this->Recent = 0;
}

void DelaunayKernel::reserve(std::size_t points)
{
  this->Mesh.reserve(2 * (points + 1));
  this->Points.reserve(points + 1);
  this->PointIndices.reserve(points + 1);
  this->Order.reserve(points);
}

std::size_t DelaunayKernel::bytes() const
{
  return this->Mesh.bytes() + this->Order.bytes() + this->Points.capacity() * sizeof(Point2) +
    this->PointIndices.capacity() * sizeof(std::uint32_t);
}

/// Adds points as vertices to be inserted. Returns false if there are no triangles yet.
bool DelaunayKernel::addVertices(const Point2* points, std::size_t count)
{
  this->Order.compute(points, count);
  const Index first = this->vertexEnd();
  this->Points.resize(this->Points.size() + count);
  this->PointIndices.resize(this->PointIndices.size() + count);
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::uint32_t point = this->Order[i];
    this->Points[first + i] = points[point];
    this->PointIndices[first + i] = this->PointEnd + point;
  }
  this->Order.releaseIfLarge();
  this->PointEnd += static_cast<std::uint32_t>(count);
  this->Predicates.restart(this->Points.data(), this->Points.size());

  // Euler's formula: n vertices and the infinite one have 2 n - 2 triangles. The cavity writes up
  // to one triangle beyond them.
  this->Mesh.reserve(2 * this->Points.size());
  return this->hasTriangles() || this->makeFirstTriangle(this->Pending);
}

bool DelaunayKernel::insert(const Point2* points, std::size_t count, const Monitor& proceed)
{
  if (!this->addVertices(points, count))
  {
    return true;
  }
  constexpr Index stride = 1 << 16;
  while (this->Pending < this->vertexEnd())
  {
    const Index end = std::min(this->vertexEnd(), this->Pending + stride);
    this->insertUpTo(end);
    if (end < this->vertexEnd() && proceed && !proceed(static_cast<std::size_t>(end) - 1))
    {
      return false;
    }
  }
  return true;
}

void DelaunayKernel::insertTwo(const Batch& one, const Batch& other)
{
  const bool isFirst = one.Kernel.addVertices(one.Points, one.Count);
  const bool isSecond = other.Kernel.addVertices(other.Points, other.Count);
  if (isFirst && isSecond)
  {
    insertInTurn(one.Kernel, other.Kernel);
  }
  else if (isFirst)
  {
    one.Kernel.insertUpTo(one.Kernel.vertexEnd());
  }
  else if (isSecond)
  {
    other.Kernel.insertUpTo(other.Kernel.vertexEnd());
  }
}

/// Finds three points that are not collinear, moves them to the front, and creates their triangle
/// and its three infinite neighbours. Returns false if all points are collinear.
bool DelaunayKernel::makeFirstTriangle(Index first)
{
  Index next = first + 1;
  // Finds the first vertex from `next` on that does not depend on those before `to`, and swaps it
  // to position `to`.
  const auto extend = [&](Index to, const auto& isDependent)
  {
    while (next < this->vertexEnd() && isDependent(this->Points[next]))
    {
      ++next;
    }
    if (next >= this->vertexEnd())
    {
      return false;
    }
    std::swap(this->Points[to], this->Points[next]);
    std::swap(this->PointIndices[to], this->PointIndices[next]);
    ++next;
    return true;
  };
  int turn = 0;
  if (!extend(first + 1, [&](Point2 p) { return p == this->Points[first]; }) ||
    !extend(first + 2,
      [&](Point2 p)
      {
        turn = orientation(this->Points[first], this->Points[first + 1], p);
        return turn == 0;
      }))
  {
    return false;
  }
  this->Pending = first + 3;

  const Index a = first;
  const Index b = turn > 0 ? first + 1 : first + 2;
  const Index c = turn > 0 ? first + 2 : first + 1;
  Index* slot = this->Mesh.slots();
  const Index corners[4][3] = { { a, b, c }, { Infinite, c, b }, { Infinite, a, c },
    { Infinite, b, a } };
  for (Index t = 0; t < 4; ++t)
  {
    for (Index i = 0; i < 3; ++i)
    {
      slot[8 * t + i] = corners[t][i];
    }
  }
  for (Index i = 0; i < 3; ++i)
  {
    this->Mesh.link(i, 8 * (i + 1));
    // The twin of edge (Infinite, w) of infinite triangle i + 1 = (Infinite, w, u) is edge (w,
    // Infinite) of the next infinite triangle, whose last corner is w.
    this->Mesh.link(8 * (i + 1) + 2, 8 * ((i + 1) % 3 + 1) + 1);
  }
  this->Mesh.setEnd(32);
  this->Recent = 0;
  return true;
}

namespace
{

/// Kernels that are not in use.
struct Pool
{
  Pool()
  {
    // Destructors return kernels to the pool, so returning one must not throw.
    constexpr std::size_t most = 64;
    this->Kernels.reserve(most);
  }

  std::mutex Mutex;
  std::vector<std::unique_ptr<DelaunayKernel>> Kernels;
  std::size_t Bytes = 0; ///< of all kernels
};

Pool& pool()
{
  static Pool one;
  return one;
}

} // namespace

PooledKernel::PooledKernel()
{
  {
    const std::lock_guard<std::mutex> lock(pool().Mutex);
    if (!pool().Kernels.empty())
    {
      this->Kernel = std::move(pool().Kernels.back());
      pool().Kernels.pop_back();
      pool().Bytes -= this->Kernel->bytes();
      return;
    }
  }
  this->Kernel = std::make_unique<DelaunayKernel>();
}

PooledKernel::~PooledKernel()
{
  const std::size_t bytes = this->Kernel->bytes();
  const std::lock_guard<std::mutex> lock(pool().Mutex);
  if (pool().Kernels.size() < pool().Kernels.capacity() && pool().Bytes + bytes <= MostBytesKept)
  {
    pool().Bytes += bytes;
    pool().Kernels.push_back(std::move(this->Kernel));
  }
}

std::size_t PooledKernel::bytesKept()
{
  const std::lock_guard<std::mutex> lock(pool().Mutex);
  return pool().Bytes;
}

} // namespace tipp
