// SPDX-License-Identifier: BSD-3-Clause
// The steps of an out-of-core run in space: plan, spilled points, results of pieces, finished
// pieces.
#include "ExpectIOError.h"
#include "PointsInSpace.h"
#include "TemporaryFolder.h"

#include "Npy/NpyFile.h"
#include "OutOfCore/FinishPieces.h"
#include "OutOfCore/InputPasses.h"
#include "OutOfCore/PiecePlan3.h"
#include "OutOfCore/PieceResult.h"
#include "OutOfCore/PieceRun.h"
#include "Points/ReadPoints.h"
#include "Predicates/ExactPredicates3.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <set>

namespace
{

namespace fs = std::filesystem;
using namespace tipp;
using namespace tipp::test;

constexpr std::size_t words = 5; // x, y, z, number, id

/// Changes one byte of a file. A second call restores it.
void flip(const std::string& path, std::uint64_t at)
{
  std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
  file.seekg(std::streamoff(at));
  const char byte = char(file.get() ^ 0x21);
  file.seekp(std::streamoff(at));
  file.put(byte);
}

/// A plan, and the points that it has spilled by piece.
struct Planned
{
  Planned(const std::vector<Point3>& points, std::int64_t piecePoints, int threads,
    const std::string& file)
    : Memory(1 << 20, piecePoints, words)
    , Stream(streamOf(points))
    , Passes(*this->Stream, nullptr,
        { this->Memory.BlockPoints, this->Memory.SamplePoints, threads, [](std::int64_t) {} })
    , Survey(this->Passes.survey())
    , Plan(this->Survey, this->Memory, words)
    , Points(this->Passes.spill(this->Survey, this->Plan, file))
  {
    this->Rows.Words = words;
    this->Rows.Z = 2;
    this->Rows.Attributes = { 3 };
  }

  std::vector<double> rowsOf(PartitionIndex piece) const
  {
    std::vector<double> rows(words * std::size_t(this->Points->count(piece)));
    this->Points->read(piece, rows.data());
    return rows;
  }

  MemoryPlan3 Memory;
  std::unique_ptr<PointStream> Stream;
  InputPassesOf<PiecePlan3> Passes;
  InputSurvey3 Survey;
  PointRowLayout Rows;
  PiecePlan3 Plan;
  std::unique_ptr<SpilledPoints> Points;
};

/// The state of a run after its points have been spilled.
class PlannedRun : public Planned
{
public:
  PlannedRun(const TemporaryFolder& folder, const std::vector<Point3>& points)
    : Planned(points, 300, 2, folder.path("points"))
    , Results(folder.path("piece"))
  {
    this->Mesh.Path = folder.path("mesh");
    this->Mesh.CellSize = 4;
    this->Mesh.Points = std::int64_t(points.size());
    this->Mesh.Arrays = { { "number", true, Scalar::Float64, 1, -1 } };
    this->Mesh.Pieces.resize(std::size_t(this->Plan.pieces()));
    fs::create_directories(this->Mesh.Path + "/pieces");
  }

  PieceWork3 work() const
  {
    return { this->Plan, *this->Points, this->Rows, this->Mesh, this->Results,
      this->Survey.Factor };
  }

  void triangulate() { this->triangulate(std::vector<char>(std::size_t(this->Plan.pieces()), 0)); }
  void triangulate(
    const std::vector<char>& isDone, const std::function<bool(double)>& progress = {})
  {
    Communicator alone(nullptr);
    triangulatePieces(this->work(), this->Memory, 2, progress, alone, isDone);
  }

  std::vector<FinishedPiece> finish(const Report& report = {})
  {
    return finishPieces(this->work(), 1 << 20, 2, report, this->Figures);
  }

