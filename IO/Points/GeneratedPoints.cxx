// SPDX-License-Identifier: BSD-3-Clause
#include "Distributions/Random.h"
#include "Points/FilePoints.h"

#include <algorithm>
#include <charconv>

namespace tipp
{
namespace
{

/// The points of Distribution::Uniform with seed 1, made as they are wanted.
class GeneratedPoints : public FilePoints
{
public:
  explicit GeneratedPoints(std::int64_t count)
    : Count(count)
  {
  }

  bool next(PointBlock& block, std::size_t most) override
  {
    const auto count = std::size_t(std::min(std::int64_t(most), this->Count - this->At));
    block.XY.resize(2 * count);
    for (double& coordinate : block.XY)
    {
      coordinate = this->Numbers.uniform();
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
    for (std::int64_t i = 0; i < 2 * points; ++i)
    {
      this->Numbers.bits(); // one a coordinate; little of what becomes of a point
    }
    this->At += points;
  }

  std::vector<std::string> columns() const override { return {}; }

private:
  std::int64_t Count;
  std::int64_t At = 0;
  Random Numbers{ 1 };
};

} // namespace

std::int64_t generatedCount(const std::string& name)
{
  const std::string start = "uniform:";
  std::int64_t count = 0;
  const char* const end = name.data() + name.size();
  if (name.compare(0, start.size(), start) != 0)
  {
    return 0;
  }
  const auto [stop, error] = std::from_chars(name.data() + start.size(), end, count);
  constexpr std::int64_t most = std::int64_t(1) << 40;
  return error == std::errc() && stop == end && count > 0 && count <= most ? count : 0;
}

std::unique_ptr<FilePoints> generatePointsAsWanted(std::int64_t count)
{
  return std::make_unique<GeneratedPoints>(count);
}

} // namespace tipp
