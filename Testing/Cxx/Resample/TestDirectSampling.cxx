// SPDX-License-Identifier: BSD-3-Clause
#include "Resample/CellLanes.h"
#include "Resample/CellRows.h"
#include "Resample/Resample.h"
#include "Resample/SampleBlock.h"
#include "Resample/SimplexMesh.h"

#include "ResampleScenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <type_traits>

namespace
{

/// The samples of a point array, a cell array and an integer array, and the mask.
struct FilledArrays
{
  FilledArrays(const Scene& scene, const tipp::Lattice& lattice)
    : Numbers(scene.Points.size() / 3)
    , OfCells(std::size_t(scene.cells()))
    , NumberSamples(std::size_t(lattice.samples()), -7)
    , PointSamples(3 * std::size_t(lattice.samples()), -7)
    , CellSamples(std::size_t(lattice.samples()), -7)
    , Valid(std::size_t(lattice.samples()), 9)
  {
    std::iota(this->Numbers.begin(), this->Numbers.end(), 100);
    std::iota(this->OfCells.begin(), this->OfCells.end(), 0.5F);
    this->Attributes.push_back(
      { scene.Points.data(), this->PointSamples.data(), tipp::Scalar::Float64, 3, false, -1 });
    this->Attributes.push_back(
      { this->OfCells.data(), this->CellSamples.data(), tipp::Scalar::Float32, 1, true, -2 });
    this->Attributes.push_back(
      { this->Numbers.data(), this->NumberSamples.data(), tipp::Scalar::Int32, 1, false, -3 });
    this->Options.Threads = 2;
    this->Options.Valid = this->Valid.data();
  }

  bool operator==(const FilledArrays& other) const
  {
    return this->NumberSamples == other.NumberSamples && this->PointSamples == other.PointSamples &&
      this->CellSamples == other.CellSamples && this->Valid == other.Valid;
  }

  std::vector<std::int32_t> Numbers;
  std::vector<float> OfCells;
  std::vector<std::int32_t> NumberSamples;
  std::vector<double> PointSamples;
  std::vector<float> CellSamples;
  std::vector<unsigned char> Valid;
  std::vector<tipp::Attribute> Attributes;
  tipp::ResampleOptions Options;
};

void expectAsInTwoWalks(const Scene& scene, const tipp::Lattice& lattice)
{
  FilledArrays direct(scene, lattice);
  FilledArrays inTwo(scene, lattice);
  const tipp::DirectResult result =
    tipp::sampleDirectly(scene.mesh(), lattice, direct.Attributes, direct.Options);
  const tipp::Claims claims = tipp::claimSamples(scene.mesh(), lattice, 2);
  ASSERT_EQ(result.Overlapping, claims.Statistics.OverlappingClaims > 0) << scene.Name;
  if (result.Overlapping)
  {
    return;
  }
  tipp::interpolate(
    scene.mesh(), { scene.mesh(), lattice }, claims.Cells.get(), inTwo.Attributes, inTwo.Options);
  EXPECT_TRUE(direct == inTwo) << scene.Name;
  EXPECT_EQ(result.Statistics.VisitedCells, claims.Statistics.VisitedCells) << scene.Name;
  EXPECT_EQ(result.Statistics.Tests, claims.Statistics.Tests) << scene.Name;
}

/// Whether the lanes have rows. Lanes of tetrahedra have none if each box has a single sample.
template <typename Lanes>
bool tellsRows(const Lanes& lanes)
{
  if constexpr (std::is_same_v<Lanes, tipp::TetrahedronLanes>)
  {
    return !lanes.haveSingleSamples();
  }
  return true;
}

/// Compares the first rows of cells in lanes with those of the scalar code. Returns the number of
/// rows that the lanes could decide.
template <typename Access, typename Lanes, typename Rows>
int expectLanesLikeRows(const Scene& scene, Lanes lanes, Rows rows)
{
  const tipp::SimplexMesh mesh = scene.mesh();
  const Access cells(mesh);
  int told = 0;
  for (int first = 0; first + tipp::laneCount <= scene.cells(); first += tipp::laneCount)
  {
    lanes.set(cells, first);
    if (!lanes.nothing() && !tellsRows(lanes))
    {
      continue;
    }
    if (!lanes.nothing())
    {
      lanes.prepareRows();
    }
    for (int lane = 0; lane < tipp::laneCount; ++lane)
    {
      typename Access::Point corners[Access::Corners];
      cells.corners(first + lane, corners);
      const bool visited = rows.set(corners);
      EXPECT_FALSE(visited && lanes.nothing(lane)) << scene.Name;
      if (lanes.nothing(lane) || !lanes.fast(lane))
      {
        continue;
      }
      EXPECT_TRUE(visited);
      EXPECT_EQ(lanes.columns(lane).size(), rows.columns().size());
      EXPECT_EQ(lanes.rows(lane).Begin, rows.rows().Begin);
      EXPECT_EQ(lanes.rows(lane).End, rows.rows().End);
      const int across = rows.rows().size();
      const int count = across * rows.layers().size();
      const auto spans = lanes.spans(lane, 0);
      for (int i = 0; i < std::min(count, int(std::size(spans.Row))); ++i)
      {
        const tipp::RowSpan span =
          rows.span(rows.rows().Begin + i % across, rows.layers().Begin + i / across);
        const bool open = span.End > span.Begin;
        if ((spans.Doubtful >> i & 1) == 0)
        {
          ++told;
          EXPECT_EQ((spans.Open >> i & 1) != 0, open) << scene.Name << " cell " << first + lane;
          EXPECT_TRUE(
            !open || (spans.Begin[i] == span.Begin && spans.Size[i] == span.End - span.Begin));
          EXPECT_EQ(spans.Row[i], rows.rows().Begin + i % across);
          EXPECT_EQ(spans.Layer[i], rows.layers().Begin + i / across);
        }
      }
    }
  }
  return told;
}

} // namespace

