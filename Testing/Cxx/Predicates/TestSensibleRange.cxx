// SPDX-License-Identifier: BSD-3-Clause
#include "Predicates/SensibleRange.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{

using tipp::Box3;

const Box3 points{ { 0, 100, 5 }, { 10, 120, 6 } };

/// Returns the sentence with which a range is refused; empty if it is not.
std::string problemOf(const Box3& range, const std::vector<int>& axes = { 0, 1 })
{
  try
  {
    tipp::requireSensible(range, points, axes);
  }
  catch (const std::runtime_error& error)
  {
    return error.what();
  }
  return "";
}

TEST(SensibleRange, MayBePartOrTenTimesAsLong)
{
  EXPECT_EQ("", problemOf({ { 2, 101, 0 }, { 3, 102, 0 } }));
  EXPECT_EQ("", problemOf({ { 10, 120, 0 }, { 10, 120, 0 } }));
  EXPECT_EQ("", problemOf({ { -50, 0, 0 }, { 50, 200, 0 } }));
}

TEST(SensibleRange, OutsideOfThePointsIsRefusedWithBothBoxes)
{
  EXPECT_EQ("the bounds, x from 20 to 30 and y from 100 to 120, do not meet those of the points, "
            "x from 0 to 10 and y from 100 to 120; give bounds in the order xmin xmax ymin ymax.",
    problemOf({ { 20, 100, 0 }, { 30, 120, 0 } }));
}

TEST(SensibleRange, InTheOrderOfGdalIsRefusedWithTheAxis)
{
  EXPECT_NE(std::string::npos,
    problemOf({ { 0, 10, 0 }, { 101, 120, 0 } }).find("more than ten times as long along x"));
}

TEST(SensibleRange, ZCountsInSpaceOnly)
{
  const Box3 below{ { 0, 100, 0 }, { 10, 120, 1 } };
  EXPECT_EQ("", problemOf(below));
  EXPECT_NE(std::string::npos, problemOf(below, { 0, 1, 2 }).find("ymin ymax zmin zmax."));
}

TEST(SensibleRange, MayBeInfinite)
{
  EXPECT_EQ("", problemOf({ { -HUGE_VAL, -HUGE_VAL, 0 }, { HUGE_VAL, HUGE_VAL, 0 } }));
  EXPECT_NE("", problemOf({ { 11, -HUGE_VAL, 0 }, { HUGE_VAL, HUGE_VAL, 0 } }));
}

TEST(SensibleRange, MayBeAnyLengthAlongAnAxisThatPointsDoNotExtendAlong)
{
  EXPECT_NO_THROW(
    tipp::requireSensible({ { -1, -9, 0 }, { 11, 9, 0 } }, { { 0, 0, 0 }, { 10, 0, 0 } }));
}

TEST(SensibleRange, LeavesEmptyRangesToCallers)
{
  EXPECT_EQ("", problemOf({ { 1, 101, 0 }, { 0, 102, 0 } }));
  EXPECT_EQ("", problemOf({ { NAN, 101, 0 }, { 1, 102, 0 } }));
}

} // namespace
