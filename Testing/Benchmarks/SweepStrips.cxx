// SPDX-License-Identifier: BSD-3-Clause
#include "SweepStrips.h"

#include <algorithm>
#include <limits>

namespace tipp
{
namespace
{

/// The least x of each strip except the first. Each strip has about the same number of sample
/// points.
std::vector<double> chooseCuts(const Point2* points, std::size_t count, std::size_t strips)
{
  constexpr std::size_t sampledInStrip = 64;
  // Samples at multiples of the golden ratio are evenly spread, and do not follow the rows of a
  // lattice.
  constexpr std::uint64_t ratio = 0x9e3779b97f4a7c15U;
  std::vector<double> sample;
  for (std::size_t i = 0; i < sampledInStrip * strips; ++i)
  {
    const std::uint64_t fraction = std::uint64_t(i) * ratio >> 32;
    sample.push_back(points[std::size_t(fraction * count >> 32)].x);
  }
  std::sort(sample.begin(), sample.end());
  std::vector<double> cuts;
  for (std::size_t strip = 1; strip < strips; ++strip)
  {
    const double cut = sample[strip * sample.size() / strips];
    if (cuts.empty() || cuts.back() < cut)
    {
      cuts.push_back(cut);
    }
  }
  return cuts;
}

} // namespace

SweepStrips::SweepStrips(const Point2* points, std::size_t count, std::size_t pointsInStrip)
{
  const std::size_t strips = std::max<std::size_t>(count / pointsInStrip, 1);
  this->Cuts = chooseCuts(points, count, strips);
  this->Bounds = Box2::empty();
  this->Starts.assign(this->Cuts.size() + 2, 0);
  std::vector<std::uint32_t> stripOf(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    const Point2 p = points[i];
    this->Bounds.extend(p);
    const auto behind = std::upper_bound(this->Cuts.begin(), this->Cuts.end(), p.x);
    stripOf[i] = std::uint32_t(behind - this->Cuts.begin());
    ++this->Starts[stripOf[i] + 1];
  }
  for (std::size_t strip = 1; strip < this->Starts.size(); ++strip)
  {
    this->Starts[strip] += this->Starts[strip - 1];
  }
  this->Order.resize(count);
  std::vector<std::size_t> next(this->Starts.begin(), this->Starts.end() - 1);
  for (std::size_t i = 0; i < count; ++i)
  {
    this->Order[next[stripOf[i]]++] = std::uint32_t(i);
  }
}

Box2 SweepStrips::boxFrom(std::size_t strip) const
{
  Box2 box = this->Bounds;
  box.Min.x = strip == 0 ? box.Min.x : this->Cuts[strip - 1];
  return box;
}

std::size_t SweepStrips::bytes() const
{
  return this->Order.capacity() * sizeof(std::uint32_t);
}

} // namespace tipp
