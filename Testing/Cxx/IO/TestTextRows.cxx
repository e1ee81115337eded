// SPDX-License-Identifier: BSD-3-Clause
#include "Points/FilePoints.h"

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
  TextRows rows(folder.file("points.csv", "name,y,x,h\nbuoy,2,1,3.5\n7,4,3,N/A\n"), {});
  ASSERT_EQ(2U, rows.further().size());
  const TextRows::Column name = rows.further()[0];
  const TextRows::Column height = rows.further()[1];
  EXPECT_EQ("h", height.Name);
  EXPECT_EQ(4U, rows.width());
  double value = 0;
  ASSERT_TRUE(rows.next());
  EXPECT_EQ(1, rows.x());
  EXPECT_EQ(2, rows.y());
  EXPECT_EQ(TextRows::Value::Text, rows.value(name, value));
  EXPECT_EQ(TextRows::Value::Number, rows.value(height, value));
  EXPECT_EQ(3.5, value);
  ASSERT_TRUE(rows.next());
  EXPECT_EQ(3, rows.x());
  EXPECT_EQ(TextRows::Value::Number, rows.value(name, value));
  EXPECT_EQ(TextRows::Value::Missing, rows.value(height, value));
  EXPECT_TRUE(std::isnan(value));
  EXPECT_FALSE(rows.next());
}

TEST(TextRows, OfOtherWidthAreReportedWithTheirLine)
{
  const TemporaryFolder folder;
  const std::string path = folder.file("points.csv", "# begin\n1,2\n\n3,4,5\n");
  TextRows rows(path, {});
  EXPECT_TRUE(rows.next());
  expectIOError(path, "line 4: has 3 columns", [&] { rows.next(); });
}

} // namespace
