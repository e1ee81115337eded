// SPDX-License-Identifier: BSD-3-Clause
// Tests each lemma of the parallel triangulation by itself. CGAL triangulates; rational arithmetic
// decides which disks meet which boxes.
#include "Comparison.h"
#include "Scene.h"

namespace
{

using namespace tipp;
using namespace tipp::test;

struct Case
{
  std::string Set;
  std::size_t Count;
  int Side;
};

class Lemma : public testing::TestWithParam<Case>
{
public:
  Scene scene(std::uint64_t seed = 1, double margin = 0.25) const
  {
    const Case& c = GetParam();
    return makeScene(c.Set, c.Count, c.Side, 7, margin, seed);
  }
};

/// The box, slightly larger on each side. Gathering more triangles than necessary does no harm.
Box2 grown(const Box2& box)
{
  const double hair = 1e-9 * (box.Max.x - box.Min.x + box.Max.y - box.Min.y);
  return { box.Min.x - hair, box.Min.y - hair, box.Max.x + hair, box.Max.y + hair };
}

/// Lemma 1, for partitions one after the other, as in a run. A worker sees only the vertices of the
/// triangles that belong to its partition. The triangles that it makes there are those of the
/// triangulation of all points inserted so far.
TEST_P(Lemma, Worker_TheVerticesAroundAPartitionSuffice)
{
  const Scene scene = this->scene();
  Ids inserted = scene.initialMesh();
  Triangles mesh = delaunay(scene.XY, inserted);
  for (std::size_t p = 0; p < scene.Partitions.size(); ++p)
  {
    const Box2& box = scene.Partitions[p];
    const Ids around = verticesOf(belonging(scene.XY, mesh, grown(box)));
    const Triangles worker = delaunay(scene.XY, together(around, scene.Points[p]));
    inserted = together(inserted, scene.Points[p]);
    mesh = delaunay(scene.XY, inserted);
    ASSERT_TRUE(
      sameTriangles(scene.XY, belonging(scene.XY, worker, box), belonging(scene.XY, mesh, box)))
      << "partition " << p;
  }
}

/// The rest of Lemma 1: a worker changes no triangle that does not belong to its partition.
TEST_P(Lemma, Worker_TrianglesNotBelongingToThePartitionStay)
{
  const Scene scene = this->scene(2);
  const Ids inserted = scene.initialMesh();
  const Triangles before = delaunay(scene.XY, inserted);
  for (std::size_t p = 0; p < scene.Partitions.size(); ++p)
  {
    const Triangles after = delaunay(scene.XY, together(inserted, scene.Points[p]));
    const Triangles touched = belonging(scene.XY, before, scene.Partitions[p]);
    Triangles stay;
    std::set_difference(
      before.begin(), before.end(), touched.begin(), touched.end(), std::back_inserter(stay));
    EXPECT_TRUE(std::includes(after.begin(), after.end(), stay.begin(), stay.end()))
      << "partition " << p;
  }
}

/// Lemma 2: a triangle is final as soon as its circumdisk meets no unfinished partition.
TEST_P(Lemma, Final_ATriangleThatMeetsNoUnfinishedPartitionStays)
{
  const Scene scene = this->scene(3);
  Ids all = scene.initialMesh();
  for (const Ids& points : scene.Points)
  {
    all = together(all, points);
  }
  const Triangles last = delaunay(scene.XY, all);
  Ids inserted = scene.initialMesh();
  std::size_t finalOnes = 0;
  for (std::size_t done = 0; done < scene.Partitions.size(); ++done)
  {
    inserted = together(inserted, scene.Points[done]);
    const Triangles mesh = delaunay(scene.XY, inserted);
    for (const Triangle& t : mesh)
    {
      if (std::none_of(scene.Partitions.begin() + std::ptrdiff_t(done) + 1, scene.Partitions.end(),
            [&](const Box2& box) { return diskMeetsBox(scene.XY, t, box); }))
      {
        ASSERT_TRUE(std::binary_search(last.begin(), last.end(), t)) << "after partition " << done;
        ++finalOnes;
      }
    }
  }
  EXPECT_GT(finalOnes, last.size()) << "hardly a triangle was final before the end";
}

/// Lemma 3: the true neighbours of artificial points are enough to repair the hull.
TEST_P(Lemma, Hull_NeighboursOfArtificialPointsRepairIt)
{
  for (const double margin : { 0.001, 0.05, 1.0, 100.0 })
  {
    const Scene scene = this->scene(4, margin);
    Ids all = scene.Initial;
    for (const Ids& points : scene.Points)
    {
      all = together(all, points);
    }
    Triangles kept;
    Triangles atArtificial;
    for (const Triangle& t : delaunay(scene.XY, together(all, scene.artificial())))
    {
      // Artificial points have the lowest ids, and a triangle starts with its lowest id.
      (t[0] < scene.Artificial ? atArtificial : kept).push_back(t);
    }
    Ids neighbours = verticesOf(atArtificial);
    neighbours.erase(neighbours.begin(), neighbours.begin() + scene.Artificial);
    for (const Triangle& t : delaunay(scene.XY, neighbours))
    {
      for (std::int64_t i = 0; i < scene.Artificial; ++i)
      {
        const auto at = std::size_t(2 * i);
        if (sideOfDisk(scene.XY, t, scene.XY[at], scene.XY[at + 1]) <= 0)
        {
          kept.push_back(t);
          break;
        }
      }
    }
    // A triangle with an artificial point on its circle may be in `kept` twice.
    kept = sorted(std::move(kept));
    kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
    ASSERT_TRUE(sameTriangles(scene.XY, kept, delaunay(scene.XY, all))) << "margin " << margin;
  }
}

INSTANTIATE_TEST_SUITE_P(PointSets, Lemma,
  testing::Values(Case{ "uniform", 300, 4 }, Case{ "uniform", 600, 2 }, Case{ "clustered", 300, 4 },
    Case{ "kuzmin", 300, 3 }, Case{ "lattice-shuffled", 225, 4 },
    Case{ "lattice-shuffled", 289, 4 }, Case{ "lattice-tenths", 225, 3 },
    Case{ "cocircular", 150, 3 }, Case{ "survey-lines", 200, 3 }),
  [](const auto& info)
  {
    std::string name = info.param.Set + std::to_string(info.param.Count);
    std::replace(name.begin(), name.end(), '-', '_');
    return name + "_" + std::to_string(info.param.Side) + "x" + std::to_string(info.param.Side);
  });

/// Lemma 4: the triangles of adjacent partitions match even for ties. The points are a lattice;
/// sides of boxes pass through its points or touch circles from outside, and few initial points
/// leave large empty disks.
TEST(LemmaTies, PartitionsOfALatticeAgreeOnTouchingDisks)
{
  for (const int side : { 9, 11, 13 })
  {
    const Scene scene = makeScene("lattice-shuffled", std::size_t(side * side), 2, 5, 0.5, 1);
    std::size_t touching = 0;
    Ids inserted = scene.initialMesh();
    Triangles mesh = delaunay(scene.XY, inserted);
    for (std::size_t p = 0; p < scene.Partitions.size(); ++p)
    {
      const Box2& box = scene.Partitions[p];
      const Triangles near = belonging(scene.XY, mesh, grown(box));
      const Box2 shrunk{ box.Min.x + 1e-9, box.Min.y + 1e-9, box.Max.x - 1e-9, box.Max.y - 1e-9 };
      touching += near.size() - belonging(scene.XY, mesh, shrunk).size();
      const Triangles worker = delaunay(scene.XY, together(verticesOf(near), scene.Points[p]));
      inserted = together(inserted, scene.Points[p]);
      mesh = delaunay(scene.XY, inserted);
      ASSERT_TRUE(
        sameTriangles(scene.XY, belonging(scene.XY, worker, box), belonging(scene.XY, mesh, box)));
    }
    EXPECT_GT(touching, 0u) << "no disk touched a box from outside";
  }
}

} // namespace