TEST(DirectSampling, EqualsClaimsAndInterpolationInThePlane)
{
  for (const Scene& scene : planeScenes())
  {
    expectAsInTwoWalks(scene, latticeOf(2, 33, -0.5, 1.5));
    expectAsInTwoWalks(scene, latticeOf(2, 101, 0.013, 1.0171));
  }
}

TEST(DirectSampling, EqualsClaimsAndInterpolationInSpace)
{
  for (const Scene& scene : spaceScenes())
  {
    expectAsInTwoWalks(scene, latticeOf(3, 9, -0.5, 1.5));
    expectAsInTwoWalks(scene, latticeOf(3, 17, 0.013, 1.0171));
  }
}

TEST(DirectSampling, SamplesNearTheBorderAreThoseNearSomeTriangle)
{
  const Scene scene = jitteredScene(2, 25, 5);
  // The samples at -0.01 are outside, but within the slack.
  tipp::Lattice lattice = latticeOf(2, 41, -0.51, 1.49);
  lattice.Slack = { 0.02, 0.02, 0 };
  std::vector<unsigned char> expected(std::size_t(lattice.samples()), 0);
  for (int cell = 0; cell < scene.cells(); ++cell)
  {
    Scene triangle = scene;
    triangle.Ids.assign(scene.Ids.begin() + 3 * cell, scene.Ids.begin() + 3 * cell + 3);
    FilledArrays alone(triangle, lattice);
    tipp::sampleDirectly(triangle.mesh(), lattice, alone.Attributes, alone.Options);
    std::transform(alone.Valid.begin(), alone.Valid.end(), expected.begin(), expected.begin(),
      [](unsigned char a, unsigned char b) { return (unsigned char)(a | b); });
  }
  for (const Scene& mesh : { scene, scene.shuffled(3) })
  {
    FilledArrays sampled(mesh, lattice);
    tipp::sampleDirectly(mesh.mesh(), lattice, sampled.Attributes, sampled.Options);
    EXPECT_EQ(expected, sampled.Valid);
    const tipp::Claims claims = tipp::claimSamples(mesh.mesh(), lattice, 2);
    EXPECT_EQ(41U, claims.Near.size()); // 20 at each of two sides, and one at the corner
  }
}

TEST(DirectSampling, ReportsThatCellsOverlap)
{
  const Scene scene = overlappingScene(20, 1);
  const tipp::Lattice lattice = latticeOf(2, 50, 0, 1);
  FilledArrays sampled(scene, lattice);
  EXPECT_TRUE(
    tipp::sampleDirectly(scene.mesh(), lattice, sampled.Attributes, sampled.Options).Overlapping);
}

TEST(DirectSampling, StopsWhenProgressReturnsFalse)
{
  const Scene scene = jitteredScene(2, 100, 1);
  const tipp::Lattice lattice = latticeOf(2, 50, 0, 1);
  FilledArrays sampled(scene, lattice);
  sampled.Options.Progress = [](double) { return false; };
  EXPECT_TRUE(
    tipp::sampleDirectly(scene.mesh(), lattice, sampled.Attributes, sampled.Options).Aborted);
}

TEST(TriangleLanes, EqualTheScalarCode)
{
  const Scene scene = jitteredScene(2, 40, 5);
  const tipp::Lattice lattice = latticeOf(2, 90, -0.1, 1.2);
  const tipp::LatticeAxes axes(scene.mesh(), lattice);
  const int told = expectLanesLikeRows<tipp::SimplexAccess<2, double, std::int64_t>>(
    scene, tipp::TriangleLanes(axes), tipp::TriangleRows(axes));
  EXPECT_GT(told, scene.cells() / 2);
}

TEST(TetrahedronLanes, EqualTheScalarCode)
{
  const Scene scene = jitteredScene(3, 8, 5);
  const tipp::Lattice lattice = latticeOf(3, 30, -0.1, 1.2);
  const tipp::LatticeAxes axes(scene.mesh(), lattice);
  const int told = expectLanesLikeRows<tipp::SimplexAccess<3, double, std::int64_t>>(
    scene, tipp::TetrahedronLanes(axes), tipp::TetrahedronRows(axes));
  EXPECT_GT(told, scene.cells() / 2);
}

