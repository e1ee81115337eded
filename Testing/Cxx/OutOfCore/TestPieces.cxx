// SPDX-License-Identifier: BSD-3-Clause
// Pieces: the order of their triangulation, their results, and the parts of these that other ranks
// need.
#include "OutOfCore/DescribeMesh.h"
#include "OutOfCore/OutOfCoreOptions.h"
#include "OutOfCore/RunSetup.h"
#include "OutOfCore/SpilledPoints.h"
#include "OutOfCoreTesting.h"

#include "OutOfCore/FinishPieces.h"
#include "OutOfCore/PieceRun.h"
#include "Partitioned/FinishedPieces.h"

#include <algorithm>
#include <filesystem>
#include <numeric>
#include <optional>
#include <random>
#include <set>

namespace
{

namespace fs = std::filesystem;
using namespace tipp;
using namespace tipp::test;

/// The order of `count` partitions with random conflicts.
PartitionOrder randomOrder(PartitionIndex count, std::mt19937& random)
{
  std::vector<ConflictGraph::Pair> pairs;
  for (PartitionIndex p = 1; p < count; ++p)
  {
    if (random() % 4 > 0)
    {
      pairs.emplace_back(PartitionIndex(random() % std::uint32_t(p)), p);
    }
  }
  ConflictGraph conflicts{ std::size_t(count) };
  conflicts.add(pairs);
  return PartitionOrder(std::vector<char>(std::size_t(count), 1), conflicts);
}

TEST(BorderQueue, ABorderIsReadyOnceAllConflictingPiecesAreDone)
{
  Steps steps(makePointSet("uniform", 4000));
  const PiecePlan plan = steps.plan();
  std::mt19937 random(5);
  for (int trial = 0; trial < 50; ++trial)
  {
    const PartitionOrder order = randomOrder(plan.Partitions.size(), random);
    std::vector<PartitionIndex> pieces(std::size_t(plan.pieces()));
    std::iota(pieces.begin(), pieces.end(), 0);
    std::shuffle(pieces.begin(), pieces.end(), random);
    BorderQueue queue(plan, order);
    std::set<PartitionIndex> done;
    std::set<PartitionIndex> given;
    const auto isReady = [&](PartitionIndex piece)
    {
      bool isReady = done.count(piece) > 0;
      for (PartitionIndex p = 0; p < plan.Partitions.size(); ++p)
      {
        for (const PartitionIndex q : order.conflicts().neighbours(p))
        {
          isReady = isReady &&
            (plan.PieceOf[std::size_t(p)] != piece || done.count(plan.PieceOf[std::size_t(q)]) > 0);
        }
      }
      return isReady;
    };
    for (const PartitionIndex piece : pieces)
    {
      done.insert(piece);
      for (const PartitionIndex ready : queue.setDone(piece))
      {
        ASSERT_TRUE(given.insert(ready).second) << "twice";
      }
      for (PartitionIndex other = 0; other < plan.pieces(); ++other)
      {
        ASSERT_EQ(isReady(other), given.count(other) > 0);
      }
    }
  }
}

TEST(BorderQueue, IsEmptyIfAllPartitionsConflict)
{
  Steps steps(makePointSet("uniform", 4000));
  const PiecePlan plan = steps.plan();
  const PartitionOrder order(
    std::vector<char>(std::size_t(plan.Partitions.size()), 1), std::nullopt);
  BorderQueue queue(plan, order);
  for (PartitionIndex piece = 0; piece < plan.pieces(); ++piece)
  {
    EXPECT_TRUE(queue.setDone(piece).empty());
  }
}

TEST(PieceOrder, TriangulatesOnePieceAfterTheOther)
{
  Steps steps(makePointSet("clustered", 4000));
  PiecePlan plan = steps.plan();
  const SpilledPoints spilled = steps.spill(plan);
  const PieceOrder order(plan, spilled, 1);
  std::vector<PartitionIndex> pieces;
  for (const PartitionIndex p : order.partitions().sequence())
  {
    const PartitionIndex piece = plan.PieceOf[std::size_t(p)];
    if (pieces.empty() || pieces.back() != piece)
    {
      pieces.push_back(piece);
    }
  }
  EXPECT_EQ(order.sequence(), pieces);
}

TEST(PieceOrder, StartsWithPiecesThatDoNotConflict)
{
  Steps steps(makePointSet("uniform", 20000));
  PiecePlan plan = steps.plan();
  const SpilledPoints spilled = steps.spill(plan);
  const PieceOrder order(plan, spilled, 1);
  const std::vector<PartitionIndex> first(
    order.sequence().begin(), order.sequence().begin() + plan.pieces() / 8);
  for (const PartitionIndex p : order.partitions().sequence())
  {
    const PartitionIndex piece = plan.PieceOf[std::size_t(p)];
    for (const PartitionIndex q : order.partitions().later(p))
    {
      const PartitionIndex other = plan.PieceOf[std::size_t(q)];
      const auto isFirst = [&](PartitionIndex one)
      { return std::find(first.begin(), first.end(), one) != first.end(); };
      EXPECT_FALSE(piece != other && isFirst(piece) && isFirst(other));
    }
  }
}

TEST(RunSetup, IsRestoredOnAnotherRank)
{
  Steps steps(makePointSet("clustered", 4000));
  RunSetup run;
  run.Survey = steps.Survey;
  OutOfCoreOptions described;
  described.MapDuplicates = described.Neighbors = true;
  run.describeColumns({ "depth", "z" }, described);
  EXPECT_EQ(3, run.Rows.Z);
  run.Rows.Words = 3;
  run.Plan = std::make_unique<PiecePlan>(steps.plan());
  run.Spilled.reset(new SpilledPoints(steps.spill(*run.Plan)));
  run.describeMesh();
  SaveArchive out;
  run.save(out);
  const Bytes bytes = out.take();
  LoadArchive in(bytes);
  RunSetup back;
  back.load(in, steps.Folder.path("spill"));
  ASSERT_EQ(3U, back.Mesh.Arrays.size());
  EXPECT_EQ("depth", back.Mesh.Arrays[0].Name);
  EXPECT_EQ(Scalar::Int64, back.Mesh.Arrays[1].Type);
  EXPECT_EQ(2, findNeighborIds(back.Mesh));
  EXPECT_EQ(run.Mesh.Tiling, back.Mesh.Tiling);
  EXPECT_EQ(vtkBoundsOf(run.Mesh.Domain), vtkBoundsOf(back.Mesh.Domain));
  EXPECT_EQ(run.Spilled->starts(), back.work().Points.starts());
}

/// A run over pieces that only counts triangles.
class PieceRuns : public testing::Test
{
protected:
  bool run(const std::vector<char>& isDone, const std::function<bool(double)>& progress = {})
  {
    Communicator alone(nullptr);
    try
    {
      triangulatePieces(this->Work, this->Memory, 2, progress, alone, isDone);
      return true;
    }
    catch (const RankFailure& failure)
    {
      EXPECT_TRUE(failure.Aborted);
      return false;
    }
  }