  PartitionedMesh Mesh;
  const std::string Results;
  PieceFigures Figures;
};

double volumeOf(const Box3& box)
{
  return box.width(0) * box.width(1) * box.width(2);
}

/// A result without empty parts.
PieceResult3 makeResult()
{
  PieceResult3 result;
  result.Interior.Points = 11;
  result.Interior.Cells = 12;
  result.Interior.Checksums = { 5, 6 };
  result.Interior.InterfacePoints = { 7, 9 };
  result.Interior.InterfaceRows = { 1, 2, 3, 4, 5, 6, 7, 8, 9, 10 };
  result.Interior.InterfaceCells = { { 1, -1, -2, 3 } };
  result.Figures.Duplicates = 4;
  result.Figures.WorkerVertices = 99;
  result.HullVertices = { { { 0.5, 1.5, 2.5 }, 8, 1 } };
  result.Borders[1].add({ 1, 2, 3, 4 }, { 1, 3, 4 });
  result.Borders[1].add({ 5, 6, 7, 8 }, { 1 });
  result.Sent[2].push_back({ 2, { 0, 1, { { { 3, 4, 5 }, 6, 0 }, { { 7, 8, 9 }, 10, 0 } } } });
  return result;
}

} // namespace

TEST(PiecePlan3, EverySpilledPointIsInTheBoxOfItsPiece)
{
  const TemporaryFolder folder;
  for (const char* const kind : { "uniform", "clustered", "lattice", "surface" })
  {
    const auto points = pointsInSpace(kind, 3000);
    const Planned planned(points, 100, 2, folder.path("points"));
    const PiecePlan3& plan = planned.Plan;
    ASSERT_GT(plan.pieces(), 10) << kind;
    std::set<double> numbers;
    double volume = 0;
    for (PartitionIndex piece = 0; piece < plan.pieces(); ++piece)
    {
      const auto index = std::size_t(piece);
      EXPECT_GT(planned.Points->count(piece), 0);
      const std::vector<double> rows = planned.rowsOf(piece);
      for (std::size_t at = 0; at < rows.size(); at += words)
      {
        const Point3 p{ rows[at], rows[at + 1], rows[at + 2] };
        EXPECT_TRUE(plan.box(PartitionIndex(index)).contains(p) && plan.Regions[index].contains(p))
          << kind;
        EXPECT_TRUE(p == points.at(std::size_t(rows[at + 3])));
        numbers.insert(rows[at + 3]);
      }
      const SpilledPoints& spilled = *planned.Points;
      EXPECT_EQ(piece, spilled.pieceOf(spilled.first(piece)));
      EXPECT_EQ(piece, spilled.pieceOf(spilled.first(piece) + spilled.count(piece) - 1));
      volume += volumeOf(plan.box(PartitionIndex(index)));
    }
    EXPECT_EQ(points.size(), numbers.size()) << kind;
    EXPECT_NEAR(volumeOf(planned.Survey.Bounds), volume, 1e-9 * volume) << kind;
  }
}

/// The partitions that each cell meets.
std::vector<std::vector<PartitionIndex>> metBy(const BoundaryCells<3>& mesh)
{
  std::vector<std::vector<PartitionIndex>> met;
  for (std::size_t cell = 0; cell < mesh.Cells.size(); ++cell)
  {
    met.emplace_back(mesh.metBegin(cell), mesh.metEnd(cell));
  }
  return met;
}

TEST(PiecePlan3, IsTheSameForAnyNumberOfThreads)
{
  const TemporaryFolder folder;
  const auto points = pointsInSpace("clustered", 4000);
  const Planned one(points, 150, 1, folder.path("one"));
  const BoundaryCells<3> initial = one.Plan.initialMesh();
  for (const int threads : { 2, 5 })
  {
    const Planned other(points, 150, threads, folder.path("other"));
    ASSERT_EQ(one.Plan.pieces(), other.Plan.pieces());
    for (PartitionIndex piece = 0; piece < one.Plan.pieces(); ++piece)
    {
      EXPECT_TRUE(one.rowsOf(piece) == other.rowsOf(piece));
    }
    const BoundaryCells<3> mesh = other.Plan.initialMesh();
    EXPECT_TRUE(initial.Cells == mesh.Cells);
    EXPECT_TRUE(metBy(initial) == metBy(mesh));
  }
}

