// SPDX-License-Identifier: BSD-3-Clause
#include "Distributions/GeneratePoints.h"

#include "Distributions/Coast.h"
#include "Distributions/Random.h"

#include <array>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <utility>

namespace tipp
{
namespace
{

struct Named
{
  Distribution Value;
  const char* Name;
};

constexpr std::array<Named, 7> table = { {
  { Distribution::Uniform, "uniform" },
  { Distribution::Clustered, "clustered" },
  { Distribution::Kuzmin, "kuzmin" },
  { Distribution::Lattice, "lattice" },
  { Distribution::Coast, "coast" },
  { Distribution::Circle, "circle" },
  { Distribution::Collinear, "collinear" },
} };

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
      return generateCoast(count, random);
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

std::string distributionName(Distribution distribution)
{
  return table[std::size_t(distribution)].Name;
}

std::optional<Distribution> distributionFromName(std::string_view name)
{
  for (const Named& entry : table)
  {
    if (name == entry.Name)
    {
      return entry.Value;
    }
  }
  return std::nullopt;
}

std::vector<std::string> distributionNames()
{
  std::vector<std::string> names;
  names.reserve(std::size(table));
  for (const Named& entry : table)
  {
    names.emplace_back(entry.Name);
  }
  return names;
}

} // namespace tipp