  std::vector<char> doneNow() const
  {
    return verifyResults(this->Work, 2, {}, [](const std::string&) { ADD_FAILURE(); });
  }

  void expectAllTriangles() const
  {
    PieceFigures figures;
    std::int64_t triangles = 0;
    for (const FinishedPiece& piece : finishPieces(this->Work, 2, {}, figures))
    {
      triangles += piece.Summary.Cells;
    }
    EXPECT_EQ(std::int64_t(reference(this->XY).Mesh.size()), triangles);
    EXPECT_GT(figures.BoundaryBytes, 0U);
  }

  PartitionedMesh meshWithoutPath() const
  {
    PartitionedMesh mesh;
    mesh.Pieces.resize(std::size_t(this->Plan.pieces()));
    return mesh;
  }

  const Coordinates XY = makePointSet("uniform", 4000);
  Steps Of{ XY };
  PiecePlan Plan = Of.plan();
  const SpilledPoints Spilled = Of.spill(Plan);
  const MemoryPlan Memory = Of.memory();
  const PartitionedMesh Mesh = meshWithoutPath();
  const PieceWork Work{ { Plan, Spilled, Of.Rows, Mesh, Of.Folder.path("result") } };
  const std::vector<char> None = std::vector<char>(std::size_t(Plan.pieces()), 0);
};

TEST_F(PieceRuns, LeaveAResultOfEveryPiece)
{
  EXPECT_EQ(this->None, this->doneNow());
  EXPECT_TRUE(this->run(this->None));
  EXPECT_EQ(std::vector<char>(this->None.size(), 1), this->doneNow());
  this->expectAllTriangles();
}

TEST_F(PieceRuns, StopWhenAborted)
{
  EXPECT_FALSE(this->run(this->None, [](double done) { return done < 0.25; }));
}

TEST_F(PieceRuns, ResumeFromAnyResults)
{
  ASSERT_TRUE(this->run(this->None));
  for (const std::size_t kept : { 2, 3, 5 })
  {
    for (std::size_t piece = 0; piece < this->None.size(); ++piece)
    {
      if (piece % kept != 0)
      {
        fs::remove(this->Work.resultPath(PartitionIndex(piece)));
        fs::remove(this->Work.finishedPath(PartitionIndex(piece)));
      }
    }
    const std::vector<char> done = this->doneNow();
    EXPECT_NE(this->None, done);
    EXPECT_TRUE(this->run(done));
    this->expectAllTriangles();
  }
}

TEST_F(PieceRuns, MakeTheSameResultsAgain)
{
  ASSERT_TRUE(this->run(this->None));
  std::vector<std::string> results;
  for (PartitionIndex piece = 0; piece < this->Plan.pieces(); ++piece)
  {
    results.push_back(contentOf(this->Work.resultPath(piece)));
    fs::remove(this->Work.resultPath(piece));
  }
  ASSERT_TRUE(this->run(this->None));
  for (PartitionIndex piece = 0; piece < this->Plan.pieces(); ++piece)
  {
    EXPECT_EQ(results[std::size_t(piece)].size(), contentOf(this->Work.resultPath(piece)).size());
  }
}

} // namespace
