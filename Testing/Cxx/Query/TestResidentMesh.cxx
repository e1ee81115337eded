// SPDX-License-Identifier: BSD-3-Clause
#include "QueryTesting.h"

#include "DamagePiece.h"
#include "ExpectIOError.h"
#include "Files/IOError.h"
#include "Query/Queries.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <thread>

using namespace tipp;
using namespace tipp::test;

namespace
{

AnswerOptions everything(const ResidentMesh& mesh)
{
  AnswerOptions options;
  options.Arrays = mesh.names();
  options.Weights = true;
  return options;
}

MeshAnswer answerOf(const ResidentMesh& mesh, const std::vector<Point3>& points)
{
  return mesh.answer(points.data(), std::int64_t(points.size()), everything(mesh));
}

struct Case
{
  const char* Tiling;
  bool Duplicate;
};

class ResidentMeshTest : public testing::Test
{
protected:
  std::string path() const { return this->Folder.path("mesh.tipp"); }

  void expectAsInMemory(const SourceMesh& source, const std::vector<Case>& cases)
  {
    const std::vector<Point3> points = pointsAround(source, 500);
    const ResidentMesh whole(inMemory(source));
    const MeshAnswer expected = answerOf(whole, points);
    EXPECT_LT(0, std::count(expected.Cells.begin(), expected.Cells.end(), -1));
    for (const Case& c : cases)
    {
      SCOPED_TRACE(c.Tiling);
      store(source, this->path(), c.Tiling, c.Duplicate);
      for (const int threads : { 1, 3 })
      {
        ResidentOptions options;
        options.Threads = threads;
        const ResidentMesh mesh(this->path(), options);
        expectEqual(expected, answerOf(mesh, points));
        expectEqual(expected, answerOf(mesh, points)); // the second answer comes from memory
      }
    }
  }

  TemporaryFolder Folder;
};

} // namespace

TEST_F(ResidentMeshTest, StoredTrianglesAnswerAsTheWholeMeshInMemory)
{
  this->expectAsInMemory(makeSource(latticeTriangles(20, 0.3)),
    { { "grid:1x1", false }, { "grid:4x4", true }, { "quadtree:60", false } });
}

TEST_F(ResidentMeshTest, RegularTrianglesWhosePointsLieOnPieceBorders)
{
  this->expectAsInMemory(
    makeSource(latticeTriangles(16, 0)), { { "grid:4x4", false }, { "grid:3x5", true } });
}

TEST_F(ResidentMeshTest, StoredTetrahedraAnswerAsTheWholeMeshInMemory)
{
  this->expectAsInMemory(
    makeSource(latticeTetrahedra(5, 0.3)), { { "grid:2x2x2", false }, { "octree:100", true } });
  this->expectAsInMemory(makeSource(latticeTetrahedra(4, 0)), { { "grid:2x2x2", false } });
}

TEST_F(ResidentMeshTest, ArraysAreInterpolatedByTheWeights)
{
  const SourceMesh source = makeSource(latticeTriangles(12, 0.3));
  const std::vector<Point3> points = pointsAround(source, 300);
  const ResidentMesh mesh(inMemory(source));
  const MeshAnswer answer = answerOf(mesh, points);
  ASSERT_EQ("elevation", answer.Arrays[0].Name);
  ASSERT_EQ("value", answer.Arrays[1].Name);
  ASSERT_EQ("label", answer.Arrays[2].Name);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const float* value = answer.Arrays[1].Values.as<float>() + 2 * i;
    if (answer.Cells[i] < 0)
    {
      EXPECT_TRUE(std::isnan(value[0]) && std::isnan(value[1]));
      EXPECT_EQ(0, answer.Arrays[2].Values.as<std::int16_t>()[i]);
      continue;
    }
    const auto cell = std::size_t(answer.Cells[i]);
    double expected = 0;
    double x = 0;
    for (std::size_t k = 0; k < 3; ++k)
    {
      const auto corner = std::size_t(source.Cells[3 * cell + k]);
      expected += answer.Weights[3 * i + k] * double(source.Values[2 * corner + 1]);
      x += answer.Weights[3 * i + k] * source.Coordinates[2 * corner];
    }
    EXPECT_NEAR(points[i].x, x, 1e-12);
    EXPECT_NEAR(expected, double(value[1]), 1e-2);
    EXPECT_EQ(source.Labels[cell], answer.Arrays[2].Values.as<std::int16_t>()[i]);
  }
}

