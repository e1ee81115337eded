// SPDX-License-Identifier: BSD-3-Clause
#include "QueryTesting.h"

#include "Files/IOError.h"
#include "Predicates/ExactArithmetic.h"
#include "Query/Queries.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <gmpxx.h>
#include <random>

using namespace tipp;
using namespace tipp::test;

namespace
{

/// x, y and the value at a point.
using Exact = std::array<mpq_class, 3>;

mpq_class turn(const Exact& a, const Exact& b, const Exact& c)
{
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

Exact between(const Exact& a, const Exact& b, const mpq_class& share)
{
  return { mpq_class(a[0] + share * (b[0] - a[0])), mpq_class(a[1] + share * (b[1] - a[1])),
    mpq_class(a[2] + share * (b[2] - a[2])) };
}

/// Clips a closed line to the side where side(p) >= 0 (Sutherland and Hodgman).
template <typename Side>
std::vector<Exact> clipped(const std::vector<Exact>& line, const Side& side)
{
  std::vector<Exact> result;
  for (std::size_t i = 0; i < line.size(); ++i)
  {
    const Exact& a = line[i];
    const Exact& b = line[(i + 1) % line.size()];
    const mpq_class ofA = side(a);
    const mpq_class ofB = side(b);
    if (sgn(ofA) >= 0)
    {
      result.push_back(a);
    }
    if (sgn(ofA) * sgn(ofB) < 0)
    {
      result.push_back(between(a, b, ofA / (ofA - ofB)));
    }
  }
  return result;
}

/// The integral of the value over the polygon inside a closed line or, if `ofOne`, the integral of
/// 1: the polygon's area. Clockwise lines have the opposite sign.
mpq_class integral(const std::vector<Exact>& line, bool ofOne)
{
  mpq_class sum = 0;
  for (std::size_t i = 2; i < line.size(); ++i)
  {
    const mpq_class mean = (line[0][2] + line[i - 1][2] + line[i][2]) / 3;
    sum += turn(line[0], line[i - 1], line[i]) / 2 * (ofOne ? mpq_class(1) : mean);
  }
  return sum;
}

/// Area, integral and volume above the level: each ring is clipped by each triangle, in rational
/// arithmetic.
std::array<mpq_class, 3> bruteForce(const SourceMesh& source, const Zone& zone, double level)
{
  std::array<mpq_class, 3> sums;
  for (std::size_t cell = 0; cell < source.cells(); ++cell)
  {
    std::vector<Exact> t;
    for (std::size_t i = 0; i < 3; ++i)
    {
      const std::int64_t id = source.Cells[3 * cell + i];
      const Point3 p = pointOf(source, id);
      t.push_back(
        { mpq_class(p.x), mpq_class(p.y), mpq_class(double(source.Values[2 * std::size_t(id)])) });
    }
    if (turn(t[0], t[1], t[2]) < 0)
    {
      std::swap(t[1], t[2]);
    }
    const mpq_class whole = turn(t[0], t[1], t[2]);
    for (const ZoneRing& ring : zone)
    {
      std::vector<Exact> line;
      for (const Point2 p : ring.Corners)
      {
        Exact corner = { mpq_class(p.x), mpq_class(p.y), mpq_class(0) };
        for (std::size_t i = 0; i < 3; ++i)
        {
          corner[2] += turn(t[(i + 1) % 3], t[(i + 2) % 3], corner) / whole * t[i][2];
        }
        line.push_back(corner);
      }
      for (std::size_t i = 0; i < 3; ++i)
      {
        line = clipped(line, [&](const Exact& p) { return turn(t[i], t[(i + 1) % 3], p); });
      }
      // Outer rings and holes are all counter-clockwise in these tests.
      const int sign = ring.IsHole ? -1 : 1;
      sums[0] += sign * integral(line, true);
      sums[1] += sign * integral(line, false);
      std::vector<Exact> high =
        clipped(line, [&](const Exact& p) { return mpq_class(p[2] - level); });
      sums[2] += sign * (integral(high, false) - mpq_class(level) * integral(high, true));
    }
  }
  return sums;
}

/// The cells that have an area in the zone, those that lie inside as a whole, and the points
/// inside.
struct InZone
{
  std::vector<std::int64_t> Met;
  std::vector<std::int64_t> Whole;
  std::vector<std::int64_t> Points;
};

InZone bruteForce(const SourceMesh& source, const Zone& zone)
{
  const Zone all = { { { { -9, -9 }, { 9, -9 }, { 9, 9 }, { -9, 9 } }, false } };
  InZone in;
  for (std::size_t cell = 0; cell < source.cells(); ++cell)
  {
    SourceMesh one = source;
    one.Cells.assign(source.Cells.begin() + std::ptrdiff_t(3 * cell),
      source.Cells.begin() + std::ptrdiff_t(3 * cell + 3));
    const mpq_class area = bruteForce(one, zone, 0)[0];
    if (sgn(area) > 0)
    {
      in.Met.push_back(std::int64_t(cell));
    }
    if (area == bruteForce(one, all, 0)[0])
    {
      in.Whole.push_back(std::int64_t(cell));
    }
  }
  for (std::size_t i = 0; i < source.points(); ++i)
  {
    // The number of crossings of a ray tells whether the point is inside; points on edges count.
    const Point3 p = pointOf(source, std::int64_t(i));
    const Exact at = { mpq_class(p.x), mpq_class(p.y), mpq_class(0) };
    bool isInside = false;
    bool isOnBorder = false;
    for (const ZoneRing& ring : zone)
    {
      for (std::size_t k = 0; k < ring.Corners.size(); ++k)
      {
        const Point2 a = ring.Corners[k];
        const Point2 b = ring.Corners[(k + 1) % ring.Corners.size()];
        const int side = sgn(
          turn({ mpq_class(a.x), mpq_class(a.y), 0 }, { mpq_class(b.x), mpq_class(b.y), 0 }, at));
        isInside = isInside != ((a.y > p.y) != (b.y > p.y) && (b.y > a.y ? side > 0 : side < 0));
        isOnBorder = isOnBorder ||
          (side == 0 && std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) &&
            std::min(a.y, b.y) <= p.y && p.y <= std::max(a.y, b.y));
      }
    }
    if (isInside || isOnBorder)
    {
      in.Points.push_back(std::int64_t(i));
    }
  }
  return in;
}

ZoneRing star(double x, double y, double radius, int corners, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> share(0.3, 1);
  ZoneRing ring;
  for (int i = 0; i < corners; ++i)
  {
    const double angle = 2 * 3.14159265358979 * i / corners;
    const double r = radius * share(random);
    ring.Corners.push_back({ x + r * std::cos(angle), y + r * std::sin(angle) });
  }
  return ring;
}

/// Random polygons, and polygons along mesh edges, through mesh points, inside one triangle, and
/// with holes.
std::vector<Zone> manyZones()
{
  std::vector<Zone> zones;
  for (unsigned seed = 0; seed < 8; ++seed)
  {
    zones.push_back({ star(0.2 + 0.1 * seed, 0.4, 0.5, 5 + int(seed) * 7, seed) });
  }
  ZoneRing hole = star(0.5, 0.5, 0.15, 9, 77);
  hole.IsHole = true;
  zones.push_back({ rectangle(0.3, 0.8, 0.2, 0.75), hole });
  zones.push_back({ rectangle(0.25, 0.75, 0.25, 0.5), rectangle(0.375, 0.5, 0.375, 0.5, true) });
  zones.push_back({ rectangle(0, 1, 0, 1) });
  zones.push_back({ rectangle(-3, 4, -5, 6), rectangle(0.5, 2, 0.125, 0.25, true) });
  zones.push_back({ { { { 0.25, 0.25 }, { 0.75, 0.5 }, { 0.5, 0.75 }, { 0.5, 0.5 } }, false } });
  zones.push_back({ star(0.51, 0.53, 0.004, 6, 5) });
  zones.push_back({ rectangle(0.1, 0.2, 0.1, 0.2), rectangle(0.6, 0.7, 0.6, 0.7) });
  zones.push_back({ rectangle(2, 3, 2, 3) });
  zones.push_back({});
  return zones;
}

SourceMesh wavy(int n, double jitter)
{
  SourceMesh source = makeSource(latticeTriangles(n, jitter));
  for (std::size_t i = 0; i < source.points(); ++i)
  {
    const Point3 p = pointOf(source, std::int64_t(i));
    source.Values[2 * i] = float(std::sin(9 * p.x) * std::cos(7 * p.y));
  }
  return source;
}

} // namespace