TEST(PiecePlan3, ComesBackAsItWasSaved)
{
  const TemporaryFolder folder;
  auto points = pointsInSpace("clustered", 3000);
  points[7].y = std::nan("");
  Planned planned(points, 150, 2, folder.path("points"));
  const PiecePlan3& plan = planned.Plan;
  SaveArchive saved;
  saved(planned.Survey);
  plan.save(saved);
  planned.Points->save(saved);
  const Bytes bytes = saved.take();
  LoadArchive archive(bytes);
  const auto survey = archive.get<InputSurvey3>();
  const PiecePlan3 restored(archive);
  const SpilledPoints spilled(folder.path("points"), words, restored.pieces(), archive);
  EXPECT_EQ(0U, archive.left());
  EXPECT_EQ(1, survey.Rejected);
  EXPECT_EQ(planned.Survey.finite(), survey.finite());
  ASSERT_EQ(plan.pieces(), restored.pieces());
  for (PartitionIndex piece = 0; piece < plan.pieces(); ++piece)
  {
    EXPECT_EQ(plan.box(piece).Min, restored.box(piece).Min);
    EXPECT_EQ(plan.Regions[std::size_t(piece)].Max, restored.Regions[std::size_t(piece)].Max);
    const std::vector<double> rows = planned.rowsOf(piece);
    std::vector<double> again(rows.size());
    ASSERT_EQ(planned.Points->count(piece), spilled.count(piece));
    spilled.read(piece, again.data());
    EXPECT_TRUE(rows == again);
    const Point3 first{ rows[0], rows[1], rows[2] };
    EXPECT_EQ(piece, restored.Pieces.locate(first));
  }
  EXPECT_TRUE(plan.initialMesh().Cells == restored.initialMesh().Cells);
  EXPECT_TRUE(metBy(plan.initialMesh()) == metBy(restored.initialMesh()));
}

TEST(PiecePlan3, SpilledPointsOfOtherPiecesAreRefused)
{
  const TemporaryFolder folder;
  const auto points = pointsInSpace("uniform", 2000);
  const Planned planned(points, 300, 2, folder.path("points"));
  SaveArchive saved;
  planned.Points->save(saved);
  const Bytes bytes = saved.take();
  const Planned other(points, 900, 2, folder.path("points"));
  LoadArchive archive(bytes);
  fs::resize_file(folder.path("points.0"), fs::file_size(folder.path("points.0")) / 2);
  expectIOError(folder.path("points.0"), "shorter",
    [&] { SpilledPoints(folder.path("points"), words, planned.Plan.pieces(), archive); });
}

/// Surveys and spills a stream in so many parts. Returns the saved plan.
std::string planFromParts(PointStream& stream, std::int64_t cuts, const std::string& file)
{
  const std::int64_t count = stream.divisible();
  const MemoryPlan3 memory(1 << 20, 150, 4);
  const PassOptions options{ 700, memory.SamplePoints, 2, [](std::int64_t) {} };
  const auto limitTo = [&](std::int64_t part)
  { stream.limitTo(count * part / cuts, count * (part + 1) / cuts); };
  std::vector<InputSurvey3> surveys;
  for (std::int64_t part = 0; part < cuts; ++part)
  {
    limitTo(part);
    surveys.push_back(surveyPart<3>(stream, count, options));
  }
  const InputSurvey3 survey = joinSurveys(surveys);
  EXPECT_EQ(count, survey.Points);
  PiecePlan3 plan(survey, memory, 4);
  EXPECT_GT(plan.pieces(), 10);
  std::vector<SpilledPart> parts;
  for (std::int64_t part = 0; part < cuts; ++part)
  {
    limitTo(part);
    parts.push_back(spillPart(stream, survey.Factor, plan, file, int(part), options));
  }
  placeInitialPoints(parts, survey, plan);
  SaveArchive saved;
  plan.save(saved);
  const Bytes bytes = saved.take();
  return std::string(bytes.begin(), bytes.end());
}

TEST(PiecePlan3, IsTheSameForAnyDivisionOfTheInput)
{
  const TemporaryFolder folder;
  const auto points = pointsInSpace("lattice", 4000);
  NpyWriter writer(folder.path("points.npy"), "<f8", { std::int64_t(points.size()), 3 });
  writer.write(points.data(), points.size() * sizeof(Point3));
  writer.close();
  PointOptions inSpace;
  inSpace.InSpace = true;
  const auto stream = openPointStream({ folder.path("points.npy") }, inSpace);
  ASSERT_EQ(std::int64_t(points.size()), stream->divisible());
  const std::string whole = planFromParts(*stream, 1, folder.path("spilled"));
  EXPECT_TRUE(whole == planFromParts(*stream, 2, folder.path("spilled")));
  EXPECT_TRUE(whole == planFromParts(*stream, 5, folder.path("spilled")));
}