TEST(TetrahedronLanes, SingleSamplesEqualTheScalarCode)
{
  const Scene scene = jitteredScene(3, 12, 5);
  const tipp::LatticeAxes axes(scene.mesh(), latticeOf(3, 8, -0.1, 1.2));
  const tipp::SimplexAccess<3, double, std::int64_t> cells(scene.mesh());
  tipp::TetrahedronLanes lanes(axes);
  tipp::TetrahedronRows rows(axes);
  int inside = 0;
  int outside = 0;
  for (int first = 0; first + tipp::laneCount <= scene.cells(); first += tipp::laneCount)
  {
    lanes.set(cells, first);
    EXPECT_TRUE(lanes.haveSingleSamples());
    for (int lane = 0; lane < tipp::laneCount && !lanes.nothing(); ++lane)
    {
      tipp::Point3 corners[4];
      cells.corners(first + lane, corners);
      const bool visited = rows.set(corners);
      const bool open = visited && (lanes.samples().Open >> lane & 1) != 0;
      EXPECT_EQ((lanes.visited() >> lane & 1) != 0, visited);
      EXPECT_EQ(lanes.samples().Doubtful, 0u);
      if (!visited)
      {
        continue;
      }
      EXPECT_EQ(lanes.samples().Begin[lane], rows.columns().Begin);
      EXPECT_EQ(lanes.samples().Row[lane], rows.rows().Begin);
      EXPECT_EQ(lanes.samples().Layer[lane], rows.layers().Begin);
      const tipp::RowSpan span = rows.span(rows.rows().Begin, rows.layers().Begin);
      EXPECT_EQ(open, span.End > span.Begin) << first + lane;
      ++(open ? inside : outside);
    }
  }
  EXPECT_EQ(inside, 5 * 5 * 5); // all samples inside the mesh
  EXPECT_GT(outside, inside);
}

TEST(BorderClaims, AssignEachTouchedSampleToOneCellInAnyOrder)
{
  const Scene scene = regularScene(2, 4);
  const tipp::Lattice lattice = latticeOf(2, 5, 0, 1); // each corner has a sample
  const tipp::LatticeAxes axes(scene.mesh(), lattice);
  std::vector<tipp::Touch> touches;
  for (std::int64_t i = 0; i < lattice.samples(); ++i)
  {
    double sample[3];
    sampleOf(lattice, i, sample);
    for (int cell = 0; cell < scene.cells(); ++cell)
    {
      for (int corner = 0; corner < 3; ++corner)
      {
        const double* p = scene.corner(cell, corner);
        if (p[0] == sample[0] && p[1] == sample[1])
        {
          touches.push_back({ i, cell });
        }
      }
    }
  }
  const std::vector<tipp::BorderClaim> claims = borderClaims(scene.mesh(), axes, touches, 2);
  ASSERT_EQ(std::int64_t(claims.size()), lattice.samples());
  std::reverse(touches.begin(), touches.end());
  const std::vector<tipp::BorderClaim> again = borderClaims(scene.mesh(), axes, touches, 2);
  for (std::size_t i = 0; i < claims.size(); ++i)
  {
    EXPECT_EQ(claims[i].Sample, std::int64_t(i));
    EXPECT_EQ(claims[i].Cell, again[i].Cell);
  }
}

TEST(OutsidePoints, AreThePointsOfCellsBeyondASideOfASmallLattice)
{
  using Access = tipp::SimplexAccess<2, double, std::int64_t>;
  const Scene scene = jitteredScene(2, 40, 5);
  const tipp::SimplexMesh mesh = scene.mesh();
  const tipp::Lattice lattice = latticeOf(2, 30, 0.4, 0.5);
  const tipp::LatticeAxes axes(mesh, lattice);
  tipp::OutsidePoints<Access> outside(mesh, axes);
  EXPECT_FALSE(outside.contain(0));
  outside.find(2);
  ASSERT_NE(outside.sides(), nullptr);
  tipp::TriangleRows rows(axes);
  int without = 0;
  for (int cell = 0; cell < scene.cells(); ++cell)
  {
    tipp::Point2 corners[3];
    Access(mesh).corners(cell, corners);
    if (outside.contain(cell))
    {
      ++without;
      EXPECT_FALSE(rows.set(corners)) << cell;
    }
  }
  EXPECT_GT(without, scene.cells() * 9 / 10);
  expectAsInTwoWalks(scene, lattice);
}

TEST(OutsidePoints, AreNotUsedIfTheLatticeCoversMostOfTheMesh)
{
  const Scene scene = jitteredScene(2, 40, 5);
  const tipp::LatticeAxes axes(scene.mesh(), latticeOf(2, 30, 0, 1));
  tipp::OutsidePoints<tipp::SimplexAccess<2, double, std::int64_t>> outside(scene.mesh(), axes);
  outside.find(2);
  EXPECT_EQ(outside.sides(), nullptr);
}
