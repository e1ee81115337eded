// SPDX-License-Identifier: BSD-3-Clause
#include "Meshes/MeshFiles.h"
#include "Npy/NpyFile.h"
#include "OpenCL/Devices.h"
#include "Points/ReadPoints.h"
#include "RunTipp.h"

#include "Distributions/GeneratePoints.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <ostream>
#include <set>

#include <sys/stat.h>
#include <unistd.h>

namespace
{

using tipp::test::Outcome;
using tipp::test::TippProcess;
using Words = std::vector<std::string>;

class Tipp : public testing::Test
{
protected:
  Outcome run(const Words& words) const { return tipp::test::runTipp(this->Folder, words); }

  std::string path(const std::string& name) const { return this->Folder.path(name); }
  bool exists(const std::string& name) const { return std::filesystem::exists(this->path(name)); }

  void writePoints(tipp::Distribution distribution = tipp::Distribution::Uniform) const
  {
    tipp::writePoints(this->path("points.npy"), tipp::generatePoints(distribution, 2000, 9));
  }

  // The triangles of a file, each starting with its lowest id.
  std::set<std::array<std::int64_t, 3>> triangles(const std::string& name) const
  {
    const std::vector<std::int64_t> ids = tipp::readMesh(this->path(name)).Triangles;
    std::set<std::array<std::int64_t, 3>> set;
    for (std::size_t i = 0; i < ids.size(); i += 3)
    {
      std::array<std::int64_t, 3> triangle{ ids[i], ids[i + 1], ids[i + 2] };
      std::rotate(
        triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
      set.insert(triangle);
    }
    return set;
  }

  const tipp::test::TemporaryFolder Folder;
};

// Expects one sentence with `words` on stderr, and nothing on stdout.
void expectSentence(const Outcome& outcome, int exitCode, const std::string& words)
{
  EXPECT_EQ(exitCode, outcome.ExitCode);
  EXPECT_EQ("", outcome.Out);
  EXPECT_NE(std::string::npos, outcome.Err.find(words)) << outcome.Err;
  EXPECT_EQ(outcome.Err.size() - 1, outcome.Err.find('\n')) << outcome.Err;
  EXPECT_EQ('.', outcome.Err[outcome.Err.size() - 2]) << outcome.Err;
}

struct Misuse
{
  const char* Name;
  Words Arguments;
  const char* Answer;
};

// CTest shows this name for the test.
std::ostream& operator<<(std::ostream& stream, const Misuse& misuse)
{
  return stream << misuse.Name;
}

class TippMisuse
  : public Tipp
  , public testing::WithParamInterface<Misuse>
{
};

const Misuse misuses[] = {
  { "NoCommand", {}, "a command is required" },
  { "UnknownCommand", { "triangulate", "--fast" }, "no command 'triangulate'" },
  { "UnknownOption", { "delaunay", "points.npy", "-o", "a.npy", "--fast" }, "--fast" },
  { "NoInput", { "delaunay", "-o", "a.npy" }, "input" },
  { "NoOutput", { "delaunay", "points.npy" }, "--output" },
  { "PartitionsOfMasters",
    { "delaunay", "points.npy", "-o", "a.npy", "--partitions", "4x4", "--masters", "multi" },
    "--partitions" },
  { "OutputOfUnknownKind", { "delaunay", "points.npy", "-o", "a.stl" }, "'a.stl' does not end" },
  { "PartitionsOfNoGrid", { "delaunay", "points.npy", "-o", "a.npy", "--partitions", "4" }, "8x8" },
  { "PartitionsOfZero", { "delaunay", "points.npy", "-o", "a.npy", "--partitions", "0x4" },
    "'0x4' is neither" },
  { "PartitionsBeyondInt",
    { "delaunay", "points.npy", "-o", "a.npy", "--partitions", "99999999999x1" }, "is neither" },
  { "UnknownSchedule", { "delaunay", "points.npy", "-o", "a.npy", "--schedule", "eager" },
    "eager" },
  { "NegativeThreads", { "delaunay", "points.npy", "-o", "a.npy", "--threads", "-1" },
    "--threads" },
  { "WordyInitialPoints", { "delaunay", "points.npy", "-o", "a.npy", "--initial-points", "few" },
    "few" },
  { "MapOfDuplicatesInNpy", { "delaunay", "points.npy", "-o", "a.npy", "--map-duplicates" },
    ".vtp or .vtu" },
  { "UnknownDistribution", { "points", "--distribution", "flat", "--count", "1", "-o", "a.npy" },
    "flat" },
  { "NegativeCount", { "points", "--distribution", "coast", "--count", "-1", "-o", "a.npy" },
    "--count" },
  { "NegativeSeed",
    { "points", "--distribution", "coast", "--count", "1", "--seed", "-1", "-o", "a.npy" },
    "--seed: '-1' is not a whole number from 0 to 18446744073709551615; see" },
  { "SeedBeyond64Bits",
    { "points", "--distribution", "coast", "--count", "1", "--seed", "18446744073709551616", "-o",
      "a.npy" },
    "is not a whole number from 0 to 18446744073709551615" },
  { "MemoryOfOneByte", { "delaunay", "points.npy", "-o", "a.tipp", "--memory", "1" },
    "--memory: '1' is too little: give 1M or more; see" },
  { "MemoryBelowTheSmallest", { "delaunay3d", "points.npy", "-o", "a.tipp", "--memory", "1023K" },
    "give 1M or more" },
  { "PointsNotInNpy", { "points", "--distribution", "coast", "--count", "1", "-o", "a.csv" },
    "'a.csv' does not end in .npy, .las or .laz" },
  { "CheckOfPointsAlone", { "check", "points.npy" }, "mesh" },
};

class TippFailure
  : public Tipp
  , public testing::WithParamInterface<Misuse>
{
};

const Misuse failures[] = {
  { "MissingInput", { "delaunay", "absent.npy", "-o", "out.npy" }, "absent.npy: cannot be opened" },
  { "InputOfUnknownKind", { "delaunay", "absent.abc", "-o", "out.npy" }, "absent.abc: has no ext" },
  { "BrokenVtkFile", { "delaunay", "broken.vtp", "-o", "out.npy" }, "syntax error" },
  { "BrokenLegacyFile", { "delaunay", "broken.vtk", "-o", "out.npy" }, "Unrecognized file type" },
  { "BrokenPlyFile", { "delaunay", "broken.ply", "-o", "out.npy" }, "PLY" },
  { "MissingOutputFolder", { "delaunay", "points.npy", "-o", "absent/out.npy" }, "its folder" },
  { "MissingStatisticsFolder",
    { "delaunay", "points.npy", "-o", "out.npy", "--stats", "absent/s.json" }, "its folder" },
  { "MissingColumn", { "delaunay", "points.npy", "-o", "out.npy", "--x", "east" },
    "no column 'east'" },
  { "GeneratedIntoNoFolder",
    { "points", "--distribution", "coast", "--count", "1", "-o", "absent/a.npy" }, "its folder" },
  { "CheckOfMissingMesh", { "check", "points.npy", "absent.npy" }, "absent.npy: cannot be opened" },
};

class TippTuning
  : public Tipp
  , public testing::WithParamInterface<Words>
{
};

} // namespace

TEST_F(Tipp, VersionIsPrinted)
{
  const Outcome outcome = this->run({ "--version" });
  EXPECT_EQ(0, outcome.ExitCode);
  EXPECT_EQ("tipp " TIPP_VERSION "\n", outcome.Out);
}

TEST_F(Tipp, HelpNamesEveryCommand)
{
  const Outcome outcome = this->run({ "--help" });
  EXPECT_EQ(0, outcome.ExitCode);
  for (const char* command :
    { "delaunay", "devices", "flatten", "points", "resample", "partition", "check" })
  {
    EXPECT_NE(std::string::npos, outcome.Out.find(command)) << command;
  }
}

TEST_F(Tipp, DevicesAreListedByIndexAndName)
{
  const Outcome outcome = this->run({ "devices" });
  EXPECT_EQ(0, outcome.ExitCode) << outcome.Err;
  for (const tipp::DeviceDescription& device : tipp::listDevices())
  {
    const std::string line = "\n" + std::to_string(device.Index) + "  ";
    const std::size_t begin = ("\n" + outcome.Out).find(line);
    ASSERT_NE(std::string::npos, begin) << outcome.Out;
    EXPECT_NE(std::string::npos, outcome.Out.find(device.Name, begin)) << outcome.Out;
  }
  EXPECT_FALSE(outcome.Out.empty());
}

TEST_F(Tipp, HelpOfACommandNamesItsOptionsAndAnExample)
{
  const std::pair<const char*, Words> commands[] = {
    { "delaunay",
      { "--output", "--threads", "--partitions", "--schedule", "--initial-points", "--x", "--y",
        "--map-duplicates", "--stats", "Examples:" } },
    { "points",
      { "--distribution", "--count", "--seed", "--output", "--class", "--scale", "Examples:" } },
    { "check", { "--x", "--y", "--tie-rule", "--boundary-free", "Examples:" } },
  };
  for (const auto& [command, options] : commands)
  {
    const Outcome outcome = this->run({ command, "--help" });
    EXPECT_EQ(0, outcome.ExitCode);
    for (const std::string& option : options)
    {
      EXPECT_NE(std::string::npos, outcome.Out.find(option)) << command << " " << option;
    }
  }
}

TEST_P(TippMisuse, IsOneSentenceAndExitCode2)
{
  this->writePoints();
  expectSentence(this->run(GetParam().Arguments), 2, GetParam().Answer);
  EXPECT_FALSE(this->exists("a.npy"));
}

INSTANTIATE_TEST_SUITE_P(Tools, TippMisuse, testing::ValuesIn(misuses),
  [](const auto& info) { return std::string(info.param.Name); });

TEST_P(TippFailure, IsOneSentenceAndExitCode1)
{
  this->writePoints();
  for (const char* name : { "broken.vtp", "broken.vtk", "broken.ply" })
  {
    this->Folder.file(name, "garbage\n");
  }
  expectSentence(this->run(GetParam().Arguments), 1, GetParam().Answer);
  EXPECT_FALSE(this->exists("out.npy"));
}

INSTANTIATE_TEST_SUITE_P(Tools, TippFailure, testing::ValuesIn(failures),
  [](const auto& info) { return std::string(info.param.Name); });

TEST_F(Tipp, PointsAreThoseOfTheDistribution)
{
  const Outcome outcome = this->run(
    { "points", "--distribution", "kuzmin", "--count", "1000", "--seed", "5", "-o", "p.npy" });
  EXPECT_EQ(0, outcome.ExitCode) << outcome.Err;
  EXPECT_EQ(tipp::generatePoints(tipp::Distribution::Kuzmin, 1000, 5),
    tipp::readPoints(this->path("p.npy")).XY);
}

TEST_F(Tipp, SummaryIsOneLineOfAllFigures)
{
  this->Folder.file("points.csv", "x,y\n0,0\n1,0\n0,1\n1,2\n1,0\nnan,1\n");
  const Outcome outcome = this->run({ "delaunay", "points.csv", "-o", "out.npy" });
  EXPECT_EQ(0, outcome.ExitCode) << outcome.Err;
  EXPECT_EQ("", outcome.Err);
  EXPECT_EQ(0U, outcome.Out.find("6 points, 2 triangles, 1 duplicates, 1 rejected, "))
    << outcome.Out;
  for (const char* figure : { " s, ", " points/s, ", "peak memory ", " MB\n" })
  {
    EXPECT_NE(std::string::npos, outcome.Out.find(figure)) << outcome.Out;
  }
  EXPECT_EQ(outcome.Out.size() - 1, outcome.Out.find('\n'));
}

TEST_F(Tipp, EveryOutputFormatPassesTheCheck)
{
  this->writePoints(tipp::Distribution::Lattice);
  for (const char* name : { "out.npy", "out.vtp", "out.vtu" })
  {
    EXPECT_EQ(0, this->run({ "delaunay", "points.npy", "-o", name }).ExitCode) << name;
    const Outcome outcome = this->run({ "check", "points.npy", name, "--tie-rule" });
    EXPECT_EQ(0, outcome.ExitCode) << outcome.Out;
    EXPECT_NE(std::string::npos, outcome.Out.find("2000 points (2000 distinct)")) << outcome.Out;
    EXPECT_NE(std::string::npos, outcome.Out.find(": correct")) << outcome.Out;
  }
}

TEST_P(TippTuning, DoesNotChangeTheTriangles)
{
  this->writePoints(tipp::Distribution::Clustered);
  Words words{ "delaunay", "points.npy", "-o", "tuned.npy" };
  words.insert(words.end(), GetParam().begin(), GetParam().end());
  ASSERT_EQ(0, this->run({ "delaunay", "points.npy", "-o", "plain.npy" }).ExitCode);
  const Outcome outcome = this->run(words);
  ASSERT_EQ(0, outcome.ExitCode) << outcome.Err;
  EXPECT_EQ(this->triangles("plain.npy"), this->triangles("tuned.npy"));
}

INSTANTIATE_TEST_SUITE_P(Tools, TippTuning,
  testing::Values(Words{ "--threads", "1" }, Words{ "--threads", "3" },
    Words{ "--partitions", "auto" }, Words{ "--partitions", "3x2" },
    Words{ "--schedule", "stages" }, Words{ "--schedule", "dynamic", "--partitions", "4x4" },
    Words{ "--initial-points", "5" }));

TEST_F(Tipp, ColumnsAreChosen)
{
  this->Folder.file("points.csv", "id,n,e\n1,0,0\n2,0,5\n3,5,0\n");
  ASSERT_EQ(
    0, this->run({ "delaunay", "points.csv", "-o", "o.vtp", "--x", "e", "--y", "1" }).ExitCode);
  EXPECT_EQ((std::vector<double>{ 0, 0, 5, 0, 0, 5 }), tipp::readMesh(this->path("o.vtp")).XY);
  EXPECT_EQ(0, this->run({ "check", "points.csv", "o.vtp", "--x", "e", "--y", "n" }).ExitCode);
}

TEST_F(Tipp, StatisticsAreJson)
{
  this->Folder.file("points.csv", "0 0\n1 0\n0 1\n1 2\n1 0\nnan 1\n");
  ASSERT_EQ(
    0, this->run({ "delaunay", "points.csv", "-o", "o.npy", "--stats", "s.json" }).ExitCode);
  const auto json = nlohmann::json::parse(tipp::test::contentOf(this->path("s.json")));
  EXPECT_EQ("points.csv", json.at("input"));
  EXPECT_EQ("o.npy", json.at("output"));
  EXPECT_EQ(6, json.at("points"));
  EXPECT_EQ(2, json.at("triangles"));
  EXPECT_EQ(1, json.at("duplicates"));
  EXPECT_EQ(1, json.at("rejected"));
  EXPECT_GE(json.at("partitions"), 1);
  EXPECT_GE(json.at("threads"), 1);
  EXPECT_GT(json.at("triangulate_seconds"), 0);
  EXPECT_GT(json.at("peak_memory_bytes"), 1000000);
  EXPECT_TRUE(json.at("phases").is_array());
  EXPECT_TRUE(json.at("stages").is_array());
  for (const char* key :
    { "read_seconds", "write_seconds", "points_per_second", "initial_points", "worker_vertices" })
  {
    EXPECT_GE(json.at(key), 0) << key;
  }
}

TEST_F(Tipp, DuplicatesAreMapped)
{
  this->Folder.file("points.csv", "0 0\n1 0\n0 1\n1 0\nnan 1\n");
  ASSERT_EQ(0, this->run({ "delaunay", "points.csv", "-o", "o.vtu", "--map-duplicates" }).ExitCode);
  const tipp::PointTable points = tipp::readPoints(this->path("o.vtu"));
  ASSERT_EQ(2U, points.Columns.size());
  EXPECT_EQ("RepresentativePointId", points.Columns[1].Name);
  EXPECT_EQ((std::vector<double>{ 0, 1, 2, 1, -1 }), points.Columns[1].Values);
}

TEST_F(Tipp, WarnsThatAllTrianglesHaveLongEdges)
{
  this->Folder.file("points.csv", "x,y\n0,0\n4,0\n0,3\n");
  const Outcome outcome =
    this->run({ "delaunay", "points.csv", "-o", "none.npy", "--max-edge", "2" });
  EXPECT_EQ(0, outcome.ExitCode);
  EXPECT_NE(std::string::npos,
    outcome.Err.find(
      "no triangles, because each triangle has an edge longer than the 2 of --max-edge"))
    << outcome.Err;
}

TEST_F(Tipp, CollinearPointsWarnAndGiveNoTriangles)
{
  this->Folder.file("points.csv", "0 0\n1 1\n2 2\n");
  const Outcome outcome = this->run({ "delaunay", "points.csv", "-o", "o.npy" });
  EXPECT_EQ(0, outcome.ExitCode);
  EXPECT_NE(std::string::npos, outcome.Err.find("warning: no triangles"));
  EXPECT_TRUE(this->triangles("o.npy").empty());
  EXPECT_EQ(0, this->run({ "check", "points.csv", "o.npy" }).ExitCode);
}

TEST_F(Tipp, CheckFindsFaultsWithExitCode1)
{
  this->Folder.file("square.csv", "0 0\n1 0\n0 1\n1 1\n");
  this->Folder.file(
    "clockwise.14", "t\n2 4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 1 1 0\n1 3 1 3 2\n2 3 2 4 3\n");
  const Outcome outcome = this->run({ "check", "square.csv", "clockwise.14" });
  EXPECT_EQ(1, outcome.ExitCode);
  EXPECT_NE(std::string::npos, outcome.Out.find("FAULTY\n")) << outcome.Out;
  EXPECT_NE(std::string::npos, outcome.Out.find("1 triangles are clockwise or flat"))
    << outcome.Out;
}

TEST_F(Tipp, CheckAsksForTheTieRuleOnlyOnRequest)
{
  this->Folder.file("tie.14", "t\n2 4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 1 1 0\n1 3 1 2 4\n2 3 1 4 3\n");
  EXPECT_EQ(0, this->run({ "check", "tie.14", "tie.14" }).ExitCode);
  EXPECT_EQ(1, this->run({ "check", "tie.14", "tie.14", "--tie-rule" }).ExitCode);
}

TEST_F(Tipp, CheckAllowsAnyBoundaryOnRequest)
{
  this->Folder.file(
    "bent.14", "t\n2 4\n1 0 0 0\n2 2 0 0\n3 0.1 0.2 0\n4 0 2 0\n1 3 1 2 3\n2 3 1 3 4\n");
  EXPECT_EQ(1, this->run({ "check", "bent.14", "bent.14" }).ExitCode);
  EXPECT_EQ(0, this->run({ "check", "bent.14", "bent.14", "--boundary-free" }).ExitCode);
}

TEST_F(Tipp, CheckRefusesAMeshOfOtherPoints)
{
  this->writePoints();
  ASSERT_EQ(0, this->run({ "delaunay", "points.npy", "-o", "o.vtp" }).ExitCode);
  tipp::writePoints(
    this->path("others.npy"), tipp::generatePoints(tipp::Distribution::Coast, 2000, 9));
  expectSentence(this->run({ "check", "others.npy", "o.vtp" }), 1, "are not the 2000 points of");
}

TEST_F(Tipp, InterruptEndsTheRunWithoutAnOutput)
{
  // The tool waits for input from a pipe, into which nothing is written.
  const std::string pipe = this->path("points.csv");
  ASSERT_EQ(0, mkfifo(pipe.c_str(), 0600));
  const TippProcess process(
    this->Folder, { "delaunay", "points.csv", "-o", "o.vtp", "--stats", "s.json" });
  std::ofstream input(pipe);
  process.interrupt();
  const Outcome outcome = process.waitOrKill();
  expectSentence(outcome, 130, "interrupted");
  EXPECT_FALSE(this->exists("o.vtp"));
  EXPECT_FALSE(this->exists("s.json"));
  EXPECT_EQ(3U, this->Folder.fileCount()); // the pipe, .out and .err
}

TEST_F(Tipp, ProgressIsShownOnATerminalOnly)
{
  this->writePoints();
  const Words words{ "delaunay", "points.npy", "-o", "o.npy" };
  const Outcome outcome = tipp::test::runTippOnTerminal(this->Folder, words);
  EXPECT_EQ(0, outcome.ExitCode);
  EXPECT_NE(std::string::npos, outcome.Err.find("Triangulating [")) << outcome.Err;
  EXPECT_EQ("", this->run(words).Err);
}
