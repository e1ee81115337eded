// SPDX-License-Identifier: BSD-3-Clause
// What a run is made of: survey, plan, spill, schedule, checkpoints.
#include "OutOfCoreTesting.h"

#include "ExpectIOError.h"
#include "OutOfCore/AsideFile.h"
#include "OutOfCore/Checkpoint.h"
#include "OutOfCore/InputPasses.h"
#include "OutOfCore/InputSurvey.h"
#include "OutOfCore/LoadedPieces.h"
#include "OutOfCore/PieceMessages.h"
#include "OutOfCore/PiecePlan.h"
#include "OutOfCore/PieceRun.h"
#include "OutOfCore/PieceSchedule.h"
#include "OutOfCore/PreparedRun.h"
#include "Partitioned/NeighborIds.h"
#include "Points/WritePoints.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

namespace
{

namespace fs = std::filesystem;
using namespace tipp;
using namespace tipp::test;

/// The steps of a run, up to its schedule, in pieces of 300 points and partitions of 80.
class Steps
{
public:
  explicit Steps(const Coordinates& xy, std::size_t block = 1 << 14)
  {
    writePoints(this->Folder.path("points.npy"), xy);
    this->Stream = openPointStream({ this->Folder.path("points.npy") });
    this->Options.PiecePoints = 300;
    this->Options.PartitionPoints = 80;
    this->Survey =
      InputPasses(*this->Stream, nullptr, { block, 1 << 10, 2, [](std::int64_t) {} }).survey();
    this->Rows.Words = 3;
  }

  MemoryPlan memory() const { return MemoryPlan(this->Options, this->Rows.Words); }
  PiecePlan plan() const
  {
    return PiecePlan(this->Survey, this->Options, this->memory(), this->Rows.Words, 1);
  }
  SpilledPoints spill(PiecePlan& plan)
  {
    const SpilledPart all = spillPart(*this->Stream, this->Survey.Factor, plan, this->Rows,
      this->Folder.path("spill"), 0, 1000, 2, [](std::int64_t) {});
    return SpilledPoints({ all }, this->Survey, plan, this->Rows, this->Folder.path("spill"));
  }

