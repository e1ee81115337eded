// SPDX-License-Identifier: BSD-3-Clause
#include "QueryTesting.h"

#include "Files/IOError.h"
#include "Query/Queries.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>

using namespace tipp;
using namespace tipp::test;

namespace
{

/// Partitions a mesh in several ways, and calls work(mesh) for each.
template <typename Work>
void withEachStore(const SourceMesh& source, const Work& work)
{
  for (const char* const tiling : { "grid:4x4", "quadtree:30" })
  {
    SCOPED_TRACE(tiling);
    const TemporaryFolder folder;
    store(source, folder.path("mesh.tipp"), tiling, false);
    ResidentOptions options;
    options.Threads = 3;
    work(ResidentMesh(folder.path("mesh.tipp"), options));
  }
}

/// A lattice over the unit square with two components, the first of which is x + 2 y.
SourceMesh slope(double jitter)
{
  SourceMesh source = makeSource(latticeTriangles(12, jitter));
  for (std::size_t i = 0; i < source.points(); ++i)
  {
    source.Values[2 * i] = float(source.Coordinates[2 * i] + 2 * source.Coordinates[2 * i + 1]);
  }
  return source;
}

double lengthOf(const Contours& lines, double level)
{
  double length = 0;
  for (std::size_t i = 0; i < lines.Levels.size(); ++i)
  {
    for (std::int64_t k = lines.Starts[i] + 1; k < lines.Starts[i + 1] && lines.Levels[i] == level;
         ++k)
    {
      const Point3& a = lines.Points[std::size_t(k - 1)];
      const Point3& b = lines.Points[std::size_t(k)];
      length += std::hypot(b.x - a.x, b.y - a.y);
    }
  }
  return length;
}

} // namespace

TEST(Contours, OfAPlaneAreStraightLinesFromBorderToBorder)
{
  const SourceMesh source = slope(0.3);
  const ResidentMesh mesh(inMemory(source));
  const Contours lines = contoursOf(mesh, "value", 0, { 1.5, -3, 0.4 });
  ASSERT_EQ(std::vector<double>({ 1.5, 0.4 }), lines.Levels);
  for (std::size_t i = 0; i < 2; ++i)
  {
    for (std::int64_t k = lines.Starts[i]; k < lines.Starts[i + 1]; ++k)
    {
      const Point3& p = lines.Points[std::size_t(k)];
      EXPECT_NEAR(lines.Levels[i], p.x + 2 * p.y, 1e-6);
    }
    // The higher side must be on the line's left.
    const Point3& first = lines.Points[std::size_t(lines.Starts[i])];
    const Point3& last = lines.Points[std::size_t(lines.Starts[i + 1] - 1)];
    EXPECT_GT(first.y, last.y + 0.1);
  }
}

TEST(Contours, AreTheSameForAnyPieces)
{
  for (const double jitter : { 0.3, 0.0 })
  {
    const SourceMesh source = slope(jitter);
    const ResidentMesh whole(inMemory(source));
    const std::vector<double> levels = { 0.5, 1, 1.25, 2, 3 };
    withEachStore(source,
      [&](const ResidentMesh& mesh)
      {
        for (const int component : { 0, 1 })
        {
          const Contours expected = contoursOf(whole, "value", component, levels);
          const Contours lines = contoursOf(mesh, "value", component, levels);
          EXPECT_EQ(expected.Starts, lines.Starts);
          EXPECT_EQ(expected.Levels, lines.Levels);
          EXPECT_EQ(expected.Points, lines.Points);
        }
      });
  }
}

TEST(Contours, KeepPiecesInMemoryOnlyIfAllFit)
{
  const SourceMesh source = slope(0.3);
  const TemporaryFolder folder;
  const std::string path = folder.path("mesh.tipp");
  store(source, path, "grid:3x3", false);
  const ResidentMesh roomy(path);
  const Contours expected = contoursOf(roomy, "value", 0, { 1, 2 });
  const std::uint64_t all = roomy.pieces().bytes();
  EXPECT_LT(0U, all);
  ResidentOptions options;
  options.MemoryLimit = all / 2;
  const ResidentMesh narrow(path, options);
  EXPECT_EQ(expected.Points, contoursOf(narrow, "value", 0, { 1, 2 }).Points);
  EXPECT_EQ(9, narrow.pieces().loads());
  EXPECT_EQ(0U, narrow.pieces().bytes());
}

