// SPDX-License-Identifier: BSD-3-Clause
#include "Points/ReadPoints.h"

#include "ExpectIOError.h"
#include "TemporaryFolder.h"

#include <cmath>

namespace
{

using namespace tipp;
using namespace tipp::test;

TEST(TextRows, DistinguishNumbersMissingValuesAndText)
{
  const TemporaryFolder folder;
  const PointTable table =
    readPoints(folder.file("points.csv", "name,y,x,q\nbuoy,2,1,3.5\n7,4,3,N/A\n"));
  EXPECT_EQ((std::vector<double>{ 1, 2, 3, 4 }), table.XY);
  ASSERT_EQ(1U, table.Columns.size());
  EXPECT_EQ("q", table.Columns[0].Name);
  EXPECT_EQ(3.5, table.Columns[0].Values[0]);
  EXPECT_TRUE(std::isnan(table.Columns[0].Values[1]));
}

TEST(TextRows, OfOtherWidthAreReportedWithTheirLine)
{
  const TemporaryFolder folder;
  const std::string path = folder.file("points.csv", "# begin\n1,2\n\n3,4,5\n");
  expectIOError(path, "line 4: has 3 columns", [&] { readPoints(path); });
}

} // namespace