TEST_F(ResidentMeshTest, AnswersDoNotDependOnTheOrderOfQueries)
{
  const SourceMesh source = makeSource(latticeTriangles(16, 0));
  store(source, this->path(), "grid:3x3", false);
  std::vector<Point3> points = pointsAround(source, 200);
  const ResidentMesh mesh(this->path());
  const MeshAnswer expected = answerOf(mesh, points);
  for (std::size_t i = 0; i < points.size(); i += 5) // one query per point
  {
    EXPECT_EQ(expected.Cells[i], mesh.answer(&points[i], 1).Cells[0]);
  }
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::shuffle(order.begin(), order.end(), std::mt19937(3));
  std::vector<Point3> shuffled;
  for (const std::size_t i : order)
  {
    shuffled.push_back(points[i]);
  }
  const MeshAnswer answer = answerOf(mesh, shuffled);
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    EXPECT_EQ(expected.Cells[order[i]], answer.Cells[i]);
  }
}

TEST_F(ResidentMeshTest, PiecesStayInMemoryWithinTheLimit)
{
  const SourceMesh source = makeSource(latticeTriangles(40, 0.3));
  store(source, this->path(), "grid:8x8", false);
  const std::vector<Point3> points = pointsAround(source, 500);
  const ResidentMesh free(this->path());
  const MeshAnswer expected = answerOf(free, points);
  EXPECT_EQ(64, free.pieces().loads());
  answerOf(free, points);
  EXPECT_EQ(64, free.pieces().loads());
  for (const std::uint64_t share : { 4, 16 })
  {
    ResidentOptions options;
    options.MemoryLimit = free.pieces().bytes() / share;
    options.Threads = 4;
    const ResidentMesh mesh(this->path(), options);
    expectEqual(expected, answerOf(mesh, points));
    expectEqual(expected, answerOf(mesh, points));
    EXPECT_LT(64, mesh.pieces().loads());
    EXPECT_LE(mesh.pieces().bytes(), options.MemoryLimit);
  }
}

TEST_F(ResidentMeshTest, WorksWithoutLocatorsThatExceedTheLimit)
{
  const SourceMesh source = makeSource(latticeTriangles(20, 0.3));
  store(source, this->path(), "grid:1x1", false);
  const std::vector<Point3> points = pointsAround(source, 500);
  const ResidentMesh free(this->path());
  const MeshAnswer expected = answerOf(free, points);
  closestTo(free, points.data(), std::int64_t(points.size())); // this makes a locator
  ResidentOptions options;
  options.MemoryLimit = free.pieces().bytes() - 1;
  const ResidentMesh mesh(this->path(), options);
  expectEqual(expected, answerOf(mesh, points));
  for (std::size_t i = 0; i < 8; ++i) // so often that a locator would be made
  {
    EXPECT_EQ(expected.Cells[7 * i], mesh.answer(&points[7 * i], 1).Cells[0]);
  }
  EXPECT_EQ(2U, starsOf(mesh, { 0 }).Starts.size()); // loads the piece without its arrays
  EXPECT_LE(mesh.pieces().bytes(), options.MemoryLimit);
  expectEqual(expected, answerOf(mesh, points));
}

TEST_F(ResidentMeshTest, RefusesALimitThatOnePieceExceeds)
{
  const SourceMesh source = makeSource(latticeTriangles(20, 0.3));
  store(source, this->path(), "grid:2x2", false);
  ResidentOptions options;
  options.MemoryLimit = 1000;
  const ResidentMesh mesh(this->path(), options);
  const std::vector<Point3> points = pointsAround(source, 10);
  expectIOError(this->path(),
    "but the limit is 1000 bytes; raise it, or partition the mesh into smaller pieces.",
    [&] { answerOf(mesh, points); });
  EXPECT_EQ(0U, mesh.pieces().bytes());
}