TEST(PiecePlan3, DamagedSpilledPointsAreRefused)
{
  const TemporaryFolder folder;
  const Planned planned(pointsInSpace("uniform", 2000), 500, 2, folder.path("points"));
  const std::string file = folder.path("points.0");
  const std::uint64_t bytes = fs::file_size(file);
  for (const std::uint64_t at : { bytes / 3, bytes / 2, bytes - 1 })
  {
    flip(file, at);
    expectIOError(file, "is damaged",
      [&]
      {
        for (PartitionIndex piece = 0; piece < planned.Plan.pieces(); ++piece)
        {
          planned.rowsOf(piece);
        }
      });
    flip(file, at);
  }
}

TEST(BorderSorter3, TheOwnerIsTheFirstPieceMet)
{
  const TemporaryFolder folder;
  const auto points = pointsInSpace("lattice", 2200);
  const Planned planned(points, 100, 1, folder.path("points"));
  const PiecePlan3& plan = planned.Plan;
  BordersByOwner3 borders;
  BorderSorter3 sorter(plan, borders);
  std::size_t most = 0;
  for (std::size_t i = 0; i + 4 <= 800; i += 4)
  {
    std::array<Vertex3, 4> corners;
    for (std::size_t k = 0; k < 4; ++k)
    {
      // Every second tetrahedron has corners among the first eleven points.
      const std::size_t at = i % 8 == 0 ? i + k : (i + k * k) % 11;
      corners[k] = { points[at], std::int64_t(at), 0 };
    }
    std::vector<std::int32_t> expected;
    for (PartitionIndex piece = 0; piece < plan.pieces(); ++piece)
    {
      if (tetrahedronMeetsBox(corners[0].Position, corners[1].Position, corners[2].Position,
            corners[3].Position, plan.box(piece)))
      {
        expected.push_back(std::int32_t(plan.number(piece)));
      }
    }
    std::sort(expected.begin(), expected.end());
    EXPECT_EQ(expected, sorter.findMet(corners));
    borders.clear();
    sorter.add(corners, expected);
    ASSERT_EQ(1U, borders.size());
    EXPECT_EQ(std::size_t(expected.front()), plan.number(borders.begin()->first));
    expected.erase(expected.begin());
    EXPECT_EQ(expected, borders.begin()->second.Borrowers);
    most = std::max(most, expected.size());
  }
  EXPECT_GT(most, 4U);
}

TEST(StoredResult3, IsReadAsWritten)
{
  const TemporaryFolder folder;
  const PlannedRun run(folder, pointsInSpace("uniform", 1000));
  const PieceResult3 result = makeResult();
  StoredResult3::write(folder.path("result"), result);
  const StoredResult3 stored(folder.path("result"));
  const PieceInterior interior = stored.readInterior(*run.Points, 1, true);
  EXPECT_EQ(run.Points->first(1), interior.First);
  EXPECT_EQ(run.Points->count(1), interior.OwnPoints);
  EXPECT_EQ(11, interior.Points);
  EXPECT_EQ(12, interior.Cells);
  EXPECT_EQ(result.Interior.Checksums, interior.Checksums);
  EXPECT_EQ(result.Interior.InterfacePoints, interior.InterfacePoints);
  EXPECT_EQ(result.Interior.InterfaceRows, interior.InterfaceRows);
  EXPECT_EQ(result.Interior.InterfaceCells, interior.InterfaceCells);
  EXPECT_EQ(99, stored.readFigures().WorkerVertices);
  ASSERT_EQ(1U, stored.readHullVertices().size());
  EXPECT_EQ(8, stored.readHullVertices()[0].Id);
  EXPECT_FALSE(stored.hasBorder(0));
  ASSERT_TRUE(stored.hasBorder(1));
  const BorderCells3 border = stored.readBorder(1);
  EXPECT_EQ(result.Borders.at(1).Corners, border.Corners);
  EXPECT_EQ((std::vector<std::int32_t>{ 3, 4 }), border.Borrowers);
  EXPECT_EQ((std::vector<std::uint64_t>{ 2, 2 }), border.BorrowerEnds);
  EXPECT_EQ(0U, stored.sentBytes(1));
  EXPECT_GE(stored.sentBytes(2), 2 * sizeof(Vertex3));
  ASSERT_EQ(1U, stored.readMessages(2).size());
  const auto [to, message] = stored.readMessages(2)[0];
  EXPECT_EQ(2, to);
  EXPECT_EQ(0, message.Sender);
  ASSERT_EQ(2U, message.Vertices.size());
  EXPECT_EQ(10, message.Vertices[1].Id);
}

