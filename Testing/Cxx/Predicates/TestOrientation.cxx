// SPDX-License-Identifier: BSD-3-Clause
#include "Predicates/Orientation.h"

#include <gtest/gtest.h>

#include <cmath>

TEST(Orientation, UlpBesideALineIsSeen)
{
  const tipp::Point2 b{ 12, 12 };
  const tipp::Point2 c{ 24, 24 };
  EXPECT_EQ(0, tipp::orientation({ 0.5, 0.5 }, b, c));
  EXPECT_EQ(-1, tipp::orientation({ std::nextafter(0.5, 1), 0.5 }, b, c));
}