TEST(Zones, HaveTheAreaAndVolumesOfClippingInRationals)
{
  for (const double jitter : { 0.3, 0.0 })
  {
    const SourceMesh source = wavy(8, jitter);
    const ResidentMesh mesh(inMemory(source));
    const std::vector<Zone> zones = manyZones();
    const ZoneStatistics found = statisticsOf(mesh, zones, "value", 0, 0.25);
    for (std::size_t i = 0; i < zones.size(); ++i)
    {
      SCOPED_TRACE(i);
      const auto expected = bruteForce(source, zones[i], 0.25);
      EXPECT_NEAR(expected[0].get_d(), found.Area[i], 1e-15 + 1e-13 * found.Area[i]);
      EXPECT_NEAR(expected[1].get_d(), found.Sum[i], 1e-15 + 1e-13 * found.Area[i]);
      EXPECT_NEAR(expected[2].get_d(), found.Above[i], 1e-15 + 1e-13 * found.Area[i]);
      EXPECT_EQ(sgn(expected[0]) > 0, found.Cells[i] > 0);
      if (found.Cells[i] > 0)
      {
        EXPECT_DOUBLE_EQ(found.Sum[i] / found.Area[i], found.Mean[i]);
        EXPECT_LE(found.Low[i], found.Mean[i]);
        EXPECT_GE(found.High[i], found.Mean[i]);
      }
    }
  }
}

