// SPDX-License-Identifier: BSD-3-Clause
#include "QueryRanksTesting.h"

#include "DamagePiece.h"
#include "Query/Queries.h"
#include "Query/RankAnswer.h"

#include <algorithm>

using namespace tipp;
using namespace tipp::test;

namespace
{

class AnswersOnRanks : public QueryRanksTest
{
protected:
  void expectAsAlone(const ResidentMesh& mesh, const SourceMesh& source)
  {
    const std::vector<Point3> points = this->ownOf(pointsAround(source, 400));
    const ResidentMesh whole(inMemory(source));
    AnswerOptions options;
    options.Arrays = { "value", "label" };
    options.Weights = true;
    MeshAnswer answer;
    this->Ranks.together(
      [&]
      {
        answer =
          answerOnRanks(this->Ranks, mesh, points.data(), std::int64_t(points.size()), options);
      });
    expectEqual(whole.answer(points.data(), std::int64_t(points.size()), options), answer);
  }
};

TEST_F(AnswersOnRanks, ShareThePiecesOfAStoredMesh)
{
  const SourceMesh source = makeSource(latticeTriangles(20, 0));
  this->store(source, "grid:4x3");
  const ResidentMesh mesh(this->Path);
  this->expectAsAlone(mesh, source);
  if (this->Ranks.size() > 1)
  {
    EXPECT_GT(12, mesh.pieces().loads());
  }
}

TEST_F(AnswersOnRanks, ShareTetrahedraOnDisk)
{
  const SourceMesh source = makeSource(latticeTetrahedra(5, 0.3));
  this->store(source, "grid:2x2x2");
  this->expectAsAlone(ResidentMesh(this->Path), source);
}

TEST_F(AnswersOnRanks, CellsInTheMemoryOfAllRanksAnswerAsOneMesh)
{
  for (const SourceMesh& source :
    { makeSource(latticeTriangles(16, 0)), makeSource(latticeTetrahedra(4, 0.3)) })
  {
    this->expectAsAlone(
      ResidentMesh(inMemory(source, 0, this->Ranks.rank(), this->Ranks.size())), source);
  }
}

TEST_F(AnswersOnRanks, ARankMayHaveNoCells)
{
  const SourceMesh source = makeSource(latticeTriangles(16, 0.3));
  const int holders = std::max(1, this->Ranks.size() - 1);
  this->expectAsAlone(
    ResidentMesh(this->isLast() ? MeshPart() : inMemory(source, 0, this->Ranks.rank(), holders)),
    source);
}

TEST_F(AnswersOnRanks, CellsWithoutIdsAreNumberedRankByRank)
{
  const SourceMesh source = makeSource(latticeTriangles(8, 0.3));
  MeshPart part = inMemory(source, 0, this->Ranks.rank(), this->Ranks.size());
  const std::int64_t* const ids = part.CellIds;
  std::vector<std::int64_t> mine(ids, ids + (ids ? part.OwnedCells : 0));
  std::vector<std::int64_t> all;
  for (const std::vector<std::int64_t>& list : this->Ranks.allGather(mine))
  {
    all.insert(all.end(), list.begin(), list.end());
  }
  part.CellIds = nullptr;
  const ResidentMesh mesh(part);
  const ResidentMesh whole(inMemory(source));
  const std::vector<Point3> points = this->ownOf(pointsAround(source, 100));
  const auto count = std::int64_t(points.size());
  MeshAnswer answer;
  this->Ranks.together([&] { answer = answerOnRanks(this->Ranks, mesh, points.data(), count); });
  const MeshAnswer expected = whole.answer(points.data(), count);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const std::int64_t cell = answer.Cells[i];
    EXPECT_EQ(expected.Cells[i], cell < 0 || all.empty() ? cell : all[std::size_t(cell)]);
  }
}

