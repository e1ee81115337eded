// SPDX-License-Identifier: BSD-3-Clause
// The nodes of a storm-surge mesh and a magnetic survey, on several ranks.
#include "DistributedTesting.h"
#include "RealData.h"

#include <gtest/gtest.h>

namespace
{

using namespace tipp;
using namespace tipp::test;

void expectAsByCgal(const std::string& name, const Coordinates& xy, Masters design)
{
  DistributedOptions options;
  options.Design = design;
  options.Threads = 1;
  const Gathered result = triangulateShares(xy, Share::RoundRobin, options);
  if (rank() == 0)
  {
    EXPECT_TRUE(matches(xy, result, cachedReference(name, xy)));
  }
}

TEST(DistributedRealData, EC95dIsTriangulatedAsByCgal)
{
  TIPP_REQUIRE_REAL_DATA(path, "adcirc/ec95d/ec95d.grd");
  const Coordinates nodes = readAdcirc(path).Nodes;
  expectAsByCgal("ec95d", nodes, Masters::Single);
  expectAsByCgal("ec95d", nodes, Masters::Multi);
}

TEST(DistributedRealData, TheMagneticSurveyIsTriangulatedAsByCgal)
{
  TIPP_REQUIRE_REAL_DATA(path, "points/osborne-magnetic.csv.xz");
  expectAsByCgal("osborne", readCompressedTable(path, ',', true, 1, 2), Masters::Multi);
}

} // namespace