TEST(Zones, AreTheSameBitForBitForAnyPieces)
{
  for (const double jitter : { 0.3, 0.0 })
  {
    const SourceMesh source = wavy(16, jitter);
    const std::vector<Zone> zones = manyZones();
    const ZoneStatistics expected =
      statisticsOf(ResidentMesh(inMemory(source)), zones, "value", 0, 0.25);
    withEachMesh(source,
      [&](const ResidentMesh& mesh)
      {
        const ZoneStatistics found = statisticsOf(mesh, zones, "value", 0, 0.25);
        EXPECT_EQ(expected.Cells, found.Cells);
        EXPECT_EQ(expected.Area, found.Area);
        EXPECT_EQ(expected.Sum, found.Sum);
        EXPECT_EQ(expected.Above, found.Above);
        for (std::size_t i = 0; i < zones.size(); ++i)
        {
          EXPECT_EQ(found.Cells[i] > 0, expected.Low[i] == found.Low[i]); // NaN without cells
          EXPECT_EQ(found.Cells[i] > 0, expected.High[i] == found.High[i]);
          EXPECT_EQ(found.Cells[i] > 0, expected.Mean[i] == found.Mean[i]);
        }
      });
  }
}

TEST(Zones, OnMeshEdgesLeaveOutAdjacentTriangles)
{
  const SourceMesh source = wavy(8, 0);
  const ResidentMesh mesh(inMemory(source));
  const std::vector<Zone> zones = { { rectangle(0.25, 0.75, 0.25, 0.5) } };
  const ZoneStatistics labels = statisticsOf(mesh, zones, "label", 0);
  EXPECT_EQ(16, labels.Cells[0]);
  EXPECT_EQ(0.125, labels.Area[0]);
  const std::vector<std::int64_t> inside = cellsIn(mesh, { {}, zones[0] }, true);
  EXPECT_EQ(16U, inside.size());
  std::int16_t low = 32767;
  for (const std::int64_t cell : inside)
  {
    low = std::min(low, source.Labels[std::size_t(cell)]);
  }
  EXPECT_EQ(low, labels.Low[0]);
}

