// SPDX-License-Identifier: BSD-3-Clause
#include "Series/ResampleSeries.h"
#include "Series/SeriesAtPoints.h"

#include "Resample/Resample.h"
#include "Sampling/SamplingLattice.h"

#include "ExpectIOError.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

using namespace tipp;
using namespace tipp::test;

namespace
{

constexpr double dry = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t side = 12;

/// A mesh of the unit square with a variable of each kind.
class Basin : public MeshSeries
{
public:
  explicit Basin(std::size_t steps)
  {
    this->Path = "basin";
    this->Nodes = side * side;
    this->TimeUnits = "hours since 2008-09-01";
    std::mt19937 generator(5);
    std::uniform_real_distribution<double> shift(-0.3, 0.3);
    for (std::size_t i = 0; i < side * side; ++i)
    {
      this->XY.push_back((double(i % side) + shift(generator)) / (side - 1));
      this->XY.push_back((double(i / side) + shift(generator)) / (side - 1));
    }
    for (std::size_t step = 0; step < steps; ++step)
    {
      this->Times.push_back(double(step * step));
    }
    this->Variables = { { "level", "water level", "m", Scalar::Float64, false, true },
      { "depth", "", "m", Scalar::Float64, false, false },
      { "rain", "", "", Scalar::Float32, true, true },
      { "zone", "", "", Scalar::Int32, true, false } };
  }

  SeriesMesh readMesh() override
  {
    SeriesMesh mesh;
    mesh.XY = this->XY;
    for (std::size_t i = 0; i + side < side * side; ++i)
    {
      if (i % side + 1 < side)
      {
        const auto a = std::int64_t(i);
        mesh.Triangles.insert(mesh.Triangles.end(),
          { a, a + 1, a + std::int64_t(side), a + 1, a + 1 + std::int64_t(side),
            a + std::int64_t(side) });
      }
    }
    return mesh;
  }

  void read(std::size_t variable, std::size_t step, std::vector<double>& values) override
  {
    const bool onCells = this->Variables[variable].OnCells;
    values.resize(onCells ? 2 * (side - 1) * (side - 1) : side * side);
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      values[i] = this->value(variable, step, i);
    }
    this->Reads += 1;
  }

  double value(std::size_t variable, std::size_t step, std::size_t i) const
  {
    const double x = this->XY[2 * i];
    switch (variable)
    {
      case 0:
        return x < this->Shore ? this->Level + std::sin(double(step) + 3 * x) : dry;
      case 1:
        return 0.5 - x;
      case 2:
        return double(100 * step + i);
      default:
        return double(i);
    }
  }

  std::vector<double> XY;
  double Level = 0;
  double Shore = 2; ///< nodes beyond it are dry
  int Reads = 0;
};

/// A basin whose mesh has nodes beyond all triangles.
class WithFarNodes : public Basin
{
public:
  using Basin::Basin;

  SeriesMesh readMesh() override
  {
    SeriesMesh mesh = Basin::readMesh();
    mesh.XY.insert(mesh.XY.end(), { 50, 60, -70, 80 });
    return mesh;
  }
};

/// Keeps what is written.
class Kept : public SeriesOutput
{
public:
  void write(std::size_t field, std::size_t step, const float* samples) override
  {
    this->Fields.push_back(field);
    this->Steps.push_back(step);
    this->Samples.emplace_back(samples, samples + this->Size);
  }
  void close() override {}

  const std::vector<float>& of(std::size_t field, std::size_t step) const
  {
    for (std::size_t i = 0; i < this->Fields.size(); ++i)
    {
      if (this->Fields[i] == field && this->Steps[i] == step)
      {
        return this->Samples[i];
      }
    }
    throw std::out_of_range("no such field");
  }

  std::size_t Size = 0;
  std::vector<std::size_t> Fields;
  std::vector<std::size_t> Steps;
  std::vector<std::vector<float>> Samples;
};

SeriesRange rangeOf(int samples)
{
  SeriesRange range;
  range.Bounds = Box2{ { -0.05, -0.05 }, { 1.05, 1.05 } };
  range.Dimensions = { samples, samples };
  return range;
}

Kept run(MeshSeries& series, const SeriesPlan& plan)
{
  const auto samples = findSamples(series, rangeOf(60), plan.Threads);
  Kept output;
  output.Size = std::size_t(samples->Kept.samples());
  EXPECT_TRUE(resampleSeries(series, *samples, plan, output));
  return output;
}

/// Compares samples up to the rounding of weights and values to 32 bits.
void expectSame(const std::vector<float>& a, const std::vector<float>& b)
{
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    const float bound = 3e-7F * std::fmax(1.0F, std::fabs(a[i]));
    ASSERT_TRUE(std::fabs(a[i] - b[i]) <= bound || (std::isnan(a[i]) && std::isnan(b[i])))
      << i << " " << a[i] << " " << b[i];
  }
}

