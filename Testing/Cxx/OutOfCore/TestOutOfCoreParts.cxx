// SPDX-License-Identifier: BSD-3-Clause
// The first steps of a run: checkpoints, survey, plan, spilled points.
#include "OutOfCore/SpilledPoints.h"
#include "OutOfCoreTesting.h"
#include "Triangulation/InputSurvey.h"

#include "ExpectIOError.h"
#include "Npy/NpyFile.h"
#include "OutOfCore/PiecePlan.h"
#include "OutOfCore/ScratchFiles.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>

namespace
{

namespace fs = std::filesystem;
using namespace tipp;
using namespace tipp::test;

TEST(CheckedFile, IsReadAsSaved)
{
  const TemporaryFolder folder;
  const std::vector<double> many(20000, 0.5);
  writeCheckedFile(folder.path("state"),
    [&](SaveArchive& out)
    {
      out(std::int64_t(-7));
      out(std::string("a name"));
      out(many);
      out(std::vector<std::vector<std::int32_t>>{ { 1, 2 }, {}, { 3 } });
    });
  const Bytes bytes = readCheckedFile(folder.path("state"));
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

TEST(CheckedFile, IsRefusedIfAnyByteIsDamaged)
{
  const TemporaryFolder folder;
  const std::string path = folder.path("state");
  writeCheckedFile(path, [](SaveArchive& out) { out(std::vector<std::int32_t>{ 1, 2, 3 }); });
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
    expectIOError(path, "damaged", [&] { readCheckedFile(path); });
    flip();
  }
  std::ofstream(path, std::ios::binary) << "short";
  EXPECT_THROW(readCheckedFile(path), IOError);
}

/// Writes a file with two sections, {0, 3} and {2, 1}.
void writeSections(const std::string& path)
{
  SectionFileWriter file(path);
  file.add({ 2, 1 }, packed(std::vector<int>{ 7, 8 }));
  file.add({ 0, 3 }, packed(std::vector<int>{ 9 }));
  file.finish();
}

TEST(SectionFile, ReturnsEachSection)
{
  const TemporaryFolder folder;
  writeSections(folder.path("file"));
  const SectionFile file(folder.path("file"));
  EXPECT_TRUE(file.has({ 2, 1 }));
  EXPECT_FALSE(file.has({ 2, 3 }));
  const Bytes bytes = file.read({ 2, 1 });
  EXPECT_EQ((std::vector<int>{ 7, 8 }), unpacked<std::vector<int>>(bytes));
  expectIOError(folder.path("file"), "is damaged", [&] { file.read({ 1, 1 }); });
}

TEST(SectionFile, AppearsOnlyWhenComplete)
{
  const TemporaryFolder folder;
  SectionFileWriter file(folder.path("file"));
  file.add({ 0, 0 }, packed(std::vector<int>{ 1 }));
  EXPECT_FALSE(fs::exists(folder.path("file")));
  file.finish();
  EXPECT_TRUE(fs::exists(folder.path("file")));
  EXPECT_EQ(1U, folder.fileCount());
}

TEST(SectionFile, IsRefusedIfAnyByteIsDamaged)
{
  const TemporaryFolder folder;
  const std::string path = folder.path("file");
  writeSections(path);
  const std::string content = contentOf(path);
  const auto verify = [&] { SectionFile(path).verify(); };
  for (std::size_t at = 0; at < content.size(); ++at)
  {
    std::string damaged = content;
    damaged[at] ^= 1;
    folder.file("file", damaged);
    EXPECT_THROW(verify(), IOError) << at;
    folder.file("file", content.substr(0, at));
    EXPECT_THROW(verify(), IOError) << at;
  }
  folder.file("file", content);
  verify();
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
  EXPECT_EQ(-3, survey.Bounds.Min.x);
  EXPECT_EQ(17, survey.Bounds.Max.y);
  EXPECT_EQ(2, survey.dimension());
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
      ASSERT_TRUE(survey.Sample[i].Position == (Point2{ xy[2 * id], xy[2 * id + 1] }));
    }
  }
}

TEST(InputSurvey, DetectsPointsOnOneLine)
{
  Coordinates xy;
  for (int i = 0; i < 3000; ++i)
  {
    xy.insert(xy.end(), { double(i), 2.0 * i });
  }
  EXPECT_EQ(1, Steps(xy).Survey.dimension());
  xy.back() = 1;
  EXPECT_EQ(2, Steps(xy).Survey.dimension());
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
  EXPECT_LT(survey.Bounds.Max.x, 1e150);
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

TEST(PiecePlan, PredictsALargeBoundary)
{
  Steps circle(makePointSet("circle", 4000));
  EXPECT_TRUE(circle.plan().IsAlone);
  EXPECT_FALSE(circle.plan().HasLargeInterface);
  circle.Options.MemoryLimit = 1;
  EXPECT_FALSE(circle.plan().IsAlone);
  EXPECT_TRUE(circle.plan().HasLargeInterface);
  Steps uniform(makePointSet("uniform", 4000));
  uniform.Options.MemoryLimit = 1;
  EXPECT_FALSE(uniform.plan().HasLargeInterface);
}

TEST(PiecePlan, IsRestoredFromAnArchive)
{
  const Coordinates xy = makePointSet("clustered", 4000);
  const PiecePlan plan = Steps(xy).plan();
  SaveArchive out;
  plan.save(out);
  const Bytes bytes = out.take();
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

TEST(SpilledPoints, RefuseAnInputThatHasChanged)
{
  const Coordinates xy = makePointSet("uniform", 4000);
  Steps steps(xy);
  const PiecePlan plan = steps.plan();
  const InitialPoint& last = plan.Initial.back();
  for (const double changed : { std::nan(""), last.Position.x < 0.5 ? 0.9 : 0.1 })
  {
    Coordinates others = xy;
    others[2 * std::size_t(last.Id)] = changed;
    Steps after(others);
    PiecePlan before = plan;
    expectIOError("The input has changed", "start again", [&] { after.spill(before); });
  }
}

TEST(SpilledPoints, ClosesFilesThatOthersRead)
{
  Steps steps(makePointSet("uniform", 4000));
  PiecePlan plan = steps.plan();
  const SpilledPoints spilled = steps.spill(plan);
  ASSERT_TRUE(fs::exists(steps.Folder.path("spill.0")));
  for (const fs::directory_entry& open : fs::directory_iterator("/proc/self/fd"))
  {
    std::error_code gone; // an entry may disappear while the folder is listed
    EXPECT_NE(fs::path(steps.Folder.path("spill.0")), fs::read_symlink(open.path(), gone));
  }
}

TEST(SpilledPoints, OfOtherPiecesAreRefused)
{
  Steps steps(makePointSet("uniform", 4000));
  PiecePlan plan = steps.plan();
  const SpilledPoints spilled = steps.spill(plan);
  SaveArchive out;
  spilled.save(out);
  for (const PartitionIndex pieces : { plan.pieces() - 1, plan.pieces() + 1 })
  {
    LoadArchive in(out.data(), out.size());
    expectIOError(steps.Folder.path("spill"), "other pieces",
      [&] { SpilledPoints(steps.Folder.path("spill"), steps.Rows.Words, pieces, in); });
  }
}

TEST(SpilledPoints, AreRefusedPerPieceIfDamaged)
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
  const Bytes bytes = out.take();
  LoadArchive in(bytes);
  const SpilledPoints back(file.substr(0, file.size() - 2), steps.Rows.Words, plan.pieces(), in);
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

} // namespace