TEST(Zones, HaveTheExtremesOfTheirCorners)
{
  SourceMesh source = makeSource(latticeTriangles(8, 0.3));
  for (std::size_t i = 0; i < source.points(); ++i)
  {
    source.Values[2 * i] = float(pointOf(source, std::int64_t(i)).x);
  }
  const ResidentMesh mesh(inMemory(source));
  const ZoneStatistics found = statisticsOf(mesh,
    { { rectangle(0.31, 0.83, 0.2, 0.4) },
      { { { { 0.9, 0.1 }, { 0.42, 0.5 }, { 0.9, 0.9 } }, false } } },
    "value", 0);
  EXPECT_NEAR(0.31, found.Low[0], 1e-6);
  EXPECT_NEAR(0.83, found.High[0], 1e-6);
  EXPECT_NEAR(0.42, found.Low[1], 1e-6);
  EXPECT_NEAR(0.9, found.High[1], 1e-6);
}

TEST(Zones, NearlyOnMeshEdgesHaveTheExactArea)
{
  const SourceMesh source = wavy(8, 0);
  const ResidentMesh mesh(inMemory(source));
  std::mt19937 random(4);
  std::uniform_int_distribution<int> ulps(-2, 2);
  const auto moved = [&](double value)
  {
    for (int i = ulps(random); i != 0; i += i > 0 ? -1 : 1)
    {
      value = std::nextafter(value, i > 0 ? 2.0 : -2.0);
    }
    return value;
  };
  std::vector<Zone> zones;
  for (int i = 0; i < 200; ++i)
  {
    ZoneRing ring;
    for (const Point2 p : { Point2{ 0.25, 0.25 }, { 0.5, 0.25 }, { 0.75, 0.25 }, { 0.75, 0.5 },
           { 0.625, 0.625 }, { 0.5, 0.5 }, { 0.25, 0.5 } })
    {
      ring.Corners.push_back({ moved(p.x), moved(p.y) });
    }
    zones.push_back({ ring });
  }
  const ZoneStatistics found = statisticsOf(mesh, zones, "value", 0);
  for (std::size_t i = 0; i < zones.size(); ++i)
  {
    const auto expected = bruteForce(source, zones[i], 0);
    EXPECT_NEAR(expected[0].get_d(), found.Area[i], 1e-14);
    EXPECT_NEAR(expected[1].get_d(), found.Sum[i], 1e-14);
  }
}

TEST(Zones, MayHaveEitherOrientation)
{
  const SourceMesh source = wavy(6, 0.3);
  const ResidentMesh mesh(inMemory(source));
  Zone zone = manyZones()[8];
  const double area = statisticsOf(mesh, { zone }, "value", 0).Area[0];
  for (ZoneRing& ring : zone)
  {
    std::reverse(ring.Corners.begin(), ring.Corners.end());
    ring.Corners.push_back(ring.Corners.front()); // the last corner may equal the first
  }
  EXPECT_EQ(area, statisticsOf(mesh, { zone }, "value", 0).Area[0]);
}

TEST(Zones, LeaveOutTrianglesWithoutValues)
{
  SourceMesh source = wavy(8, 0);
  const std::vector<Zone> zones = { { rectangle(0, 1, 0, 1) } };
  source.Values[2 * std::size_t(source.Cells[0])] = NAN;
  const ZoneStatistics found = statisticsOf(ResidentMesh(inMemory(source)), zones, "value", 0);
  EXPECT_GT(1, found.Area[0]);
  EXPECT_LT(0.8, found.Area[0]);
  EXPECT_TRUE(std::isfinite(found.Mean[0]));
}