TEST(StoredResult3, IsRefusedIfAnyByteIsDamaged)
{
  const TemporaryFolder folder;
  const PlannedRun run(folder, pointsInSpace("uniform", 1000));
  const std::string path = folder.path("result");
  StoredResult3::write(path, makeResult());
  const auto readAll = [&]
  {
    const StoredResult3 stored(path);
    stored.readInterior(*run.Points, 1, true);
    stored.readFigures();
    stored.readHullVertices();
    stored.readBorder(1);
    stored.readMessages(2);
  };
  readAll();
  for (std::uint64_t at = 0; at < fs::file_size(path); ++at)
  {
    flip(path, at);
    expectIOError(path, "is damaged", readAll);
    flip(path, at);
  }
  fs::resize_file(path, fs::file_size(path) - 1);
  EXPECT_THROW(readAll(), IOError);
}

TEST(FinishPieces3, EveryTetrahedronHasOneOwner)
{
  const TemporaryFolder folder;
  const auto points = pointsInSpace("clustered", 3000);
  PlannedRun run(folder, points);
  run.triangulate();
  const std::vector<FinishedPiece> finished = run.finish();
  ASSERT_EQ(std::size_t(run.Plan.pieces()), finished.size());
  const auto cells = std::accumulate(finished.begin(), finished.end(), std::int64_t(0),
    [](std::int64_t sum, const FinishedPiece& piece) { return sum + piece.Summary.Cells; });
  EXPECT_EQ(std::int64_t(tetrahedralize(points.data(), points.size()).cellCount()), cells);
  EXPECT_GE(run.Figures.WorkerVertices, 3000);
}

TEST(FinishPieces3, StopsWhenAborted)
{
  const TemporaryFolder folder;
  PlannedRun run(folder, pointsInSpace("uniform", 2000));
  run.triangulate();
  EXPECT_THROW(
    run.finish([](double) -> bool { throw std::runtime_error("stopped"); }), std::runtime_error);
}

TEST(PieceRun3, MakesThePiecesAgainThatAreNotDone)
{
  const TemporaryFolder folder;
  PlannedRun run(folder, pointsInSpace("clustered", 3000));
  run.triangulate();
  const PartitionIndex pieces = run.Plan.pieces();
  ASSERT_GT(pieces, 6);
  std::vector<std::string> results;
  std::vector<char> isDone;
  for (PartitionIndex piece = 0; piece < pieces; ++piece)
  {
    const std::string path = run.work().resultPath(piece);
    results.push_back(contentOf(path));
    isDone.push_back(char(piece % 3 != 0));
    if (piece % 3 == 0)
    {
      fs::remove(path);
    }
  }
  const auto ignore = [](const std::string& sentence) { FAIL() << sentence; };
  EXPECT_EQ(isDone, verifyResults(run.work(), 2, {}, ignore));
  double told = 0;
  run.triangulate(isDone,
    [&told](double done)
    {
      told = done;
      return true;
    });
  EXPECT_EQ(1, told);
  for (PartitionIndex piece = 0; piece < pieces; ++piece)
  {
    EXPECT_TRUE(results[std::size_t(piece)] == contentOf(run.work().resultPath(piece))) << piece;
  }
}

TEST(FinishPieces3, ADamagedResultIsRefused)
{
  const TemporaryFolder folder;
  PlannedRun run(folder, pointsInSpace("uniform", 2000));
  run.triangulate();
  const std::string path = run.Results + ".2";
  ASSERT_TRUE(fs::exists(path));
  flip(path, fs::file_size(path) / 3);
  EXPECT_THROW(
    {
      run.finish();
      const StoredResult3 result(path);
      for (PartitionIndex to = 0; to < run.Plan.pieces(); ++to)
      {
        if (result.sentBytes(to) > 0)
        {
          result.readMessages(to);
        }
      }
    },
    IOError);
}
