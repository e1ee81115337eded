// SPDX-License-Identifier: BSD-3-Clause
#include "Distributions/Coast.h"

#include <algorithm>
#include <cmath>

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

  // Pareto-distributed sizes, as islands have, near a shore that is already there.
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
    // A hexagon whose corners move at random.
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
    if (this->HasSpare)
    {
      this->HasSpare = false;
      return this->Spare;
    }
    const Vector pair = this->Generator.normal();
    this->Spare = pair.y;
    this->HasSpare = true;
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
  double Spare = 0;
  bool HasSpare = false;
};

} // namespace

std::vector<double> generateCoast(std::int64_t count, Random& random)
{
  if (count == 0)
  {
    return {};
  }
  return CoastGenerator(count, random).generate();
}

} // namespace tipp