/// What resample() makes of a variable at a step, rounded.
std::vector<float> resampled(Basin& series, std::size_t variable, std::size_t step)
{
  const SeriesMesh mesh = series.readMesh();
  std::vector<double> points;
  for (std::size_t i = 0; i < mesh.XY.size(); i += 2)
  {
    points.insert(points.end(), { mesh.XY[i], mesh.XY[i + 1], 0 });
  }
  SimplexMesh simplices;
  simplices.Points = points.data();
  simplices.PointCount = std::int64_t(points.size() / 3);
  simplices.Ids = mesh.Triangles.data();
  simplices.Wide = true;
  simplices.Cells = std::int64_t(mesh.Triangles.size() / 3);
  std::vector<double> values;
  series.read(variable, step, values);
  const Lattice grid = findSamples(series, rangeOf(60), 1)->Grid;
  std::vector<double> samples(std::size_t(grid.samples()));
  resample(simplices, grid,
    { { values.data(), samples.data(), Scalar::Float64, 1, series.Variables[variable].OnCells,
      dry } },
    {});
  return { samples.begin(), samples.end() };
}

} // namespace

TEST(ResampleSeries, SamplesEachStepAsResampleDoes)
{
  Basin series(4);
  SeriesPlan plan;
  plan.Variables = { 0, 1, 2, 3 };
  plan.Steps = { 0, 1, 2, 3 };
  for (const int threads : { 1, 3 })
  {
    plan.Threads = threads;
    const Kept output = run(series, plan);
    for (std::size_t variable = 0; variable < 4; ++variable)
    {
      for (std::size_t step = 0; step < (variable % 2 == 0 ? 4u : 1u); ++step)
      {
        expectSame(output.of(variable, step), resampled(series, variable, step));
      }
    }
    EXPECT_EQ((std::vector<std::size_t>{ 0, 2, 0, 2, 0, 2, 0, 2, 1, 3 }), output.Fields);
    EXPECT_EQ((std::vector<std::size_t>{ 0, 0, 1, 1, 2, 2, 3, 3, 0, 0 }), output.Steps);
  }
}

TEST(ResampleSeries, ReadsOnlyTheStepsThatAreAskedFor)
{
  Basin series(9);
  SeriesPlan plan;
  plan.Variables = { 0 };
  plan.Steps = { 2, 5 };
  const Kept output = run(series, plan);
  EXPECT_EQ(2, series.Reads);
  expectSame(output.of(0, 1), resampled(series, 0, 5));
}

TEST(ResampleSeries, ReducesWithoutWritingTheSteps)
{
  Basin series(5);
  SeriesPlan plan;
  plan.Variables = { 0, 2 };
  plan.Steps = { 0, 1, 2, 3, 4 };
  plan.WritesSteps = false;
  plan.Reductions = { *SeriesReduction::parse("max"), *SeriesReduction::parse("time-of-max") };
  plan.Threads = 2;
  const Kept output = run(series, plan);
  EXPECT_EQ((std::vector<std::size_t>{ 0, 1, 2, 3 }), output.Fields);
  const SeriesDescription description = describeSeries(series, plan, Lattice());
  ASSERT_EQ(4u, description.Fields.size());
  EXPECT_EQ("level_max", description.Fields[0].Name);
  EXPECT_EQ("rain_time_of_max", description.Fields[3].Name);
  EXPECT_EQ("time from the first step (0 hours since 2008-09-01) to the maximum of rain",
    description.Fields[3].LongName);
  std::vector<float> maximum = resampled(series, 0, 0);
  for (std::size_t step = 1; step < 5; ++step)
  {
    const std::vector<float> samples = resampled(series, 0, step);
    for (std::size_t i = 0; i < samples.size(); ++i)
    {
      maximum[i] = std::fmax(maximum[i], samples[i]);
    }
  }
  expectSame(output.of(0, 0), maximum);
  for (const float time : output.of(3, 0))
  {
    ASSERT_TRUE(time == 16 || std::isnan(time));
  }
}

TEST(ResampleSeries, EndsTheWaterWhereItMeetsTheGround)
{
  // The ground rises by 1 per unit of x, from -0.5; the level is about 0.
  Basin series(1);
  series.Shore = 0.55;
  SeriesPlan plan;
  plan.Variables = { 0 };
  plan.Steps = { 0 };
  const Kept atNodes = run(series, plan);
  plan.Depth = 1;
  const Kept atGround = run(series, plan);
  std::size_t more = 0;
  for (std::size_t i = 0; i < atNodes.Size; ++i)
  {
    const float level = atGround.of(0, 0)[i];
    if (!std::isnan(atNodes.of(0, 0)[i]))
    {
      ASSERT_EQ(atNodes.of(0, 0)[i], level);
    }
    else
    {
      more += !std::isnan(level);
    }
  }
  EXPECT_GT(more, 0u);
}

TEST(ResampleSeries, TakesANumberForNoValue)
{
  Basin series(1);
  SeriesPlan plan;
  plan.Variables = { 3 };
  plan.NoData = 7;
  const Kept output = run(series, plan);
  const std::vector<float> all = resampled(series, 3, 0);
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    ASSERT_EQ(std::isnan(output.of(0, 0)[i]), std::isnan(all[i]) || all[i] == 7);
  }
  EXPECT_EQ(1, std::count(all.begin(), all.end(), 7.0F) > 0);
}

