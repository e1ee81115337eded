// SPDX-License-Identifier: BSD-3-Clause
// The results of the passes over the input do not depend on how the input is divided among ranks.
#include "Comparison.h"
#include "TemporaryFolder.h"
#include "Triangulation/InputSurvey.h"

#include "Npy/NpyFile.h"
#include "OutOfCore/InputPasses.h"

#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

namespace
{

using namespace tipp;
using namespace tipp::test;

InputSurvey surveyOf(PointStream& points)
{
  return InputPasses(points, nullptr, { 1 << 14, 1 << 10, 2, [](std::int64_t) {} }).survey();
}

TEST(InputSurvey, IsTheSameForAnyDivisionOfTheInput)
{
  const TemporaryFolder folder;
  const std::vector<std::string> names{ folder.path("points.npy"), "uniform:3000" };
  writePoints(names[0], makePointSet("lattice", 7001));
  // The number of points in a text file is unknown, so its sample is thinned while the file is
  // read.
  std::vector<double> xy;
  const auto whole = openPointStream(names);
  forEachBlock(
    *whole, 999, [&](PointBlock& block) { xy.insert(xy.end(), block.XY.begin(), block.XY.end()); });
  std::ofstream file(folder.path("points.xyz"));
  file.precision(17);
  for (std::size_t i = 0; i < xy.size(); i += 2)
  {
    file << xy[i] << " " << xy[i + 1] << "\n";
  }
  file.close();
  const auto unknown = openPointStream({ folder.path("points.xyz") });
  ASSERT_EQ(-1, unknown->divisible());
  ASSERT_EQ(10001, whole->divisible());
  const InputSurvey expected = surveyOf(*unknown);
  for (const std::int64_t cuts : { 1, 2, 7 })
  {
    std::vector<InputSurvey> parts;
    for (std::int64_t part = 0; part < cuts; ++part)
    {
      whole->limitTo(10001 * part / cuts, 10001 * (part + 1) / cuts);
      parts.push_back(surveyPart<2>(*whole, 10001, { 500, 1 << 10, 2, [](std::int64_t) {} }));
    }
    const InputSurvey survey = joinSurveys(parts);
    EXPECT_EQ(10001, survey.Points);
    EXPECT_EQ(expected.Bounds.Max.x, survey.Bounds.Max.x);
    ASSERT_EQ(expected.Sample.size(), survey.Sample.size());
    for (std::size_t i = 0; i < survey.Sample.size(); ++i)
    {
      ASSERT_EQ(expected.Sample[i].Id, survey.Sample[i].Id);
      ASSERT_TRUE(expected.Sample[i].Position == survey.Sample[i].Position);
    }
  }
}

TEST(InputSurvey, PartsOnDifferentLinesAreNotCollinear)
{
  InputSurvey a;
  a.Simplex = { { 0, 0 }, { 1, 1 } };
  InputSurvey b;
  b.Simplex = { { 2, 2 }, { 3, 3 } };
  InputSurvey c;
  c.Simplex = { { 2, 2 }, { 3, 4 } };
  std::vector<InputSurvey> on{ a, b };
  EXPECT_EQ(1, joinSurveys(on).dimension());
  std::vector<InputSurvey> off{ a, b, c };
  EXPECT_EQ(2, joinSurveys(off).dimension());
}

} // namespace
