// SPDX-License-Identifier: BSD-3-Clause
#include "ScheduleTesting.h"

#include "Triangulation/Dataflow.h"
#include "Triangulation/TriangleSink.h"

#include <algorithm>
#include <random>
#include <tuple>
#include <utility>

namespace
{

using namespace tipp;
using namespace tipp::test;

/// The final triangles in two lists, as from two threads.
template <typename Id>
std::vector<std::vector<typename TriangleSink<Id>::FinalTriangle>> finalOnes(
  const std::vector<BoundaryTriangle>& triangles)
{
  FinalBoundary<Id> final[2];
  for (std::size_t i = 0; i < triangles.size(); ++i)
  {
    final[i % 2].add(triangles[i]);
  }
  return { final[0].Triangles, final[1].Triangles };
}

/// Four partitions with 5, 0, 3 and 4 points.
template <typename Id>
struct SinkRun
{
  SinkRun()
    : Buckets(std::vector<std::size_t>{ 0, 5, 5, 8, 12 })
    , Sink(this->Buckets)
  {
  }

  /// Writes artificial triangles to a partition's buffer, as a worker writes its interior ones.
  void writeInterior(PartitionIndex p, std::size_t count)
  {
    for (std::size_t i = 0; i < count; ++i)
    {
      const Id first = Id(1000 * (p + 1) + 10 * PartitionIndex(i));
      const Id corners[] = { first, first + 2, first + 1 };
      std::copy(corners, corners + 3, this->Buckets.triangles(p) + 3 * i);
      this->Expected.push_back(canonical(first, first + 2, first + 1));
    }
    this->Sink.setInteriorCount(p, count);
  }

  /// Artificial triangles whose lowest vertices are spread over all partitions with points.
  std::vector<BoundaryTriangle> boundary(std::size_t count)
  {
    std::vector<BoundaryTriangle> triangles;
    const PartitionIndex partitions[] = { 0, 2, 3 };
    for (std::size_t i = 0; i < count; ++i)
    {
      const std::int64_t id = 10 * std::int64_t(count - i);
      triangles.push_back(boundaryTriangle(id, partitions[i % 3], partitions[i % 2], 0));
      this->Expected.push_back(canonical(id, id + 1, id + 2));
    }
    return triangles;
  }

  void expectAll(const Buffer<Id>& ids)
  {
    ASSERT_EQ(3 * this->Expected.size(), ids.size());
    Triangles found;
    for (std::size_t i = 0; i < ids.size(); i += 3)
    {
      found.push_back(canonical(ids[i], ids[i + 1], ids[i + 2]));
    }
    EXPECT_EQ(sorted(this->Expected), sorted(found));
  }