TEST_F(ResidentMeshTest, ThreadsShareOneMeshInLittleMemory)
{
  const SourceMesh source = makeSource(latticeTriangles(24, 0.3));
  store(source, this->path(), "grid:5x5", false);
  const std::vector<Point3> points = pointsAround(source, 300);
  const ResidentMesh whole(inMemory(source));
  const MeshAnswer expected = answerOf(whole, points);
  ResidentOptions options;
  options.MemoryLimit = 40000;
  options.Threads = 2;
  const ResidentMesh mesh(this->path(), options);
  std::vector<MeshAnswer> answers(16);
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < answers.size(); ++t)
  {
    threads.emplace_back(
      [&, t]
      {
        for (int i = 0; i < 4; ++i)
        {
          answers[t] = answerOf(mesh, points);
        }
      });
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  for (const MeshAnswer& answer : answers)
  {
    expectEqual(expected, answer);
  }
}

TEST_F(ResidentMeshTest, ReadsOnlyThePiecesThatContainPoints)
{
  store(makeSource(latticeTriangles(20, 0.3)), this->path(), "grid:4x4", true);
  const ResidentMesh mesh(this->path());
  const PieceSummary& piece = mesh.mesh().Pieces[5];
  const Point3 middle = piece.Box.center();
  EXPECT_LE(0, mesh.answer(&middle, 1).Cells[0]);
  EXPECT_EQ(1, mesh.pieces().loads());
  const Point3 outside{ -10, -10, 0 };
  EXPECT_EQ(-1, mesh.answer(&outside, 1).Cells[0]);
  EXPECT_EQ(1, mesh.pieces().loads());
}

TEST_F(ResidentMeshTest, UsesTheTimeStepOfArraysThatVaryInTime)
{
  SourceMesh source = makeSource(latticeTriangles(10, 0.3));
  addSeries(source, 3);
  store(source, this->path(), "grid:2x2", false);
  const std::vector<Point3> points = pointsAround(source, 50);
  for (const int step : { 0, 2 })
  {
    ResidentOptions options;
    options.Step = step;
    const ResidentMesh whole(inMemory(source, step), options);
    const ResidentMesh mesh(this->path(), options);
    AnswerOptions level;
    level.Arrays = { "level" };
    const auto count = std::int64_t(points.size());
    expectEqual(
      whole.answer(points.data(), count, level), mesh.answer(points.data(), count, level));
  }
}

TEST_F(ResidentMeshTest, RefusesArraysThatItDoesNotHave)
{
  store(makeSource(latticeTriangles(4, 0.3)), this->path(), "grid:2x2", false);
  const ResidentMesh mesh(this->path());
  AnswerOptions options;
  options.Arrays = { "depth" };
  const Point3 point{ 0, 0, 0 };
  expectIOError(this->path(), "has no array 'depth'; there are 'elevation', 'label', 'value'",
    [&] { mesh.answer(&point, 1, options); });
}

TEST_F(ResidentMeshTest, NamesADamagedPieceAndAnswersInTheOthers)
{
  const SourceMesh source = makeSource(latticeTriangles(20, 0.3));
  store(source, this->path(), "grid:2x2", true);
  const ResidentMesh mesh(this->path());
  const std::string piece = mesh.mesh().piecePath(3);
  damagePiece(piece, "connectivity");
  const std::vector<Point3> points = { mesh.mesh().Pieces[0].Box.center(), // good
    mesh.mesh().Pieces[3].Box.center() };                                  // damaged
  EXPECT_LE(0, mesh.answer(&points[0], 1).Cells[0]);
  for (int i = 0; i < 2; ++i)
  {
    expectIOError(piece, "", [&] { answerOf(mesh, points); });
  }
  EXPECT_LE(0, mesh.answer(&points[0], 1).Cells[0]);
}

TEST_F(ResidentMeshTest, AcceptsAnEmptyMeshAndNoPoints)
{
  const ResidentMesh empty{ MeshPart() };
  const Point3 point{ 0, 0, 0 };
  EXPECT_EQ(-1, empty.answer(&point, 1).Cells[0]);
  store(makeSource(latticeTriangles(4, 0.3)), this->path(), "grid:2x2", false);
  EXPECT_TRUE(ResidentMesh(this->path()).answer(nullptr, 0).Cells.empty());
}