TEST(Contours, AroundAHillAreClosed)
{
  SourceMesh source = makeSource(latticeTriangles(30, 0.2));
  for (std::size_t i = 0; i < source.points(); ++i)
  {
    const double x = source.Coordinates[2 * i] - 0.5;
    const double y = source.Coordinates[2 * i + 1] - 0.5;
    source.Values[2 * i] = float(-std::hypot(x, y));
  }
  const ResidentMesh mesh(inMemory(source));
  const Contours lines = contoursOf(mesh, "value", 0, { -0.3 });
  ASSERT_EQ(1U, lines.Levels.size());
  EXPECT_EQ(lines.Points.front(), lines.Points.back());
  EXPECT_NEAR(2 * 3.14159265 * 0.3, lengthOf(lines, -0.3), 0.02);
  double area = 0;
  for (std::size_t i = 1; i < lines.Points.size(); ++i)
  {
    const Point3& a = lines.Points[i - 1];
    const Point3& b = lines.Points[i];
    area += (a.x * b.y - a.y * b.x) / 2;
    EXPECT_FALSE(a == b);
  }
  EXPECT_NEAR(3.14159265 * 0.09, area, 0.01); // counter-clockwise, since the higher side is inside
}

TEST(Contours, RefuseInvalidArraysAndLevelsAndTetrahedra)
{
  const ResidentMesh triangles(inMemory(slope(0)));
  EXPECT_THROW(contoursOf(triangles, "label", 0, { 1 }), IOError);
  EXPECT_THROW(contoursOf(triangles, "value", 2, { 1 }), IOError);
  EXPECT_THROW(contoursOf(triangles, "value", 0, { NAN }), IOError);
  const ResidentMesh tetrahedra(inMemory(makeSource(latticeTetrahedra(2, 0))));
  EXPECT_THROW(contoursOf(tetrahedra, "value", 0, { 1 }), IOError);
}

TEST(Profile, SamplesEverySpacingAndAtCorners)
{
  const ResidentMesh mesh(inMemory(slope(0.3)));
  const Profile profile =
    profileOf(mesh, { { 0.1, 0.1, 0 }, { 0.4, 0.1, 0 }, { 0.4, 0.35, 0 } }, 0.125, { "value" });
  EXPECT_EQ(
    std::vector<double>({ 0, 0.125, 0.25, 0.375, 0.5 }).size() + 2, profile.Distances.size());
  EXPECT_TRUE(std::is_sorted(profile.Distances.begin(), profile.Distances.end()));
  for (std::size_t i = 0; i < profile.Points.size(); ++i)
  {
    const Point3& p = profile.Points[i];
    EXPECT_NEAR(p.x + 2 * p.y, double(profile.Answer.Arrays[0].Values.as<float>()[2 * i]), 1e-6);
    EXPECT_LE(0, profile.Answer.Cells[i]);
  }
}

TEST(Profile, HasEveryCrossingOnce)
{
  const SourceMesh source = slope(0.3);
  const ResidentMesh mesh(inMemory(source));
  const Point3 a{ 0.013, 0.027, 0 };
  const Point3 b{ 0.93, 0.81, 0 };
  const Profile profile = profileOf(mesh, { a, b }, 0, { "value", "label" });
  // Each interval between points has a cell, different from that of its neighbours.
  for (std::size_t i = 0; i + 1 < profile.Points.size(); ++i)
  {
    EXPECT_LT(profile.Distances[i], profile.Distances[i + 1]);
    EXPECT_LE(0, profile.Answer.Cells[i]);
    EXPECT_TRUE(i == 0 || profile.Answer.Cells[i - 1] != profile.Answer.Cells[i]);
    const auto cell = std::size_t(profile.Answer.Cells[i]);
    EXPECT_EQ(source.Labels[cell], profile.Answer.Arrays[1].Values.as<std::int16_t>()[i]);
    const Point3& p = profile.Points[i];
    EXPECT_NEAR(p.x + 2 * p.y, double(profile.Answer.Arrays[0].Values.as<float>()[2 * i]), 1e-5);
  }
  EXPECT_LT(20U, profile.Points.size());
}

