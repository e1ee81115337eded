// SPDX-License-Identifier: BSD-3-Clause
#include "Check/ExactTests.h"

#include <gtest/gtest.h>

namespace
{

using tipp::check::countHullFaults;
using tipp::check::DirectedEdge;
using Edges = std::vector<DirectedEdge>;

const std::vector<double> pentagon{ 10, 0, 3, 9, -8, 6, -8, -6, 3, -9 };

std::int64_t faults(const std::vector<double>& xy, Edges edges)
{
  return countHullFaults(xy, edges);
}

} // namespace

TEST(Hull, ConvexChainHasNoFault)
{
  EXPECT_EQ(0, faults(pentagon, { { 0, 1 }, { 1, 2 }, { 2, 3 }, { 3, 4 }, { 4, 0 } }));
}

TEST(Hull, OrderOfTheEdgesDoesNotMatter)
{
  EXPECT_EQ(0, faults(pentagon, { { 3, 4 }, { 1, 2 }, { 4, 0 }, { 0, 1 }, { 2, 3 } }));
}

TEST(Hull, ClockwiseChainIsWrongEverywhere)
{
  EXPECT_GE(faults(pentagon, { { 1, 0 }, { 2, 1 }, { 3, 2 }, { 4, 3 }, { 0, 4 } }), 5);
}

TEST(Hull, StarThatWindsTwiceIsWrongAlthoughItTurnsLeft)
{
  EXPECT_GE(faults(pentagon, { { 0, 2 }, { 2, 4 }, { 4, 1 }, { 1, 3 }, { 3, 0 } }), 1);
}

TEST(Hull, DentIsOneFault)
{
  const std::vector<double> dented{ 0, 0, 4, 0, 4, 4, 2, 3, 0, 4 };
  EXPECT_EQ(1, faults(dented, { { 0, 1 }, { 1, 2 }, { 2, 3 }, { 3, 4 }, { 4, 0 } }));
}

TEST(Hull, CollinearRunIsAllowedForwardsOnly)
{
  const std::vector<double> xy{ 0, 0, 1, 0, 2, 0, 1, 1 };
  EXPECT_EQ(0, faults(xy, { { 0, 1 }, { 1, 2 }, { 2, 3 }, { 3, 0 } }));
  EXPECT_GE(faults(xy, { { 0, 2 }, { 2, 1 }, { 1, 3 }, { 3, 0 } }), 1);
}

TEST(Hull, OpenChainIsWrong)
{
  EXPECT_GE(faults(pentagon, { { 0, 1 }, { 1, 2 }, { 2, 3 } }), 1);
}

TEST(Hull, VertexPassedTwiceIsWrong)
{
  const std::vector<double> bowTie{ 0, 0, 2, -1, 2, 1, -2, 1, -2, -1 };
  EXPECT_GE(faults(bowTie, { { 0, 1 }, { 1, 2 }, { 2, 0 }, { 0, 3 }, { 3, 4 }, { 4, 0 } }), 1);
}

TEST(Hull, ChainThatRunsIntoALoopEnds)
{
  EXPECT_GE(faults(pentagon, { { 0, 1 }, { 1, 2 }, { 2, 3 }, { 3, 1 } }), 1);
}