TEST(Zones, RefusePolygonsThatCrossThemselves)
{
  const ResidentMesh mesh(inMemory(wavy(4, 0)));
  const Zone bowTie = { { { { 0, 0 }, { 1, 1 }, { 1, 0 }, { 0, 1 } }, false } };
  EXPECT_THROW(statisticsOf(mesh, { bowTie }, "value", 0), IOError);
  EXPECT_THROW(statisticsOf(mesh, { { rectangle(0, NAN, 0, 1) } }, "value", 0), IOError);
  EXPECT_THROW(statisticsOf(mesh, {}, "value", 0, NAN), IOError);
  EXPECT_THROW(statisticsOf(mesh, {}, "value", 5), IOError);
  const ResidentMesh tetrahedra(inMemory(makeSource(latticeTetrahedra(2, 0))));
  EXPECT_THROW(statisticsOf(tetrahedra, {}, "value", 0), IOError);
  EXPECT_THROW(cellsIn(tetrahedra, { {}, bowTie }, false), IOError);
  EXPECT_THROW(cellsIn(mesh, { { { 1, 0, 0 }, { 0, 1, 0 } }, {} }, false), IOError);
}

TEST(Regions, HaveTheCellsAndPointsOfBruteForce)
{
  for (const double jitter : { 0.3, 0.0 })
  {
    const SourceMesh source = wavy(6, jitter);
    std::vector<Zone> zones = manyZones();
    zones.pop_back(); // the last zone has no rings
    std::vector<InZone> expected;
    for (const Zone& zone : zones)
    {
      expected.push_back(bruteForce(source, zone));
    }
    withEachMesh(source,
      [&](const ResidentMesh& mesh)
      {
        for (std::size_t i = 0; i < zones.size(); ++i)
        {
          SCOPED_TRACE(i);
          const InZone& in = expected[i];
          const std::vector<std::int64_t> found = cellsIn(mesh, { {}, zones[i] }, false);
          EXPECT_TRUE(std::includes(found.begin(), found.end(), in.Met.begin(), in.Met.end()));
          if (jitter > 0) // with jitter, no triangle is only touched
          {
            EXPECT_EQ(in.Met, found);
          }
          EXPECT_EQ(in.Whole, cellsIn(mesh, { {}, zones[i] }, true));
          EXPECT_EQ(in.Points, pointsIn(mesh, { {}, zones[i] }));
        }
      });
  }
}

TEST(ExactSum, IsTheNearestDoubleInAnyOrder)
{
  std::mt19937 random(3);
  std::uniform_int_distribution<int> exponent(-60, 60);
  std::normal_distribution<double> mantissa;
  for (int round = 0; round < 100; ++round)
  {
    std::vector<double> terms;
    mpq_class exact = 0;
    for (int i = 0; i < 50; ++i)
    {
      terms.push_back(std::ldexp(mantissa(random), exponent(random)));
      exact += mpq_class(terms.back());
    }
    terms.push_back(-exact.get_d()); // so that the sum is small
    exact += mpq_class(terms.back());
    double first = 0;
    for (int order = 0; order < 3; ++order)
    {
      ExactSum sums[2];
      for (std::size_t i = 0; i < terms.size(); ++i)
      {
        sums[i % 2].add(terms[i]);
      }
      sums[0].add(sums[1]);
      const double value = sums[0].value();
      first = order == 0 ? value : first;
      EXPECT_EQ(first, value);
      const mpq_class error = abs(exact - mpq_class(value));
      for (const double other :
        { std::nextafter(value, HUGE_VAL), std::nextafter(value, -HUGE_VAL) })
      {
        EXPECT_LE(error, abs(exact - mpq_class(other)));
      }
      std::shuffle(terms.begin(), terms.end(), random);
    }
  }
}