TEST(Profile, IsTheSameForAnyPieces)
{
  for (const double jitter : { 0.3, 0.0 }) // 0: along edges and through points
  {
    const SourceMesh source = slope(jitter);
    const ResidentMesh whole(inMemory(source));
    const std::vector<Point3> polyline = { { -0.1, 0.25, 0 }, { 0.75, 0.25, 0 }, { 0.5, 0.5, 0 },
      { 0.5, 1.2, 0 }, { 0.1, 0.9, 0 } };
    withEachStore(source,
      [&](const ResidentMesh& mesh)
      {
        for (const double spacing : { 0.0, 0.07 })
        {
          const Profile expected = profileOf(whole, polyline, spacing, { "value", "label" });
          EXPECT_TRUE(std::is_sorted(expected.Distances.begin(), expected.Distances.end()));
          EXPECT_EQ(-1, expected.Answer.Cells[0]);
          const Profile profile = profileOf(mesh, polyline, spacing, { "value", "label" });
          EXPECT_EQ(expected.Distances, profile.Distances);
          EXPECT_EQ(expected.Points, profile.Points);
          expectEqual(expected.Answer, profile.Answer);
        }
      });
  }
}

TEST(Profile, OfTetrahedraHasEveryFaceOnce)
{
  SourceMesh source = makeSource(latticeTetrahedra(4, 0.3));
  for (std::size_t i = 0; i < source.points(); ++i)
  {
    const Point3 p = pointOf(source, std::int64_t(i));
    source.Values[2 * i] = float(p.x + 2 * p.y - p.z);
  }
  const ResidentMesh mesh(inMemory(source));
  const Point3 a{ 0.13, 0.127, 0.241 };
  const Point3 b{ 0.83, 0.81, 0.729 };
  const Profile profile = profileOf(mesh, { a, b }, 0, { "value", "label" });
  EXPECT_LT(10U, profile.Points.size());
  for (std::size_t i = 0; i + 1 < profile.Points.size(); ++i)
  {
    EXPECT_LT(profile.Distances[i], profile.Distances[i + 1]);
    EXPECT_LE(0, profile.Answer.Cells[i]);
    const Point3& p = profile.Points[i];
    EXPECT_NEAR(
      p.x + 2 * p.y - p.z, double(profile.Answer.Arrays[0].Values.as<float>()[2 * i]), 1e-5);
    if (i > 0) // consecutive cells have a common face
    {
      const auto cornersOf = [&](std::size_t at)
      {
        const auto first = source.Cells.begin() + 4 * profile.Answer.Cells[at];
        std::vector<std::int64_t> corners(first, first + 4);
        std::sort(corners.begin(), corners.end());
        return corners;
      };
      const auto before = cornersOf(i - 1);
      const auto after = cornersOf(i);
      std::vector<std::int64_t> common;
      std::set_intersection(
        before.begin(), before.end(), after.begin(), after.end(), std::back_inserter(common));
      EXPECT_EQ(3U, common.size());
    }
  }
}

TEST(Profile, OfTetrahedraIsTheSameForAnyPieces)
{
  for (const double jitter : { 0.3, 0.0 }) // 0: along faces, edges and through points
  {
    const SourceMesh source = makeSource(latticeTetrahedra(4, jitter));
    const std::vector<Point3> polyline = { { -0.2, 0.25, 0.5 }, { 0.75, 0.25, 0.5 },
      { 0.25, 0.75, 0.5 }, { 0.25, 0.25, 0.25 }, { 1, 1, 1 }, { 0.3, 0.8, 0.1 } };
    const Profile expected =
      profileOf(ResidentMesh(inMemory(source)), polyline, 0, { "value", "label" });
    EXPECT_TRUE(std::is_sorted(expected.Distances.begin(), expected.Distances.end()));
    EXPECT_LT(20U, expected.Points.size());
    withEachMesh(source,
      [&](const ResidentMesh& mesh)
      {
        const Profile profile = profileOf(mesh, polyline, 0, { "value", "label" });
        EXPECT_EQ(expected.Distances, profile.Distances);
        EXPECT_EQ(expected.Points, profile.Points);
        expectEqual(expected.Answer, profile.Answer);
      });
  }
}

TEST(Profile, RefusesASpacingOfTooManySamples)
{
  const ResidentMesh mesh(inMemory(slope(0)));
  EXPECT_THROW(profileOf(mesh, { { 0, 0, 0 }, { 1, 1, 0 } }, 1e-300, {}), IOError);
  EXPECT_THROW(profileOf(mesh, { { 0, 0, 0 }, { 1, 1, 0 } }, -1, {}), IOError);
  EXPECT_THROW(profileOf(mesh, { { 0, NAN, 0 }, { 1, 1, 0 } }, 0, {}), IOError);
  EXPECT_TRUE(profileOf(mesh, {}, 0, {}).Points.empty());
}
