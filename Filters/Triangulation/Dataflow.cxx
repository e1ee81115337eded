// SPDX-License-Identifier: BSD-3-Clause
#include "Triangulation/Dataflow.h"

#include <cmath>

namespace tipp
{
namespace
{

using Index = DelaunayKernel::Index;

/// The largest closed box such that disks inside it do not touch the boxes around `box`.
Box2 openBox(const Box2& box)
{
  return { { std::nextafter(box.Min.x, HUGE_VAL), std::nextafter(box.Min.y, HUGE_VAL) },
    { std::nextafter(box.Max.x, -HUGE_VAL), std::nextafter(box.Max.y, -HUGE_VAL) } };
}

} // namespace

template <typename Id>
Worker<Id>::Worker(
  const Tiling& tiling, PointBuckets<Id>& buckets, std::int64_t firstId, PartitionIndex firstBucket)
  : Boxes(tiling)
  , Buckets(buckets)
  , FirstId(firstId)
  , FirstBucket(firstBucket)
  , Kernel(*this->Pooled)
{
  // Memory for the largest partition and its inbox at once, because fresh memory takes time.
  std::size_t largest = 0;
  for (PartitionIndex bucket = 0; bucket < this->Buckets.partitions(); ++bucket)
  {
    largest = std::max(largest, this->Buckets.count(bucket));
  }
  constexpr std::size_t few = 1024;
  const std::size_t vertices = largest + largest / 8 + few;
  this->Kernel.reserve(vertices);
  this->Ids.reserve(largest);
  this->VertexIds.reserve(vertices + 1);
  this->IsBoundary.reserve(2 * vertices);
}

template <typename Id>
void Worker<Id>::triangulate(PartitionIndex partition, std::vector<BoundaryVertex>&& vertices,
  const Box2& region, BoundaryConsumer& boundary)
{
  this->begin(partition, std::move(vertices));
  this->insertPoints();
  this->finish(region, boundary);
}

template <typename Id>
void Worker<Id>::begin(PartitionIndex partition, std::vector<BoundaryVertex>&& vertices)
{
  this->Partition = partition;
  this->separateGhosts(std::move(vertices));
  this->Buckets.copyIds(this->bucket(partition), this->Ids);
  this->Kernel.clear();
}

template <typename Id>
DelaunayKernel::Batch Worker<Id>::ownPoints() const
{
  const PartitionIndex bucket = this->bucket(this->Partition);
  return { this->Kernel, this->Buckets.points(bucket), this->Buckets.count(bucket) };
}

template <typename Id>
void Worker<Id>::insertPoints()
{
  const DelaunayKernel::Batch own = this->ownPoints();
  this->Kernel.insert(own.Points, own.Count);
}

template <typename Id>
void Worker<Id>::insertPoints(Worker& one, Worker& other)
{
  DelaunayKernel::insertTwo(one.ownPoints(), other.ownPoints());
}

template <typename Id>
void Worker<Id>::finish(const Box2& region, BoundaryConsumer& boundary)
{
  // The partition's own points have been inserted first, so that their interior triangles do not
  // depend on other points.
  this->Kernel.insert(this->GhostPoints.data(), this->GhostPoints.size());
  // Small buffers are kept for the next partition.
  const bool isLarge = this->Kernel.bytes() > PooledKernel::MostBytesKept;
  if (isLarge)
  {
    std::vector<Point2>().swap(this->GhostPoints);
  }
  this->VertexCount = static_cast<std::size_t>(this->Kernel.vertexEnd()) - 1;
  this->resolveDuplicates();
  boundary.begin(this->Kernel.vertexEnd());
  this->findBoundary(this->Boxes.box(this->Partition), region, boundary);
  this->setVertexIds();
  this->edit();
  this->writeTriangles(this->bucket(this->Partition),
    [this](Index t) { return !this->IsBoundary[DelaunayKernel::number(t)]; });
  if (isLarge)
  {
    this->Kernel.releaseTriangles();
  }
}

template <typename Id>
bool Worker<Id>::triangulateAlone(const DelaunayKernel::Monitor& proceed)
{
  this->Partition = 0;
  this->KnownIds.clear();
  this->Buckets.copyIds(0, this->Ids);
  this->Kernel.clear();
  if (!this->Kernel.insert(this->Buckets.points(0), this->Buckets.count(0), proceed))
  {
    return false;
  }
  this->VertexCount = static_cast<std::size_t>(this->Kernel.vertexEnd()) - 1;
  this->resolveDuplicates();
  this->setVertexIds();
  if (this->Editor)
  {
    this->Border.clear();
    this->IsBoundary.clear();
    this->Kernel.forEach(
      [this](Index t) { this->IsBoundary.push_back(this->Kernel.isInfinite(t)); });
    this->edit();
  }
  this->writeTriangles(0, [this](Index t) { return !this->Kernel.isInfinite(t); });
  return true;
}

/// Separates the inbox's vertices: vertices of other partitions become ghosts; own points are only
/// recorded as known to other partitions.
template <typename Id>
void Worker<Id>::separateGhosts(std::vector<BoundaryVertex>&& vertices)
{
  this->Ghosts = std::move(vertices);
  this->KnownIds.clear();
  this->GhostPoints.clear();
  std::size_t kept = 0;
  for (const BoundaryVertex& v : this->Ghosts)
  {
    if (v.Partition == this->Partition && !v.isArtificial())
    {
      this->KnownIds.push_back(v.Id - this->FirstId);
    }
    else
    {
      this->GhostPoints.push_back(v.Position);
      this->Ghosts[kept++] = v;
    }
  }
  this->Ghosts.resize(kept);
  std::sort(this->KnownIds.begin(), this->KnownIds.end());
}

template <typename Id>
void Worker<Id>::resolveDuplicates()
{
  this->Duplicates.clear();
  Id* ids = this->Ids.data();
  const auto isKnown = [this](Id id)
  { return std::binary_search(this->KnownIds.begin(), this->KnownIds.end(), std::int64_t(id)); };
  const auto& found = this->Kernel.duplicates();
  for (const DelaunayKernel::Duplicate& duplicate : found)
  {
    Id& id = ids[duplicate.Point];
    Id& representative = ids[this->Kernel.pointIndex(duplicate.Vertex)];
    if (isKnown(id) || (id < representative && !isKnown(representative)))
    {
      std::swap(id, representative);
    }
  }
  for (const DelaunayKernel::Duplicate& duplicate : found)
  {
    this->Duplicates.push_back({ this->FirstId + ids[duplicate.Point],
      this->FirstId + ids[this->Kernel.pointIndex(duplicate.Vertex)] });
  }
}

template <typename Id>
BoundaryVertex Worker<Id>::vertex(PartitionIndex partition, Index v) const
{
  const std::size_t point = this->Kernel.pointIndex(v);
  const std::size_t own = this->Ids.size();
  if (point >= own)
  {
    return this->Ghosts[point - own];
  }
  return { this->Kernel.point(v), this->FirstId + this->Ids[point], partition };
}

/// Visits the triangles whose circumdisk is not inside the partition. They are connected: each
/// point outside has a cavity that is connected, and on a path outside from point to point the
/// cavity changes by one neighbouring triangle at a time. So only these and the interior triangles
/// adjacent to them are visited. The latter include one at each outermost vertex of the interior
/// triangles, because not all triangles around such a vertex are interior.
template <typename Id>
void Worker<Id>::findBoundary(const Box2& box, const Box2& region, BoundaryConsumer& boundary)
{
  const Box2 open = openBox(box);
  this->IsBoundary.assign(this->Kernel.triangleCount(), 0);
  this->Border.clear();
  std::size_t first = 0;
  while (!this->Kernel.isInfinite(DelaunayKernel::triangle(first)))
  {
    ++first;
  }
  this->Stack.assign(1, DelaunayKernel::triangle(first));
  this->IsBoundary[first] = 1;
  while (!this->Stack.empty())
  {
    const Index t = this->Stack.back();
    this->Stack.pop_back();
    for (Index i = 0; i < 3; ++i)
    {
      const Index neighbour = this->Kernel.neighbour(t, i);
      char& isBoundary = this->IsBoundary[DelaunayKernel::number(neighbour)];
      if (isBoundary)
      {
        continue;
      }
      if (!this->Kernel.isInfinite(neighbour))
      {
        const std::array<Index, 3> v = this->Kernel.corners(neighbour);
        const Circumdisk disk(
          this->Kernel.point(v[0]), this->Kernel.point(v[1]), this->Kernel.point(v[2]));
        if (disk.inside(open))
        {
          if (this->Editor)
          {
            this->Border.push_back({ t, i });
          }
          continue;
        }
        if (disk.meets(region))
        {
          boundary.add(v, disk);
        }
      }
      isBoundary = 1;
      this->Stack.push_back(neighbour);
    }
  }
}

template <typename Id>
void Worker<Id>::setVertexIds()
{
  // Each vertex has about six triangles, which are close together in memory, but its point may be
  // anywhere.
  const std::size_t own = this->Ids.size();
  this->VertexIds.resize(static_cast<std::size_t>(this->Kernel.vertexEnd()));
  for (std::size_t v = 1; v < this->VertexIds.size(); ++v)
  {
    const std::size_t point = this->Kernel.pointIndex(static_cast<Index>(v));
    this->VertexIds[v] = point < own ? this->Ids[point] : Id(-1);
  }
}

template <typename Id>
void Worker<Id>::edit()
{
  if (this->Editor)
  {
    this->Editor->edit(PartitionEditor::Partition<Id>{ this->bucket(this->Partition), this->Kernel,
      this->VertexIds.data(), this->IsBoundary.data(), this->Border });
  }
}

template <typename Id>
template <typename IsInterior>
void Worker<Id>::writeTriangles(PartitionIndex bucket, const IsInterior& isInterior)
{
  const Id* const ids = this->VertexIds.data();
  Id* const interior = this->Buckets.triangles(bucket);
  Id* out = interior;
  this->Kernel.forEach(
    [&](Index t)
    {
      if (isInterior(t))
      {
        for (const Index v : this->Kernel.corners(t))
        {
          *out++ = ids[v];
        }
      }
    });
  this->InteriorCount = static_cast<std::size_t>(out - interior) / 3;
}

template class Worker<std::int32_t>;
template class Worker<std::int64_t>;

std::vector<BoundaryVertex> UniqueVertices::collect(const std::vector<VertexMessage>& messages)
{
  std::size_t count = 0;
  for (const VertexMessage& message : messages)
  {
    count += message.Vertices.size();
  }
  this->Known.clear();
  std::vector<BoundaryVertex> vertices;
  vertices.reserve(count);
  for (const VertexMessage& message : messages)
  {
    for (const BoundaryVertex& v : message.Vertices)
    {
      if (this->Known.insert(v.Id).IsNew)
      {
        vertices.push_back(v);
      }
    }
  }
  return vertices;
}

} // namespace tipp
