// SPDX-License-Identifier: BSD-3-Clause
#include "InitialScene.h"

#include "ExactDisk.h"
#include "Triangulation/Dataflow.h"
#include "Triangulation/InitialMesh.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

namespace
{

using namespace tipp;
using namespace tipp::test;

using Interior = std::vector<std::int32_t>;

Interior interiorOf(
  PointBuckets<std::int32_t>& buckets, PartitionIndex p, const Worker<std::int32_t>& worker)
{
  const std::int32_t* const ids = buckets.triangles(p);
  return Interior(ids, ids + 3 * worker.interiorCount());
}

/// Collects a partition's boundary triangles, and the boxes of a tiling that their circumdisks
/// meet.
class Boundary : public BoundaryConsumer
{
public:
  explicit Boundary(const Tiling& boxes)
    : Boxes(boxes)
  {
  }

  void begin(DelaunayKernel::Index) override { this->Found.clear(); }

  void add(const std::array<DelaunayKernel::Index, 3>& corners, const Circumdisk& disk) override
  {
    this->Found.push_back({ corners, {} });
    this->Boxes.visitMet(
      disk, [this](PartitionIndex p) { this->Found.back().second.push_back(p); });
  }

  using Met = std::vector<PartitionIndex>;
  std::vector<std::pair<BoundaryTriangle, Met>> triangles(
    const Worker<std::int32_t>& worker, PartitionIndex p) const
  {
    std::vector<std::pair<BoundaryTriangle, Met>> triangles;
    for (const auto& [corners, met] : this->Found)
    {
      triangles.push_back({ { worker.vertex(p, corners[0]), worker.vertex(p, corners[1]),
                              worker.vertex(p, corners[2]) },
        met });
    }
    return triangles;
  }

private:
  const Tiling& Boxes;
  std::vector<std::pair<std::array<DelaunayKernel::Index, 3>, Met>> Found;
};

/// The triangles whose circumdisks meet unfinished partitions, and the final triangles.
class UnfinishedMesh
{
public:
  void add(const BoundaryTriangles& triangles)
  {
    for (std::size_t i = 0; i < triangles.size(); ++i)
    {
      this->Entries.push_back({ triangles[i], { triangles.metBegin(i), triangles.metEnd(i) } });
    }
  }

  void add(const std::vector<std::pair<BoundaryTriangle, Boundary::Met>>& triangles)
  {
    for (const auto& [triangle, met] : triangles)
    {
      this->Entries.push_back({ triangle, met });
    }
  }

  /// Removes the triangles whose circumdisks meet partition p. The caller then adds the worker's
  /// triangles, which replace them.
  void finish(PartitionIndex p)
  {
    this->Entries.erase(std::remove_if(this->Entries.begin(), this->Entries.end(),
                          [p](const Entry& entry) { return entry.meets(p); }),
      this->Entries.end());
  }

  std::vector<BoundaryTriangle> thoseMeeting(PartitionIndex p) const
  {
    std::vector<BoundaryTriangle> triangles;
    for (const Entry& entry : this->Entries)
    {
      if (entry.meets(p))
      {
        triangles.push_back(entry.Triangle);
      }
    }
    return triangles;
  }

  /// All triangles. Once all partitions are finished, these are the final ones.
  std::vector<BoundaryTriangle> all() const
  {
    std::vector<BoundaryTriangle> triangles;
    for (const Entry& entry : this->Entries)
    {
      triangles.push_back(entry.Triangle);
    }
    return triangles;
  }

private:
  struct Entry
  {
    BoundaryTriangle Triangle;
    std::vector<PartitionIndex> Met;

    bool meets(PartitionIndex p) const
    {
      return std::find(this->Met.begin(), this->Met.end(), p) != this->Met.end();
    }
  };