TEST_F(AnswersOnRanks, AnswersMayStayWhereTheCellsAre)
{
  const SourceMesh source = makeSource(latticeTriangles(16, 0)); // points lie on common edges
  const std::vector<Point3> all = pointsAround(source, 200);
  const std::vector<Point3> own = this->ownOf(all);
  const ResidentMesh whole(inMemory(source));
  this->store(source, "grid:4x3");
  AnswerOptions options;
  options.Arrays = { "value", "label" };
  options.Weights = true;
  const auto expectAsAlone = [&](const ResidentMesh& mesh)
  {
    StayingAnswer found;
    this->Ranks.together(
      [&]
      {
        found =
          answerWhereCellsAre(this->Ranks, mesh, own.data(), std::int64_t(own.size()), options);
        std::vector<std::int64_t> count = { std::int64_t(found.Points.size()) };
        this->Ranks.sum(count);
        const std::vector<std::int64_t> cells =
          whole.answer(all.data(), std::int64_t(all.size())).Cells;
        EXPECT_EQ(
          std::count_if(cells.begin(), cells.end(), [](auto cell) { return cell >= 0; }), count[0]);
      });
    expectEqual(
      whole.answer(found.Points.data(), std::int64_t(found.Points.size()), options), found.Answer);
    const auto asking = std::size_t(std::max(1, this->Ranks.size() - 1));
    for (std::size_t i = 0; i < found.Points.size(); ++i)
    {
      const std::size_t index =
        std::size_t(found.Ranks[i]) + asking * std::size_t(found.Indices[i]);
      EXPECT_EQ(all[index], found.Points[i]);
    }
  };
  expectAsAlone(ResidentMesh(this->Path));
  expectAsAlone(ResidentMesh(inMemory(source, 0, this->Ranks.rank(), this->Ranks.size())));
}

TEST_F(AnswersOnRanks, FindTheNearestCellOfAllRanks)
{
  const int holders = std::max(1, this->Ranks.size() - 1);
  for (const SourceMesh& source : { makeSource(latticeTriangles(8, 0.3)),
         makeSource(latticeTriangles(8, 0)), makeSource(latticeTetrahedra(3, 0.3)) })
  {
    const ResidentMesh whole(inMemory(source));
    const std::vector<Point3> points = this->ownOf(pointsAround(source, 60));
    const auto count = std::int64_t(points.size());
    const ClosestLocations expected = closestTo(whole, points.data(), count);
    const auto expectAsAlone = [&](const ResidentMesh& mesh)
    {
      ClosestLocations found;
      this->Ranks.together([&] { found = closestTo(mesh, points.data(), count, &this->Ranks); });
      EXPECT_EQ(expected.Cells, found.Cells);
      EXPECT_EQ(expected.Distances, found.Distances);
      EXPECT_EQ(expected.Points, found.Points);
    };
    this->store(source, source.CellSize == 3 ? "grid:3x3" : "grid:2x2x2");
    expectAsAlone(ResidentMesh(this->Path));
    expectAsAlone(ResidentMesh(inMemory(source, 0, this->Ranks.rank(), this->Ranks.size())));
    expectAsAlone(
      ResidentMesh(this->isLast() ? MeshPart() : inMemory(source, 0, this->Ranks.rank(), holders)));
  }
}

TEST_F(AnswersOnRanks, AFailureOfOneRankEndsAll)
{
  const SourceMesh source = makeSource(latticeTriangles(12, 0.3));
  this->store(source, "grid:4x4");
  const ResidentMesh mesh(this->Path);
  this->Ranks.barrier();
  if (this->Ranks.isFirst()) // damages the last piece, which belongs to the last rank
  {
    damagePiece(mesh.mesh().piecePath(15), "connectivity");
  }
  this->Ranks.barrier();
  const std::vector<Point3> points = this->ownOf(pointsAround(source, 100));
  try
  {
    this->Ranks.together(
      [&] { answerOnRanks(this->Ranks, mesh, points.data(), std::int64_t(points.size())); });
    ADD_FAILURE() << "the damage was not noticed";
  }
  catch (const RankFailure& failure)
  {
    EXPECT_NE(std::string::npos, std::string(failure.what()).find("000015.vtu")) << failure.what();
    EXPECT_EQ(this->Ranks.size() - 1, failure.Rank);
  }
}

} // namespace
