// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioned/GrowingPiece.h"

#include <gtest/gtest.h>

using tipp::SharingSets;
using Set = std::vector<std::int32_t>;

namespace
{

TEST(SharingSets, HaveOneNumberEach)
{
  SharingSets sets;
  const int a = sets.number({ 1, 4 });
  const int b = sets.number({ 2 });
  EXPECT_NE(a, b);
  EXPECT_EQ(a, sets.number({ 1, 4 }));
  EXPECT_EQ((Set{ 1, 4 }), sets.set(a));
}

TEST(SharingSets, AreUnchangedByAUnionWithTheEmptySet)
{
  SharingSets sets;
  const int a = sets.number({ 1, 4 });
  EXPECT_EQ(a, sets.unite(a, -1));
  EXPECT_EQ(a, sets.unite(-1, a));
  EXPECT_EQ(-1, sets.unite(-1, -1));
}

TEST(SharingSets, UniteToAscendingSets)
{
  SharingSets sets;
  const int a = sets.number({ 1, 4 });
  const int b = sets.number({ 2, 4 });
  const int both = sets.unite(a, b);
  EXPECT_EQ((Set{ 1, 2, 4 }), sets.set(both));
  EXPECT_EQ(both, sets.unite(b, a));
}

TEST(SharingSets, AreGroupedInLexicographicOrder)
{
  SharingSets sets;
  const int last = sets.number({ 7 });
  const int unused = sets.number({ 3 });
  const int first = sets.number({ 1, 9 });
  std::vector<tipp::SharedGroup> groups;
  const std::vector<int> indexOf = sets.groups({ last, -1, first, last }, groups);
  ASSERT_EQ(2U, groups.size());
  EXPECT_EQ((Set{ 1, 9 }), groups[0].Borrowers);
  EXPECT_EQ(1, groups[0].Count);
  EXPECT_EQ((Set{ 7 }), groups[1].Borrowers);
  EXPECT_EQ(2, groups[1].Count);
  EXPECT_EQ(0, indexOf[std::size_t(first)]);
  EXPECT_EQ(1, indexOf[std::size_t(last)]);
  EXPECT_EQ(-1, indexOf[std::size_t(unused)]);
}

} // namespace