  PointBuckets<Id> Buckets;
  TriangleSink<Id> Sink;
  Triangles Expected;
};

/// Tests for both sizes of ids.
template <typename Id>
class SinkOf
  : public testing::Test
  , public SinkRun<Id>
{
};

TYPED_TEST_SUITE(SinkOf, IdTypes, IdNames);

TEST(LongTriangles, AreFoundAtAnyMagnitude)
{
  for (const double unit : { 1e-300, 1.0, 1e300 })
  {
    const Point2 a{ 0, 0 };
    const Point2 b{ 3 * unit, 0 };
    const Point2 c{ 0, 4 * unit };
    EXPECT_FALSE(hasLongEdge(a, b, c, 5.001 * unit)) << unit;
    EXPECT_TRUE(hasLongEdge(a, b, c, 4.999 * unit)) << unit;
  }
}

TYPED_TEST(SinkOf, HasAllInteriorAndBoundaryTriangles)
{
  // Each partition's buffer holds two triangles per point: 10, 0, 6 and 8.
  for (const std::size_t boundaryCount : { 0, 1, 2, 5, 9, 13 })
  {
    for (const auto& [first, third, last] : { std::tuple{ 0, 0, 0 }, { 3, 2, 5 }, { 10, 0, 0 },
           { 0, 6, 0 }, { 0, 0, 8 }, { 1, 6, 3 }, { 2, 1, 8 } })
    {
      SinkRun<TypeParam> run;
      run.writeInterior(0, std::size_t(first));
      run.writeInterior(2, std::size_t(third));
      run.writeInterior(3, std::size_t(last));
      run.expectAll(run.Sink.assemble(finalOnes<TypeParam>(run.boundary(boundaryCount)), 2));
    }
  }
}

TYPED_TEST(SinkOf, ThereIsSpaceForTwoTrianglesPerPoint)
{
  this->writeInterior(0, 10);
  this->writeInterior(2, 4);
  this->writeInterior(3, 3);
  this->expectAll(this->Sink.assemble(finalOnes<TypeParam>(this->boundary(7)), 1));
}

TYPED_TEST(SinkOf, WithoutTrianglesTheResultIsEmpty)
{
  EXPECT_TRUE(this->Sink.assemble({}, 1).empty());
}

TYPED_TEST(SinkOf, InteriorTrianglesStayWhereTheyAre)
{
  this->writeInterior(0, 4);
  const std::vector<TypeParam> before(this->Buckets.triangles(0), this->Buckets.triangles(0) + 12);
  const Buffer<TypeParam> ids = this->Sink.assemble(finalOnes<TypeParam>(this->boundary(5)), 1);
  EXPECT_EQ(before, std::vector<TypeParam>(ids.begin(), ids.begin() + 12));
}

/// Workers may add their triangles in any order.
TYPED_TEST(SinkOf, TheOrderDoesNotDependOnTheOrderOfBoundaryTriangles)
{
  std::mt19937_64 random(2);
  std::vector<TypeParam> expected;
  for (int draw = 0; draw < 20; ++draw)
  {
    SinkRun<TypeParam> run;
    run.writeInterior(0, 3);
    run.writeInterior(2, 5);
    run.writeInterior(3, 1);
    std::vector<BoundaryTriangle> boundary = run.boundary(9);
    if (draw > 0)
    {
      std::shuffle(boundary.begin(), boundary.end(), random);
    }
    for (BoundaryTriangle& t : boundary)
    {
      // The same triangle, starting at another corner.
      std::rotate(t.begin(), t.begin() + draw % 3, t.end());
    }
    const Buffer<TypeParam> ids = run.Sink.assemble(finalOnes<TypeParam>(boundary), 1 + draw % 3);
    const std::vector<TypeParam> now(ids.begin(), ids.end());
    expected = draw == 0 ? now : expected;
    ASSERT_EQ(expected, now);
  }
}

TYPED_TEST(SinkOf, BoundaryStaysCounterClockwise)
{
  const BoundaryTriangle t = { BoundaryVertex{ {}, 9, 0 }, BoundaryVertex{ {}, 4, 2 },
    BoundaryVertex{ {}, 7, 3 } };
  const Buffer<TypeParam> ids = this->Sink.assemble(finalOnes<TypeParam>({ t }), 1);
  EXPECT_EQ((std::vector<TypeParam>{ 4, 7, 9 }), std::vector<TypeParam>(ids.begin(), ids.end()));
}

template <typename Id>
Buffer<Id> bufferOf(const std::vector<Id>& ids)
{
  Buffer<Id> buffer(ids.size());
  std::copy(ids.begin(), ids.end(), buffer.begin());
  return buffer;
}

using Pairs = std::vector<std::pair<PointId, PointId>>;

Pairs pairsOf(const std::vector<Duplicate>& duplicates)
{
  Pairs pairs;
  for (const Duplicate& duplicate : duplicates)
  {
    pairs.emplace_back(duplicate.Point, duplicate.Representative);
  }
  return pairs;
}

TYPED_TEST(SinkOf, ALowerDuplicateReplacesItsRepresentative)
{
  Buffer<TypeParam> ids = bufferOf<TypeParam>({ 1, 5, 9, 5, 7, 9 });
  std::vector<Duplicate> duplicates{ { 3, 5 } };
  preferLowestIds(ids, duplicates, 2);
  EXPECT_EQ(
    (std::vector<TypeParam>{ 1, 3, 9, 3, 7, 9 }), std::vector<TypeParam>(ids.begin(), ids.end()));
  EXPECT_EQ((Pairs{ { 5, 3 } }), pairsOf(duplicates));
}

TYPED_TEST(SinkOf, TheLowestOfSeveralDuplicatesRepresentsAll)
{
  Buffer<TypeParam> ids = bufferOf<TypeParam>({ 8, 0, 1 });
  std::vector<Duplicate> duplicates{ { 6, 8 }, { 12, 8 }, { 2, 8 }, { 4, 8 } };
  preferLowestIds(ids, duplicates, 1);
  EXPECT_EQ(2, ids[0]);
  EXPECT_EQ((Pairs{ { 4, 2 }, { 6, 2 }, { 8, 2 }, { 12, 2 } }), pairsOf(duplicates));
}

TYPED_TEST(SinkOf, HigherDuplicatesChangeNothing)
{
  Buffer<TypeParam> ids = bufferOf<TypeParam>({ 0, 1, 2 });
  std::vector<Duplicate> duplicates{ { 9, 1 }, { 4, 2 } };
  preferLowestIds(ids, duplicates, 1);
  EXPECT_EQ((std::vector<TypeParam>{ 0, 1, 2 }), std::vector<TypeParam>(ids.begin(), ids.end()));
  EXPECT_EQ((Pairs{ { 4, 2 }, { 9, 1 } }), pairsOf(duplicates));
}

TYPED_TEST(SinkOf, DuplicatesOfDifferentPointsAreIndependent)
{
  Buffer<TypeParam> ids = bufferOf<TypeParam>({ 5, 6, 7 });
  std::vector<Duplicate> duplicates{ { 1, 6 }, { 2, 5 }, { 9, 5 }, { 8, 6 } };
  preferLowestIds(ids, duplicates, 1);
  EXPECT_EQ((std::vector<TypeParam>{ 2, 1, 7 }), std::vector<TypeParam>(ids.begin(), ids.end()));
  EXPECT_EQ((Pairs{ { 5, 2 }, { 6, 1 }, { 8, 1 }, { 9, 2 } }), pairsOf(duplicates));
}

/// Ids are looked up in a table by their low 14 bits, which are equal here.
TYPED_TEST(SinkOf, IdsWithEqualLowBitsAreDistinguished)
{
  const TypeParam apart = 1 << 14;
  Buffer<TypeParam> ids = bufferOf<TypeParam>({ 7, 7 + apart, 7 + 2 * apart });
  std::vector<Duplicate> duplicates{ { 3, 7 + apart } };
  preferLowestIds(ids, duplicates, 1);
  EXPECT_EQ((std::vector<TypeParam>{ 7, 3, 7 + 2 * apart }),
    std::vector<TypeParam>(ids.begin(), ids.end()));
}

} // namespace
