// SPDX-License-Identifier: BSD-3-Clause
#include "PointSets.h"

#include "Distributions/GeneratePoints.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <stdexcept>

namespace tipp
{
namespace test
{
namespace
{

constexpr double Pi = 3.14159265358979323846;

/// Uses no distribution of <random>: the standard fixes the sequence of the engine only.
class Random
{
public:
  explicit Random(std::uint64_t seed)
    : Engine(seed)
  {
  }
  /// Uniform in [0, 1).
  double unit() { return double(this->Engine() >> 11) * 0x1p-53; }
  double between(double low, double high) { return low + (high - low) * this->unit(); }
  std::size_t below(std::size_t n) { return std::size_t(this->Engine() % n); }
  /// Standard normal (Box and Muller).
  double normal()
  {
    const double radius = std::sqrt(-2 * std::log(1 - this->unit()));
    return radius * std::cos(2 * Pi * this->unit());
  }

private:
  std::mt19937_64 Engine;
};

void add(Coordinates& xy, double x, double y)
{
  xy.push_back(x);
  xy.push_back(y);
}

/// Calls make(i) `count` times; each call returns one point.
template <typename Make>
Coordinates repeat(std::size_t count, Make make)
{
  Coordinates xy;
  xy.reserve(2 * count);
  for (std::size_t i = 0; i < count; ++i)
  {
    make(xy, i);
  }
  return xy;
}

Coordinates uniform(std::size_t count, Random random)
{
  return repeat(count,
    [&](Coordinates& xy, std::size_t)
    {
      const double x = random.unit();
      add(xy, x, random.unit());
    });
}

/// A square lattice in random order, so that neighbours are far apart in the input.
Coordinates lattice(std::size_t count, double step, double jitter, Random random)
{
  const auto side = std::size_t(std::sqrt(double(count)) + 0.5);
  std::vector<std::size_t> order(side * side);
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    order[i] = i;
    std::swap(order[i], order[random.below(i + 1)]);
  }
  return repeat(order.size(),
    [&](Coordinates& xy, std::size_t i)
    {
      const double x = double(order[i] % side) + jitter * random.between(-0.5, 0.5);
      const double y = double(order[i] / side) + jitter * random.between(-0.5, 0.5);
      add(xy, x * step, y * step);
    });
}

/// A jittered lattice row by row, like the pixels of a raster file.
Coordinates jittered(std::size_t count, Random random)
{
  const auto side = std::size_t(std::sqrt(double(count)) + 0.5);
  return repeat(side * side,
    [&](Coordinates& xy, std::size_t i)
    {
      const double x = double(i % side) + random.between(-0.3, 0.3);
      add(xy, x, double(i / side) + random.between(-0.3, 0.3));
    });
}

/// Points with integer coordinates exactly on the circle of radius 5 * 13 * 17 * 29 about 0.
Coordinates cocircular(std::size_t count, Random random)
{
  constexpr long long radius = 5 * 13 * 17 * 29;
  Coordinates all;
  for (long long x = -radius; x <= radius; ++x)
  {
    const auto y = (long long)(std::sqrt(double(radius * radius - x * x)) + 0.5);
    if (x * x + y * y == radius * radius)
    {
      add(all, double(x), double(y));
      if (y != 0)
      {
        add(all, double(x), -double(y));
      }
    }
  }
  add(all, 0, 0);
  const std::size_t onCircle = all.size() / 2;
  for (std::size_t i = onCircle; i < count; ++i)
  {
    const double x = random.between(-radius, radius) / 2;
    add(all, x, random.between(-radius, radius) / 2);
  }
  return all;
}

Coordinates line(std::size_t count, double dx, double dy)
{
  return repeat(count, [&](Coordinates& xy, std::size_t i) { add(xy, dx * i, dy * i); });
}

Coordinates collinearAndOne(std::size_t count, Random)
{
  Coordinates xy = line(count - 1, 1, 2);
  add(xy, double(count) / 2, -3);
  return xy;
}

/// Points on ten parallel survey lines, exactly collinear.
Coordinates surveyLines(std::size_t count, Random random)
{
  return repeat(count,
    [&](Coordinates& xy, std::size_t i)
    { add(xy, std::floor(random.unit() * 1e6) / 64, 100.0 * double(i % 10)); });
}

Coordinates duplicates(std::size_t count, Random random)
{
  Coordinates xy = uniform(count / 2, random);
  for (std::size_t i = xy.size() / 2; i < count; ++i)
  {
    // A quarter of the remaining points are copies of point 0, the others of random points.
    const std::size_t from = i % 4 == 0 ? 0 : random.below(i);
    add(xy, xy[2 * from], xy[2 * from + 1]);
  }
  return xy;
}

/// Random points of a coarse lattice, with repetition: many duplicates, some of them on borders of
/// partitions.
Coordinates duplicateLattice(std::size_t count, Random random)
{
  return repeat(count,
    [&](Coordinates& xy, std::size_t)
    {
      const double x = double(random.below(33));
      add(xy, x, double(random.below(33)));
    });
}

/// Uniform points, scaled and then translated.
Coordinates placed(std::size_t count, Random random, double scale, double offset)
{
  Coordinates xy = uniform(count, random);
  for (double& c : xy)
  {
    c = offset + scale * c;
  }
  return xy;
}

/// Small multiples of the smallest doubles: all coordinates are denormal, with few bits, so there
/// are ties.
Coordinates denormal(std::size_t count, Random random)
{
  return repeat(count,
    [&](Coordinates& xy, std::size_t)
    {
      const double x = 4.9406564584124654e-324 * double(random.below(1000));
      const double y = 1e-310 + 4.9406564584124654e-324 * double(random.below(1000));
      add(xy, x, y);
    });
}

/// Coordinates so large that their differences overflow.
Coordinates largestDoubles(std::size_t count, Random random)
{
  Coordinates xy = placed(count, random, 2, -1);
  for (double& c : xy)
  {
    c *= 1.7e308;
  }
  return xy;
}

/// 1e12 plus a few units in the last place.
Coordinates tinySteps(std::size_t count, Random random)
{
  const double ulp = std::nextafter(1e12, 2e12) - 1e12;
  return repeat(count,
    [&](Coordinates& xy, std::size_t)
    {
      const double x = 1e12 + ulp * double(random.below(200));
      add(xy, x, 1e12 + ulp * double(random.below(200)));
    });
}

Coordinates oneFarAway(std::size_t count, Random random)
{
  Coordinates xy = uniform(count - 1, random);
  add(xy, 1e9, -3e8);
  return xy;
}

Coordinates twoClusters(std::size_t count, Random random)
{
  return repeat(count,
    [&](Coordinates& xy, std::size_t i)
    {
      const double centre = i % 2 == 0 ? 0 : 1e6;
      const double x = centre + random.normal();
      add(xy, x, centre + random.normal());
    });
}

Coordinates parabola(std::size_t count, Random random)
{
  return repeat(count,
    [&](Coordinates& xy, std::size_t)
    {
      const double x = random.between(-1, 1);
      add(xy, x, x * x);
    });
}

Coordinates spiral(std::size_t count, Random)
{
  return repeat(count,
    [&](Coordinates& xy, std::size_t i)
    {
      const double t = std::sqrt(double(i + 1));
      add(xy, t * std::cos(t), t * std::sin(t));
    });
}

Coordinates sorted(std::size_t count, Random random)
{
  Coordinates xy = uniform(count, random);
  std::vector<std::pair<double, double>> points;
  for (std::size_t i = 0; i < xy.size(); i += 2)
  {
    points.emplace_back(xy[i], xy[i + 1]);
  }
  std::sort(points.begin(), points.end());
  return repeat(points.size(),
    [&](Coordinates& out, std::size_t i) { add(out, points[i].first, points[i].second); });
}

Coordinates withRejected(std::size_t count, Random random)
{
  Coordinates xy = uniform(count, random);
  for (std::size_t i = 0; i < count; i += 97)
  {
    xy[2 * i + i % 2] = i % 3 == 0 ? std::nan("") : (i % 3 == 1 ? HUGE_VAL : -HUGE_VAL);
  }
  return xy;
}

using Maker = Coordinates (*)(std::size_t, Random);

const std::map<std::string, Maker>& makers()
{
  static const std::map<std::string, Maker> table = {
    { "lattice-shuffled", [](std::size_t n, Random r) { return lattice(n, 1, 0, r); } },
    { "lattice-tenths", [](std::size_t n, Random r) { return lattice(n, 0.1, 0, r); } },
    { "lattice-jittered", jittered },
    { "cocircular", cocircular },
    { "collinear-in-order", [](std::size_t n, Random) { return line(n, 1, 2); } },
    { "collinear-and-one", collinearAndOne },
    { "survey-lines", surveyLines },
    { "all-equal", [](std::size_t n, Random) { return line(n, 0, 0); } },
    { "duplicates", duplicates },
    { "duplicate-lattice", duplicateLattice },
    { "tiny-1e-300", [](std::size_t n, Random r) { return placed(n, r, 1e-300, 0); } },
    { "denormal", denormal },
    { "huge-1e300", [](std::size_t n, Random r) { return placed(n, r, 2e300, -1e300); } },
    { "largest-doubles", largestDoubles },
    { "steps-at-1e12", tinySteps },
    { "negative", [](std::size_t n, Random r) { return placed(n, r, 10, -200); } },
    { "one-far-away", oneFarAway },
    { "two-clusters", twoClusters },
    { "parabola", parabola },
    { "spiral", spiral },
    { "sorted", sorted },
    { "with-rejected", withRejected },
  };
  return table;
}

} // namespace

Coordinates makePointSet(const std::string& name, std::size_t count, std::uint64_t seed)
{
  if (const auto distribution = distributionFromName(name))
  {
    return generatePoints(*distribution, std::int64_t(count), seed);
  }
  const auto found = makers().find(name);
  if (found == makers().end())
  {
    throw std::invalid_argument("no point set is called '" + name + "'");
  }
  return found->second(count, Random(seed));
}

std::vector<std::string> pointSetNames()
{
  std::vector<std::string> names = distributionNames();
  for (const auto& entry : makers())
  {
    names.push_back(entry.first);
  }
  return names;
}

} // namespace test
} // namespace tipp