  std::vector<Entry> Entries;
};

std::vector<BoundaryVertex> uniqueVertices(const std::vector<BoundaryTriangle>& triangles)
{
  std::vector<BoundaryVertex> vertices;
  for (const BoundaryTriangle& triangle : triangles)
  {
    vertices.insert(vertices.end(), triangle.begin(), triangle.end());
  }
  std::sort(vertices.begin(), vertices.end(),
    [](const BoundaryVertex& a, const BoundaryVertex& b) { return a.Id < b.Id; });
  vertices.erase(std::unique(vertices.begin(), vertices.end(),
                   [](const BoundaryVertex& a, const BoundaryVertex& b) { return a.Id == b.Id; }),
    vertices.end());
  return vertices;
}

/// Triangulates partitions one after the other, and keeps the mesh between them.
class WorkerRun
{
public:
  WorkerRun(const std::string& set, std::size_t count, int side)
    : Scene(set, count, side, side)
    , Work(this->Scene.Boxes, this->Scene.Buckets)
    , XY(this->Scene.XY)

  {
    this->Mesh.add(this->Scene.Mesh);
    // In XY the artificial points follow the true ones, so that an index into XY identifies either.
    for (const BoundaryVertex& v : this->Scene.Artificial)
    {
      this->Inserted.push_back(std::int64_t(this->XY.size() / 2));
      this->XY.insert(this->XY.end(), { v.Position.x, v.Position.y });
    }
    for (const BoundaryVertex& v : this->Scene.Vertices)
    {
      if (!v.isArtificial())
      {
        this->Inserted.push_back(v.Id);
      }
    }
  }

  PartitionIndex partitions() const { return this->Scene.Boxes.size(); }

  Interior triangulate(PartitionIndex p)
  {
    std::vector<std::int32_t> ids;
    this->Scene.Buckets.copyIds(p, ids);
    this->Inserted.insert(this->Inserted.end(), ids.begin(), ids.end());
    std::sort(this->Inserted.begin(), this->Inserted.end());
    this->Inserted.erase(
      std::unique(this->Inserted.begin(), this->Inserted.end()), this->Inserted.end());
    Boundary boundary(this->Scene.Boxes);
    this->Work.triangulate(
      p, uniqueVertices(this->Mesh.thoseMeeting(p)), this->Scene.Boxes.box(p), boundary);
    this->Mesh.finish(p);
    this->BoundaryTriangles = boundary.triangles(this->Work, p);
    this->Mesh.add(this->BoundaryTriangles);
    return interiorOf(this->Scene.Buckets, p, this->Work);
  }

  std::int64_t idIn(const BoundaryVertex& v) const
  {
    return v.isArtificial() ? std::int64_t(this->Scene.XY.size() / 2) - 1 - v.Id : v.Id;
  }

  /// The interior and boundary triangles of the last partition, as indices into XY.
  Triangles made(const Interior& interior) const
  {
    std::vector<BoundaryTriangle> boundary;
    for (const auto& entry : this->BoundaryTriangles)
    {
      boundary.push_back(entry.first);
    }
    Triangles all = this->inXY(boundary);
    for (std::size_t i = 0; i < interior.size(); i += 3)
    {
      all.push_back(canonical(interior[i], interior[i + 1], interior[i + 2]));
    }
    return sorted(std::move(all));
  }

  Triangles inXY(const std::vector<BoundaryTriangle>& boundary) const
  {
    Triangles all;
    for (const BoundaryTriangle& t : boundary)
    {
      all.push_back(canonical(this->idIn(t[0]), this->idIn(t[1]), this->idIn(t[2])));
    }
    return all;
  }

