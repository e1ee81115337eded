// SPDX-License-Identifier: BSD-3-Clause
#include "Distributions/GeneratePoints.h"

#include "Arrays/Random.h"
#include "Files/TextFile.h"
#include "Points/ReadPoints.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace tipp
{
namespace
{

using Vector = Random::Pair;

constexpr double extent = 40;       // degrees across
constexpr double continent = 8;     // radius of the largest shoreline, degrees
constexpr double roughness = 0.2;   // standard deviation of a midpoint's displacement / edge length
constexpr double unevenness = 0.32; // an edge's points are split between its halves 0.5 +- this
constexpr int continents = 6;
constexpr int corners = 6; // of a shoreline before it is subdivided

class CoastGenerator
{
public:
  CoastGenerator(std::int64_t count, Random& generator)
    : Count(count)
    , Generator(generator)
  {
    this->XY.reserve(2 * std::size_t(count));
  }

  std::vector<double> generate()
  {
    // Continents take two thirds of the points, each half as many as the one before.
    std::int64_t size = this->Count / 3;
    for (int i = 0; i < continents; ++i, size /= 2)
    {
      this->addShoreline({ this->Generator.uniform(0, extent), this->Generator.uniform(0, extent) },
        std::max<std::int64_t>(size, 1));
    }
    while (this->size() < this->Count)
    {
      this->addIsland();
    }
    return std::move(this->XY);
  }

private:
  std::int64_t size() const { return std::int64_t(this->XY.size() / 2); }

  // Adds an island near an existing shore. Sizes are Pareto-distributed, like those of real
  // islands.
  void addIsland()
  {
    const double u = 1 - this->Generator.uniform();
    const double pareto = corners / (u * std::sqrt(u)); // exponent 2/3
    const auto size = std::int64_t(std::min(pareto, double(this->Count) / 16 + corners));
    const std::int64_t shore = this->Generator.index(this->size());
    const double distance = 3 * this->radius(size);
    const Vector offset = this->Generator.normal();
    this->addShoreline(
      { this->XY[2 * shore] + distance * offset.x, this->XY[2 * shore + 1] + distance * offset.y },
      size);
  }

  // The length of a shoreline of fractal dimension D grows as radius^D: here D is about 4/3.
  double radius(std::int64_t size) const
  {
    const double share = 3 * double(size) / double(this->Count);
    return continent * std::sqrt(share * std::sqrt(share));
  }

  void addShoreline(Vector centre, std::int64_t wanted)
  {
    const std::int64_t size = std::min(wanted, this->Count - this->size());
    const double r = this->radius(size);
    // Starts from a hexagon with randomly displaced corners.
    constexpr double h = 0.86602540378443865;
    constexpr Vector hexagon[corners] = { { 1, 0 }, { 0.5, h }, { -0.5, h }, { -1, 0 },
      { -0.5, -h }, { 0.5, -h } };
    Vector ring[corners];
    for (int i = 0; i < corners; ++i)
    {
      const double reach = r * this->Generator.uniform(0.6, 1.4);
      ring[i] = { centre.x + reach * hexagon[i].x, centre.y + reach * hexagon[i].y };
    }
    for (int i = 0; i < corners; ++i)
    {
      const std::int64_t share = size * (i + 1) / corners - size * i / corners;
      if (share > 0)
      {
        this->addPoint(ring[i]);
        this->subdivide(ring[i], ring[(i + 1) % corners], share - 1);
      }
    }
  }

  // Puts `points` points between a and b. The depth is at most log(points) / -log(0.5 +
  // unevenness).
  void subdivide(Vector a, Vector b, std::int64_t points)
  {
    if (points == 0)
    {
      return;
    }
    const double shift = roughness * this->normal();
    const Vector middle = { 0.5 * (a.x + b.x) - shift * (b.y - a.y),
      0.5 * (a.y + b.y) + shift * (b.x - a.x) };
    const double part = this->Generator.uniform(0.5 - unevenness, 0.5 + unevenness);
    const auto left = std::int64_t(double(points - 1) * part);
    this->subdivide(a, middle, left);
    this->addPoint(middle);
    this->subdivide(middle, b, points - 1 - left);
  }

  // normal() returns two numbers at a time.
  double normal()
  {
    if (const auto spare = std::exchange(this->Spare, std::nullopt))
    {
      return *spare;
    }
    const Vector pair = this->Generator.normal();
    this->Spare = pair.y;
    return pair.x;
  }

  void addPoint(Vector p)
  {
    this->XY.push_back(std::round(p.x * 1e6) / 1e6);
    this->XY.push_back(std::round(p.y * 1e6) / 1e6);
  }

  std::int64_t Count;
  Random& Generator;
  std::vector<double> XY;
  std::optional<double> Spare;
};

/// In the order of the enumerators.
constexpr std::array<const char*, 7> names = { "uniform", "clustered", "kuzmin", "lattice", "coast",
  "circle", "collinear" };

template <typename MakePoint>
std::vector<double> fill(std::int64_t count, MakePoint makePoint)
{
  std::vector<double> xy(2 * std::size_t(count));
  for (std::int64_t i = 0; i < count; ++i)
  {
    const Random::Pair p = makePoint(i);
    xy[2 * i] = p.x;
    xy[2 * i + 1] = p.y;
  }
  return xy;
}

std::vector<double> generateClustered(std::int64_t count, Random& random)
{
  struct Cluster
  {
    Random::Pair Centre;
    double Sigma;
  };
  constexpr double logThousand = 6.9077552789821371;
  std::array<Cluster, 100> clusters;
  for (Cluster& cluster : clusters)
  {
    cluster.Centre = { random.uniform(), random.uniform() };
    cluster.Sigma = 1e-5 * Random::exponential(logThousand * random.uniform());
  }
  return fill(count,
    [&](std::int64_t)
    {
      const Cluster& cluster = clusters[std::size_t(random.index(std::int64_t(clusters.size())))];
      const Random::Pair n = random.normal();
      return Random::Pair{ cluster.Centre.x + cluster.Sigma * n.x,
        cluster.Centre.y + cluster.Sigma * n.y };
    });
}

std::vector<double> generateKuzmin(std::int64_t count, Random& random)
{
  return fill(count,
    [&](std::int64_t)
    {
      const double outside = 1 - random.uniform(); // in (0, 1]
      const double r = std::sqrt(1 / (outside * outside) - 1);
      const Random::Pair direction = random.onCircle();
      return Random::Pair{ r * direction.x, r * direction.y };
    });
}

std::vector<double> generateLattice(std::int64_t count)
{
  auto width = std::int64_t(std::sqrt(double(count)));
  while (width * width < count)
  {
    ++width;
  }
  return fill(count,
    [&](std::int64_t i)
    {
      const std::int64_t row = i / width;
      return Random::Pair{ double(i % width), double(row) };
    });
}

std::vector<double> generateCollinear(std::int64_t count, Random& random)
{
  const double dx = double(1 + random.index(1023));
  const double dy = double(1 + random.index(1023));
  std::vector<double> xy = fill(count,
    [&](std::int64_t k) {
      return Random::Pair{ double(k) * dx, double(k) * dy };
    });
  for (std::int64_t i = count - 1; i > 0; --i)
  {
    const std::int64_t j = random.index(i + 1);
    std::swap(xy[2 * i], xy[2 * j]);
    std::swap(xy[2 * i + 1], xy[2 * j + 1]);
  }
  return xy;
}

} // namespace

std::vector<double> generatePoints(
  Distribution distribution, std::int64_t count, std::uint64_t seed)
{
  if (count < 0 || count > std::int64_t(1) << 40)
  {
    throw std::invalid_argument("the number of points must lie between 0 and 2^40");
  }
  Random random(seed);
  switch (distribution)
  {
    case Distribution::Clustered:
      return generateClustered(count, random);
    case Distribution::Kuzmin:
      return generateKuzmin(count, random);
    case Distribution::Lattice:
      return generateLattice(count);
    case Distribution::Coast:
      return count > 0 ? CoastGenerator(count, random).generate() : std::vector<double>();
    case Distribution::Circle:
      return fill(count, [&](std::int64_t) { return random.onCircle(); });
    case Distribution::Collinear:
      return generateCollinear(count, random);
    case Distribution::Uniform:
      break;
  }
  return fill(count,
    [&](std::int64_t)
    {
      const double x = random.uniform();
      return Random::Pair{ x, random.uniform() };
    });
}

std::optional<Distribution> distributionFromName(std::string_view name)
{
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? std::nullopt
                              : std::make_optional(Distribution(found - names.begin()));
}

std::vector<std::string> distributionNames()
{
  return { names.begin(), names.end() };
}

std::int64_t generatedCount(const std::string& name)
{
  const std::string start = "uniform:";
  if (name.compare(0, start.size(), start) != 0)
  {
    return 0;
  }
  const auto count = wholeNumber<std::int64_t>(name.substr(start.size()));
  constexpr std::int64_t most = std::int64_t(1) << 40;
  return count && *count > 0 && *count <= most ? *count : 0;
}

namespace
{

/// The points of Distribution::Uniform with seed 1, generated block by block.
class GeneratedPoints : public FilePoints
{
public:
  GeneratedPoints(std::int64_t count, bool inSpace)
    : Count(count)
    , InSpace(inSpace)
  {
  }

  bool next(PointBlock& block, std::size_t most) override
  {
    const auto count = std::size_t(std::min(std::int64_t(most), this->Count - this->At));
    block.Columns.resize(this->InSpace ? 1 : 0);
    block.resize(count);
    for (std::size_t i = 0; i < count; ++i)
    {
      block.XY[2 * i] = this->Numbers.uniform();
      block.XY[2 * i + 1] = this->Numbers.uniform();
      for (std::vector<double>& z : block.Columns)
      {
        z[i] = this->Numbers.uniform();
      }
    }
    this->At += std::int64_t(count);
    return count > 0;
  }

  void rewind() override
  {
    this->Numbers = Random(1);
    this->At = 0;
  }

  std::int64_t divisible() const override { return this->Count; }

  void skip(std::int64_t points) override
  {
    for (std::int64_t i = 0; i < (this->InSpace ? 3 : 2) * points; ++i)
    {
      this->Numbers.bits(); // one number per coordinate; cheap compared with other work
    }
    this->At += points;
  }

  std::vector<std::string> columns() const override
  {
    return this->InSpace ? std::vector<std::string>{ "z" } : std::vector<std::string>();
  }

private:
  const std::int64_t Count;
  const bool InSpace;
  std::int64_t At = 0;
  Random Numbers{ 1 };
};

} // namespace

std::unique_ptr<FilePoints> openGeneratedPoints(std::int64_t count, bool inSpace)
{
  return std::make_unique<GeneratedPoints>(count, inSpace);
}

} // namespace tipp
