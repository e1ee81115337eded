// SPDX-License-Identifier: BSD-3-Clause
#include "QueryTesting.h"

#include "Files/IOError.h"
#include "Query/RankAnswer.h"
#include "Ranks/Communicator.h"

#include "vtkMultiProcessController.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <memory>

using namespace tipp;
using namespace tipp::test;

namespace
{

/// Every rank asks its own share of the points, the last rank none.
class QueryRanks : public testing::Test
{
protected:
  QueryRanks()
    : Ranks(vtkMultiProcessController::GetGlobalController())
  {
    std::string path;
    if (this->Ranks.isFirst())
    {
      this->Folder = std::make_unique<TemporaryFolder>();
      path = this->Folder->path("mesh.tipp");
    }
    this->Path = this->Ranks.broadcast(path);
  }
  ~QueryRanks() override { this->Ranks.barrier(); }

  bool isLast() const
  {
    return this->Ranks.size() > 1 && this->Ranks.rank() == this->Ranks.size() - 1;
  }

  std::vector<Point3> ownOf(const std::vector<Point3>& points) const
  {
    std::vector<Point3> own;
    const auto asking = std::size_t(std::max(1, this->Ranks.size() - 1));
    for (std::size_t i = std::size_t(this->Ranks.rank()); i < points.size() && !this->isLast();
         i += asking)
    {
      own.push_back(points[i]);
    }
    return own;
  }

  void store(const SourceMesh& source, const std::string& tiling)
  {
    if (this->Ranks.isFirst())
    {
      test::store(source, this->Path, tiling, false);
    }
    this->Ranks.barrier();
  }

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

  Communicator Ranks;
  std::unique_ptr<TemporaryFolder> Folder;
  std::string Path;
};

TEST_F(QueryRanks, ShareThePiecesOfAStoredMesh)
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

TEST_F(QueryRanks, ShareTetrahedraOnDisk)
{
  const SourceMesh source = makeSource(latticeTetrahedra(5, 0.3));
  this->store(source, "grid:2x2x2");
  this->expectAsAlone(ResidentMesh(this->Path), source);
}

TEST_F(QueryRanks, CellsInTheMemoryOfAllRanksAnswerAsOneMesh)
{
  for (const SourceMesh& source :
    { makeSource(latticeTriangles(16, 0)), makeSource(latticeTetrahedra(4, 0.3)) })
  {
    this->expectAsAlone(
      ResidentMesh(inMemory(source, 0, this->Ranks.rank(), this->Ranks.size())), source);
  }
}

TEST_F(QueryRanks, ARankMayHaveNoCells)
{
  const SourceMesh source = makeSource(latticeTriangles(16, 0.3));
  const int holders = std::max(1, this->Ranks.size() - 1);
  this->expectAsAlone(
    ResidentMesh(this->isLast() ? MeshPart() : inMemory(source, 0, this->Ranks.rank(), holders)),
    source);
}

TEST_F(QueryRanks, CellsWithoutIdsAreNumberedRankByRank)
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

TEST_F(QueryRanks, AFailureOfOneRankEndsAll)
{
  const SourceMesh source = makeSource(latticeTriangles(12, 0.3));
  this->store(source, "grid:4x4");
  const ResidentMesh mesh(this->Path);
  this->Ranks.barrier();
  if (this->Ranks.isFirst()) // the last piece is the last rank's
  {
    const std::string piece = mesh.mesh().piecePath(15);
    std::string content = contentOf(piece);
    content[content.size() / 2] = char(content[content.size() / 2] ^ 1);
    std::ofstream(piece, std::ios::binary) << content;
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