  InitialScene Scene;
  UnfinishedMesh Mesh;
  Worker<std::int32_t> Work;
  std::vector<std::pair<BoundaryTriangle, Boundary::Met>>
    BoundaryTriangles; ///< of the last partition
  Coordinates XY;
  Ids Inserted;
};

class WorkerOn : public testing::TestWithParam<std::string>
{
};

/// Lemma 1.
TEST_P(WorkerOn, MakesTheTrianglesThatBelongToItsPartition)
{
  WorkerRun run(GetParam(), 250, 3);
  for (PartitionIndex p = 0; p < run.partitions(); ++p)
  {
    const Triangles made = run.made(run.triangulate(p));
    const Box2& box = run.Scene.Boxes.box(p);
    ASSERT_TRUE(sameTriangles(run.XY, made,
      belonging(
        run.XY, delaunay(run.XY, run.Inserted), { box.Min.x, box.Min.y, box.Max.x, box.Max.y })))
      << "partition " << p;
  }
}

/// Lemma 2: when all partitions are done, the final triangles are the whole triangulation.
TEST_P(WorkerOn, InteriorTrianglesAndFinalBoundaryTrianglesAreTheTriangulation)
{
  WorkerRun run(GetParam(), 800, 4);
  Triangles all;
  for (PartitionIndex p = 0; p < run.partitions(); ++p)
  {
    const Interior interior = run.triangulate(p);
    for (std::size_t i = 0; i < interior.size(); i += 3)
    {
      all.push_back(canonical(interior[i], interior[i + 1], interior[i + 2]));
    }
  }
  const Triangles boundary = run.inXY(run.Mesh.all());
  all.insert(all.end(), boundary.begin(), boundary.end());
  EXPECT_TRUE(sameTriangles(run.XY, sorted(std::move(all)), delaunay(run.XY, run.Inserted)));
}

/// The interior triangles and their order are the same if the partition is first, last or between.
TEST_P(WorkerOn, InteriorTrianglesDoNotDependOnTheSchedule)
{
  std::vector<std::vector<Interior>> runs;
  for (int schedule = 0; schedule < 3; ++schedule)
  {
    WorkerRun run(GetParam(), 1500, 3);
    std::vector<PartitionIndex> order(std::size_t(run.partitions()));
    std::iota(order.begin(), order.end(), 0);
    if (schedule > 0)
    {
      std::reverse(order.begin(), order.end());
      std::rotate(order.begin(), order.begin() + 4 * (schedule - 1), order.end());
    }
    std::vector<Interior> interiors(order.size());
    for (const PartitionIndex p : order)
    {
      interiors[std::size_t(p)] = run.triangulate(p);
    }
    runs.push_back(interiors);
  }
  EXPECT_EQ(runs[0], runs[1]);
  EXPECT_EQ(runs[0], runs[2]);
}

/// The circumdisk lies inside the partition, so it meets no other one.
TEST_P(WorkerOn, InteriorTrianglesBelongToNoOtherPartition)
{
  WorkerRun run(GetParam(), 1000, 3);
  for (PartitionIndex p = 0; p < run.partitions(); ++p)
  {
    const Interior interior = run.triangulate(p);
    const std::vector<Point2> points = asPoints(run.XY);
    for (std::size_t i = 0; i < interior.size(); i += 3)
    {
      const Circumdisk disk(points[std::size_t(interior[i])], points[std::size_t(interior[i + 1])],
        points[std::size_t(interior[i + 2])]);
      std::vector<PartitionIndex> met;
      run.Scene.Boxes.visitMet(disk, [&](PartitionIndex q) { met.push_back(q); });
      ASSERT_EQ(std::vector<PartitionIndex>{ p }, met);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(PointSets, WorkerOn,
  testing::Values("uniform", "clustered", "lattice-shuffled", "lattice-tenths", "survey-lines"),
  [](const auto& info)
  {
    std::string name = info.param;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
  });

TEST(Worker, CountsItsOwnPointsAndTheVerticesAround)
{
  WorkerRun run("uniform", 500, 2);
  Ids foreign;
  for (const BoundaryTriangle& t : run.Mesh.thoseMeeting(0))
  {
    for (const BoundaryVertex& v : t)
    {
      if (v.isArtificial() || v.Partition != 0)
      {
        foreign.push_back(v.Id);
      }
    }
  }
  std::sort(foreign.begin(), foreign.end());
  foreign.erase(std::unique(foreign.begin(), foreign.end()), foreign.end());
  run.triangulate(0);
  EXPECT_EQ(run.Scene.Buckets.count(0) + foreign.size(), run.Work.vertexCount());
}

/// Inserts three points into the middle one of 3 x 3 partitions, each 4 wide. They lie on a circle
/// about the partition's centre plus (dx, dy). Returns the number of the partition's interior
/// triangles.
std::size_t interiorCountWithCircle(double dx, double dy, double radius)
{
  const double x = 6 + dx;
  const double y = 6 + dy;
  const Coordinates xy{ 0, 0, 12, 0, 12, 12, 0, 12, x + radius, y, x - radius, y, x, y + radius };
  const Tiling tiling = Tiling::grid({ 0, 0, 12, 12 }, 3, 3);
  const PartitionIndex middle = tiling.locate({ 6, 6 });
  auto buckets = bucketPoints<std::int32_t>(view(xy), tiling, 1);
  UnfinishedMesh mesh;
  mesh.add(triangulateVertices<2>(tiling, makeArtificialPoints(tiling), 1));
  Worker<std::int32_t> worker(tiling, buckets);
  Boundary boundary(tiling);
  worker.triangulate(
    middle, uniqueVertices(mesh.thoseMeeting(middle)), tiling.box(middle), boundary);
  return worker.interiorCount();
}

TEST(Worker, ADiskInsideThePartitionIsInterior)
{
  EXPECT_EQ(1U, interiorCountWithCircle(0, 0, 1));
}

/// Boxes are closed: a point of the neighbour may lie where the disk touches it.
TEST(Worker, ADiskThatTouchesTheBorderFromInsideIsNotInterior)
{
  EXPECT_EQ(0U, interiorCountWithCircle(-1, 0, 1));
  EXPECT_EQ(0U, interiorCountWithCircle(1, 0, 1));
  EXPECT_EQ(0U, interiorCountWithCircle(0, -1, 1));
  EXPECT_EQ(0U, interiorCountWithCircle(0, 1, 1));
}

TEST(Worker, AloneMakesAllTriangles)
{
  const Coordinates xy = makePointSet("duplicates", 600);
  const Tiling tiling = Tiling::grid(boundsOf(xy), 1, 1);
  auto buckets = bucketPoints<std::int64_t>(view(xy), tiling, 1);
  Worker<std::int64_t> worker(tiling, buckets);
  ASSERT_TRUE(worker.triangulateAlone({}));
  Triangles made;
  const std::int64_t* const ids = buckets.triangles(0);
  for (std::size_t i = 0; i < 3 * worker.interiorCount(); i += 3)
  {
    made.push_back(canonical(ids[i], ids[i + 1], ids[i + 2]));
  }
  EXPECT_TRUE(sameTriangles(xy, sorted(std::move(made)), reference(xy).Mesh));
}

TEST(Worker, AloneTheLowestIdRepresentsItsDuplicates)
{
  const Coordinates xy = makePointSet("duplicates", 600);
  const Tiling tiling = Tiling::grid(boundsOf(xy), 1, 1);
  auto buckets = bucketPoints<std::int32_t>(view(xy), tiling, 1);
  Worker<std::int32_t> worker(tiling, buckets);
  ASSERT_TRUE(worker.triangulateAlone({}));
  ASSERT_FALSE(worker.duplicates().empty());
  const Ids expected = reference(xy).Representative;
  for (const Duplicate& duplicate : worker.duplicates())
  {
    EXPECT_EQ(expected[std::size_t(duplicate.Point)], duplicate.Representative);
  }
}

/// Other partitions already have triangles at the initial point, so it stays the representative.
TEST(Worker, AnInitialPointRepresentsLowerDuplicates)
{
  const Coordinates xy{ 0.1, 0.1, 0.3, 0.2, 0.3, 0.2, 0.3, 0.2, 0.9, 0.3, 0.4, 0.9, 0.8, 0.8 };
  const Tiling tiling = Tiling::grid({ 0, 0, 1, 1 }, 2, 2);
  const PartitionIndex p = tiling.locate({ 0.3, 0.2 });
  for (const std::int64_t known : { 1, 2, 3 })
  {
    auto buckets = bucketPoints<std::int32_t>(view(xy), tiling, 1);
    std::vector<BoundaryVertex> vertices = makeArtificialPoints(tiling);
    vertices.push_back({ { 0.3, 0.2 }, known, p });
    UnfinishedMesh mesh;
    mesh.add(triangulateVertices<2>(tiling, vertices, 1));
    Worker<std::int32_t> worker(tiling, buckets);
    Boundary boundary(tiling);
    worker.triangulate(p, uniqueVertices(mesh.thoseMeeting(p)), tiling.box(p), boundary);
    ASSERT_EQ(2U, worker.duplicates().size());
    for (const Duplicate& duplicate : worker.duplicates())
    {
      EXPECT_EQ(known, duplicate.Representative);
      EXPECT_NE(known, duplicate.Point);
    }
  }
}

} // namespace