TEST(ResampleSeries, RefusesValuesTooLargeForItsSamples)
{
  Basin series(1);
  series.Level = 1e39;
  SeriesPlan plan;
  plan.Variables = { 0 };
  plan.Steps = { 0 };
  const auto samples = findSamples(series, rangeOf(20), 1);
  Kept output;
  output.Size = std::size_t(samples->Kept.samples());
  expectIOError(
    "basin", "which 32 bits do not hold", [&] { resampleSeries(series, *samples, plan, output); });
}

TEST(ResampleSeries, HasTheBoundsOfTheTriangles)
{
  Basin basin(1);
  WithFarNodes other(1);
  SeriesRange range;
  range.Dimensions = { 30, 20 };
  const auto samples = findSamples(basin, range, 2);
  const auto same = findSamples(other, range, 2);
  EXPECT_EQ(samples->Grid.Min, same->Grid.Min);
  EXPECT_EQ(samples->Grid.Delta, same->Grid.Delta);
  EXPECT_EQ(samples->Kept.inside(), same->Kept.inside());
  EXPECT_GT(samples->Kept.inside(), 400);
}

TEST(ResampleSeries, HasNoValueWhereTheGridMissesAllTriangles)
{
  Basin series(1);
  SeriesRange range;
  range.Bounds = Box2{ { -1, -1 }, { 3, 3 } }; // with a sample at each corner
  range.Dimensions = { 2, 2 };
  SeriesPlan plan;
  plan.Variables = { 0, 2 };
  plan.Steps = { 0 };
  const auto samples = findSamples(series, range, 1);
  Kept output;
  output.Size = 4;
  ASSERT_TRUE(resampleSeries(series, *samples, plan, output));
  EXPECT_EQ(0, samples->Kept.inside());
  for (std::size_t i = 0; i < 4; ++i)
  {
    EXPECT_TRUE(std::isnan(output.of(0, 0)[i]));
    EXPECT_TRUE(std::isnan(output.of(1, 0)[i]));
  }
}

TEST(ResampleSeries, NamesARangeBesideTheMesh)
{
  Basin series(1);
  SeriesRange range = rangeOf(20);
  range.Bounds = Box2{ { 5, 5 }, { 6, 6 } };
  expectIOError("basin", "has nothing in --bounds", [&] { findSamples(series, range, 1); });
}

TEST(ResampleSeries, StopsWhenTheCallerWishes)
{
  Basin series(6);
  SeriesPlan plan;
  plan.Variables = { 0 };
  plan.Steps = { 0, 1, 2, 3, 4, 5 };
  int calls = 0; // one for two steps, which are sampled together
  plan.Progress = [&calls](double) { return ++calls < 3; };
  const auto samples = findSamples(series, rangeOf(20), 1);
  Kept output;
  output.Size = std::size_t(samples->Kept.samples());
  EXPECT_FALSE(resampleSeries(series, *samples, plan, output));
  EXPECT_EQ(4u, output.Samples.size());
  EXPECT_FALSE(findSamples(series, rangeOf(300), 1, [](double) { return false; }));
}

TEST(SeriesAtPoints, InterpolateInTheTriangleOfEachPoint)
{
  Basin series(2);
  const std::vector<Point3> points = { { 0.31, 0.62, 9 }, { 0.9, 0.05, 0 }, { 3, 3, 0 } };
  const SeriesAtPoints located(series, points, false, 2);
  std::vector<double> read;
  for (const std::int32_t node : located.stored(series.Variables[0]))
  {
    read.push_back(2 * series.XY[2 * std::size_t(node)] - series.XY[2 * std::size_t(node) + 1]);
  }
  const std::vector<double> values = located.valuesOf(series.Variables[0], read);
  EXPECT_NEAR(0.0, values[0], 1e-14);
  EXPECT_NEAR(1.75, values[1], 1e-14);
  EXPECT_TRUE(std::isnan(values[2]));
  series.readAt(3, 0, located.stored(series.Variables[3]), read);
  EXPECT_EQ(double(located.triangles()[1]), located.valuesOf(series.Variables[3], read)[1]);
  EXPECT_EQ(-1, located.triangles()[2]);
}

TEST(SeriesAtPoints, AreFoundATurnAwayIfTheyAreLongitudes)
{
  Basin series(1);
  const std::vector<Point3> points = { { 360.31, 0.62, 0 }, { -359.1, 0.05, 0 }, { 0.5, 0.5, 0 } };
  for (const bool wraps : { false, true })
  {
    const std::vector<std::int64_t> found = SeriesAtPoints(series, points, wraps, 2).triangles();
    EXPECT_EQ(wraps, found[0] >= 0);
    EXPECT_EQ(wraps, found[1] >= 0);
    EXPECT_GE(found[2], 0);
  }
}