  TemporaryFolder Folder;
  std::unique_ptr<PointStream> Stream;
  OutOfCoreOptions Options;
  InputSurvey Survey;
  PointRowLayout Rows;
};

TEST(Checkpoint, ComesBackAsItWasSaved)
{
  const TemporaryFolder folder;
  const std::vector<double> many(20000, 0.5);
  const std::uint64_t bytesWritten = writeCheckpoint(folder.path("state"),
    [&](SaveArchive& out)
    {
      out(std::int64_t(-7));
      out(std::string("a name"));
      out(many);
      out(std::vector<std::vector<std::int32_t>>{ { 1, 2 }, {}, { 3 } });
    });
  EXPECT_EQ(fs::file_size(folder.path("state")), bytesWritten);
  const Bytes bytes = readCheckpoint(folder.path("state"));
  LoadArchive in(bytes);
  std::int64_t number = 0;
  std::string name;
  std::vector<std::vector<std::int32_t>> lists;
  in(number);
  in(name);
  std::vector<double> manyBack;
  in(manyBack);
  in(lists);
  EXPECT_EQ(many, manyBack);
  EXPECT_EQ(-7, number);
  EXPECT_EQ("a name", name);
  EXPECT_EQ((std::vector<std::vector<std::int32_t>>{ { 1, 2 }, {}, { 3 } }), lists);
  EXPECT_THROW(in(number), std::runtime_error);
  EXPECT_EQ(1U, folder.fileCount());
}

TEST(Checkpoint, DamagedAnywhereItIsRefused)
{
  const TemporaryFolder folder;
  const std::string path = folder.path("state");
  writeCheckpoint(path, [](SaveArchive& out) { out(std::vector<std::int32_t>{ 1, 2, 3 }); });
  for (int at = 0; at < 8 + 8 + 12; ++at)
  {
    const auto flip = [&]
    {
      std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
      file.seekg(at);
      const char byte = char(file.get() ^ 0x21);
      file.seekp(at);
      file.put(byte);
    };
    flip();
    expectIOError(path, "damaged", [&] { readCheckpoint(path); });
    flip();
  }
  std::ofstream(path, std::ios::binary) << "short";
  EXPECT_THROW(readCheckpoint(path), IOError);
}

TEST(AsideFile, GivesBackItsParts)
{
  const TemporaryFolder folder;
  AsideFile file(folder.path("aside"));
  std::vector<AsideFile::Part> parts;
  for (const int number : { 7, 8, 9 })
  {
    SaveArchive archive;
    archive(std::vector<int>(100, number));
    parts.push_back(file.put(archive));
  }
  AsideFile later(folder.path("aside"));
  later.goOnFrom(parts[1].Offset + parts[1].Bytes);
  SaveArchive other;
  other(std::vector<int>(100, 5));
  EXPECT_EQ(parts[2].Offset, later.put(other).Offset);
  const Bytes bytes = later.get(parts[1]);
  LoadArchive archive(bytes);
  std::vector<int> numbers;
  archive(numbers);
  EXPECT_EQ(std::vector<int>(100, 8), numbers);
  expectIOError(folder.path("aside"), "is damaged", [&] { file.get(parts[2]); });
}

TEST(InputSurvey, CountsPointsAndTheirBounds)
{
  Coordinates xy = makePointSet("uniform", 5000);
  xy[20] = std::nan("");
  xy[41] = HUGE_VAL;
  xy[100] = -3;
  xy[103] = 17;
  const InputSurvey survey = Steps(xy).Survey;
  EXPECT_EQ(5000, survey.Points);
  EXPECT_EQ(2, survey.Rejected);
  EXPECT_EQ(-3, survey.Bounds.xmin);
  EXPECT_EQ(17, survey.Bounds.ymax);
  EXPECT_FALSE(survey.Collinear);
  EXPECT_EQ(1, survey.Factor);
}

TEST(InputSurvey, SamplesTheSamePointsInBlocksOfAnySize)
{
  const Coordinates xy = makePointSet("clustered", 9000);
  const InputSurvey expected = Steps(xy).Survey;
  EXPECT_GE(expected.Sample.size(), std::size_t(1) << 10);
  EXPECT_LE(expected.Sample.size(), std::size_t(1) << 11);
  for (const std::size_t block : { 1, 77, 4096 })
  {
    const InputSurvey survey = Steps(xy, block).Survey;
    ASSERT_EQ(expected.Sample.size(), survey.Sample.size());
    for (std::size_t i = 0; i < survey.Sample.size(); ++i)
    {
      const auto id = std::size_t(survey.Sample[i].Id);
      ASSERT_EQ(expected.Sample[i].Id, survey.Sample[i].Id);
      ASSERT_TRUE(survey.Sample[i].Place == (Point2{ xy[2 * id], xy[2 * id + 1] }));
    }
  }
}

TEST(InputSurvey, TellsPointsOnOneLine)
{
  Coordinates xy;
  for (int i = 0; i < 3000; ++i)
  {
    xy.insert(xy.end(), { double(i), 2.0 * i });
  }
  EXPECT_TRUE(Steps(xy).Survey.Collinear);
  xy.back() = 1;
  EXPECT_FALSE(Steps(xy).Survey.Collinear);
}

TEST(InputSurvey, ScalesCoordinatesThatAreFarFromOneByAPowerOfTwo)
{
  Coordinates xy = makePointSet("uniform", 500);
  for (double& value : xy)
  {
    value *= std::ldexp(1.0, 900);
  }
  const InputSurvey survey = Steps(xy).Survey;
  int exponent = 0;
  EXPECT_EQ(0.5, std::frexp(survey.Factor, &exponent));
  EXPECT_LT(survey.Factor, 1);
  EXPECT_LT(survey.Bounds.xmax, 1e150);
}

TEST(PiecePlan, EachPartitionLiesInItsPiece)
{
  const Coordinates xy = makePointSet("clustered", 4000);
  const PiecePlan plan = Steps(xy).plan();
  EXPECT_GT(plan.pieces(), 8);
  EXPECT_GT(plan.Partitions.size(), 2 * plan.pieces());
  for (std::size_t i = 0; i < xy.size(); i += 2)
  {
    const Point2 p{ xy[i], xy[i + 1] };
    ASSERT_EQ(plan.Pieces.locate(p), plan.PieceOf[std::size_t(plan.Partitions.locate(p))]);
  }
}

TEST(PiecePlan, LessMemoryMakesMorePieces)
{
  Steps steps(makePointSet("uniform", 100000));
  steps.Options.PiecePoints = 0;
  steps.Options.PartitionPoints = 0;
  steps.Options.MemoryLimit = 4 << 20;
  const PartitionIndex few = steps.plan().pieces();
  steps.Options.MemoryLimit = 1 << 20;
  EXPECT_GT(steps.plan().pieces(), few);
}

TEST(PiecePlan, KnowsWhereTheRimWillBeLarge)
{
  Steps circle(makePointSet("circle", 4000));
  EXPECT_TRUE(circle.plan().IsAlone);
  EXPECT_FALSE(circle.plan().HasLargeRim);
  circle.Options.MemoryLimit = 1;
  EXPECT_FALSE(circle.plan().IsAlone);
  EXPECT_TRUE(circle.plan().HasLargeRim);
  Steps uniform(makePointSet("uniform", 4000));
  uniform.Options.MemoryLimit = 1;
  EXPECT_FALSE(uniform.plan().HasLargeRim);
}

TEST(PiecePlan, ComesBackFromAnArchive)
{
  const Coordinates xy = makePointSet("clustered", 4000);
  const PiecePlan plan = Steps(xy).plan();
  SaveArchive out;
  plan.save(out);
  const Bytes bytes = out.Writer.take();
  LoadArchive in(bytes);
  const PiecePlan back(in);
  EXPECT_EQ(plan.FirstPartition, back.FirstPartition);
  EXPECT_EQ(plan.PieceOf, back.PieceOf);
  EXPECT_EQ(plan.Initial.size(), back.Initial.size());
  EXPECT_EQ(plan.Artificial.size(), back.Artificial.size());
  for (std::size_t i = 0; i < xy.size(); i += 2)
  {
    const Point2 p{ xy[i], xy[i + 1] };
    ASSERT_EQ(plan.Partitions.locate(p), back.Partitions.locate(p));
  }
}

TEST(SpilledPoints, HasEachPiecesPointsInTheOrderOfTheStream)
{
  const Coordinates xy = makePointSet("clustered", 4000);
  Steps steps(xy);
  PiecePlan plan = steps.plan();
  const SpilledPoints spilled = steps.spill(plan);
  EXPECT_EQ(4000, spilled.starts().back());
  for (PartitionIndex piece = 0; piece < plan.pieces(); ++piece)
  {
    const auto count = std::size_t(spilled.count(piece));
    std::vector<double> rows(3 * count);
    spilled.read(piece, rows.data());
    std::int64_t last = -1;
    for (std::size_t i = 0; i < count; ++i)
    {
      const std::int64_t id = steps.Rows.id(&rows[3 * i]);
      ASSERT_GT(id, last);
      last = id;
      const Point2 p{ xy[2 * std::size_t(id)], xy[2 * std::size_t(id) + 1] };
      ASSERT_TRUE(p == (Point2{ rows[3 * i], rows[3 * i + 1] }));
      ASSERT_EQ(piece, plan.Pieces.locate(p));
    }
  }
}

TEST(SpilledPoints, KeepsNoFileOpenThatOthersRead)
{
  Steps steps(makePointSet("uniform", 4000));
  PiecePlan plan = steps.plan();
  const SpilledPoints spilled = steps.spill(plan);
  ASSERT_TRUE(fs::exists(steps.Folder.path("spill.0")));
  for (const fs::directory_entry& open : fs::directory_iterator("/proc/self/fd"))
  {
    std::error_code gone; // the iterator's own
    EXPECT_NE(fs::path(steps.Folder.path("spill.0")), fs::read_symlink(open.path(), gone));
  }
}

TEST(SpilledPoints, ThoseOfOtherPiecesAreRefused)
{
  Steps steps(makePointSet("uniform", 4000));
  PiecePlan plan = steps.plan();
  const SpilledPoints spilled = steps.spill(plan);
  SaveArchive out;
  spilled.save(out);
  for (const std::size_t at : { 8, 16 }) // the first two of starts(), behind their number
  {
    Bytes bytes(out.Writer.size());
    std::copy_n(out.Writer.data(), bytes.size(), bytes.begin());
    bytes.data()[at] ^= 1;
    LoadArchive in(bytes);
    expectIOError(steps.Folder.path("spill"), "other pieces",
      [&] { SpilledPoints(steps.Folder.path("spill"), plan, steps.Rows, in); });
  }
}

TEST(SpilledPoints, DamagedAreRefusedPieceByPiece)
{
  Steps steps(makePointSet("clustered", 4000));
  PiecePlan plan = steps.plan();
  const SpilledPoints spilled = steps.spill(plan);
  const std::string file = steps.Folder.path("spill.0");
  std::string content = contentOf(file);
  content[content.size() - 20] ^= 1;
  steps.Folder.file("spill.0", content);
  SaveArchive out;
  spilled.save(out);
  const Bytes bytes = out.Writer.take();
  LoadArchive in(bytes);
  const SpilledPoints back(file.substr(0, file.size() - 2), plan, steps.Rows, in);
  for (const SpilledPoints* const points : { &spilled, &back })
  {
    int damaged = 0;
    for (PartitionIndex piece = 0; piece < plan.pieces(); ++piece)
    {
      std::vector<double> rows(3 * std::size_t(points->count(piece)));
      try
      {
        points->read(piece, rows.data());
      }
      catch (const IOError& error)
      {
        ++damaged;
        EXPECT_EQ(0U, std::string(error.what()).find(file + ": is damaged")) << error.what();
      }
    }
    EXPECT_EQ(1, damaged);
  }
}

TEST(PieceSchedule, ActivatesNothingBeforeAPieceIsLoaded)
{
  Steps steps(makePointSet("uniform", 4000));
  PiecePlan plan = steps.plan();
  const SpilledPoints spilled = steps.spill(plan);
  PieceSchedule schedule(plan, spilled, steps.Rows, plan.initialMesh(1));
  std::vector<PlainVertex> vertices;
  EXPECT_FALSE(schedule.allActivated());
  EXPECT_EQ(-1, schedule.activateNext(vertices));
  EXPECT_EQ(-1, schedule.takeComplete());
  EXPECT_TRUE(schedule.isToLoad(0));
  EXPECT_FALSE(schedule.addLoaded(0));
  EXPECT_FALSE(schedule.isToLoad(0));
  const PartitionIndex partition = schedule.activateNext(vertices);
  ASSERT_GE(partition, 0);
  EXPECT_EQ(0, plan.PieceOf[std::size_t(partition)]);
  EXPECT_FALSE(vertices.empty());
}

TEST(PieceSchedule, GivesARankThePartitionsOfItsOwnPiecesOnly)
{
  Steps steps(makePointSet("uniform", 4000));
  PiecePlan plan = steps.plan();
  const SpilledPoints spilled = steps.spill(plan);
  PieceSchedule schedule(plan, spilled, steps.Rows, plan.initialMesh(1));
  const PartitionIndex last = plan.pieces() - 1;
  schedule.addLoaded(0, 2);
  schedule.addLoaded(last, 1);
  std::vector<PlainVertex> vertices;
  EXPECT_EQ(-1, schedule.activateNext(vertices, 0));
  EXPECT_EQ(0, plan.PieceOf.at(std::size_t(schedule.activateNext(vertices, 2))));
  EXPECT_EQ(last, plan.PieceOf.at(std::size_t(schedule.activateNext(vertices, 1))));
}

PartitionResult returned(const PartitionResult& result)
{
  PartitionResult back;
  unpack(pack(result), back);
  return back;
}

TEST(LoadedPieces, MakeTheInteriorOfFinishedPartitionsAgain)
{
  const Coordinates xy = makePointSet("duplicates", 4000);
  Steps steps(xy);
  PiecePlan plan = steps.plan();
  const SpilledPoints spilled = steps.spill(plan);
  PartitionedMesh mesh; // without a path: triangles are counted
  mesh.Pieces.resize(std::size_t(plan.pieces()));
  const PieceWork work{ plan, spilled, 1, steps.Rows, mesh };
  PieceSchedule schedule(plan, spilled, steps.Rows, plan.initialMesh(1));
  LoadedPieces pieces(work);
  pieces.load(0, {});
  schedule.addLoaded(0);
  LoadedPieces::Place place;
  bool isWhole = false;
  while (!isWhole)
  {
    const PartitionIndex partition = schedule.activateNext(place.Vertices);
    isWhole = schedule.complete(returned(pieces.triangulate(place, partition)));
  }
  const InteriorTask task = schedule.startInterior(0);
  InteriorTask sent;
  unpack(pack(task), sent);
  const auto sumOf = [&](const InteriorTask& of)
  { return pieces.writeInterior(of).writeBorder(mesh, plan.number(0), steps.Rows).TriangleSum; };
  const std::uint64_t expected = sumOf(task);
  LoadOrder order;
  unpack(pack(LoadOrder{ 0, schedule.finishedPartitions(0) }), order);
  EXPECT_EQ(plan.FirstPartition[1], PartitionIndex(order.Finished.size()));
  pieces.load(order.Piece, order.Finished);
  EXPECT_EQ(expected, sumOf(sent));
  EXPECT_NE(0U, expected);
}

TEST(PieceMessages, CutShortAreRefused)
{
  const Bytes whole = pack(PartitionTask{ 7, { { { 1, 2 }, 3 } } });
  PartitionTask task;
  unpack(whole, task);
  EXPECT_EQ(7, task.Partition);
  ASSERT_EQ(1U, task.Vertices.size());
  EXPECT_EQ(3, task.Vertices[0].Id);
  for (std::size_t size = 0; size < whole.size(); ++size)
  {
    Bytes part(size);
    std::copy_n(whole.begin(), size, part.begin());
    EXPECT_THROW(unpack(part, task), std::runtime_error) << size;
  }
}

TEST(PreparedRun, ComesBackOnAnotherRank)
{
  Steps steps(makePointSet("clustered", 4000));
  PreparedRun run;
  run.Survey = steps.Survey;
  run.describeColumns({ "depth", "z" }, true, true);
  EXPECT_EQ(3, run.Rows.Z);
  run.Rows.Words = 3;
  run.Plan = std::make_unique<PiecePlan>(steps.plan());
  run.Spilled.reset(new SpilledPoints(steps.spill(*run.Plan)));
  run.describeMesh();
  SaveArchive out;
  run.save(out);
  const Bytes bytes = out.Writer.take();
  LoadArchive in(bytes);
  PreparedRun back;
  back.load(in, steps.Folder.path("spill"));
  ASSERT_EQ(3U, back.Mesh.Arrays.size());
  EXPECT_EQ("depth", back.Mesh.Arrays[0].Name);
  EXPECT_EQ(Scalar::Int64, back.Mesh.Arrays[1].Type);
  EXPECT_EQ(2, findNeighborIds(back.Mesh));
  EXPECT_EQ(run.Mesh.Tiling, back.Mesh.Tiling);
  EXPECT_EQ(run.Mesh.Domain, back.Mesh.Domain);
  EXPECT_EQ(run.Spilled->starts(), back.work().Points.starts());
}

TEST(PieceRun, FinishesEveryPieceOrStopsWhereItIsTold)
{
  const Coordinates xy = makePointSet("uniform", 4000);
  Steps steps(xy);
  PiecePlan plan = steps.plan();
  const SpilledPoints spilled = steps.spill(plan);
  const MemoryPlan memory = steps.memory();
  PartitionedMesh mesh; // without a path: triangles are counted
  mesh.Pieces.resize(std::size_t(plan.pieces()));
  const PieceWork work{ plan, spilled, 1, steps.Rows, mesh };
  PieceRun run(work, memory, 2, [](std::int64_t) { return true; });
  EXPECT_TRUE(run.triangulate());
  std::int64_t triangles = 0;
  for (const FinishedPiece& piece : run.finished())
  {
    triangles += piece.Summary.Cells;
  }
  EXPECT_EQ(std::int64_t(reference(xy).Mesh.size()), triangles);

  PieceRun stopped(work, memory, 2, [](std::int64_t done) { return done < 1000; });
  EXPECT_FALSE(stopped.triangulate());
}

} // namespace
