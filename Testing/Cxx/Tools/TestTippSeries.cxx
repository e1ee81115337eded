// SPDX-License-Identifier: BSD-3-Clause
// The output of models, which flatten and info read.
#include "RunTipp.h"
#include "SelafinText.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace
{

using namespace tipp::test;

using Words = std::vector<std::string>;

class TippSeries : public testing::Test
{
protected:
  Outcome run(const Words& words, int code = 0) const
  {
    Outcome outcome = runTipp(this->Folder, words);
    EXPECT_EQ(code, outcome.ExitCode) << outcome.Err;
    return outcome;
  }
  static void expectIn(const std::string& text, const std::string& words)
  {
    EXPECT_NE(std::string::npos, text.find(words)) << text;
  }

  TemporaryFolder Folder;
};

TEST_F(TippSeries, InfoListsTheMeshVariablesAndSteps)
{
  this->Folder.file("a.slf", SelafinText().text());
  const std::string out = this->run({ "info", "a.slf" }).Out;
  expectIn(out, "a.slf: SELAFIN, 4 nodes");
  expectIn(out, "triangles   2\n");
  expectIn(out, "x           1000 to 1001\n");
  expectIn(out, "steps       2, 0 to 60 seconds since 2008-09-01 06:30:00\n");
  expectIn(out, "WATER DEPTH at nodes, varies, in M\n");
}

TEST_F(TippSeries, FlattenWritesEachStep)
{
  this->Folder.file("a.slf", SelafinText().text());
  expectIn(this->run({ "flatten", "a.slf", "-o", "flat" }).Out,
    "2 triangles, 4 points, 2 arrays, 2 steps in flat");
  EXPECT_NE("", contentOf(this->Folder.path("flat/time.npy")));
  this->run({ "partition", "flat", "-o", "mesh.tipp", "--tiling", "grid:1x1" });
}

TEST_F(TippSeries, FlattenWarnsOfWhatIsLeftOut)
{
  const std::string whole = SelafinText().text();
  this->Folder.file("a.slf", whole.substr(0, whole.size() - 1));
  const Outcome outcome = this->run({ "flatten", "a.slf", "-o", "flat" });
  expectIn(outcome.Err, "a.slf: step 1 is not complete");
  expectIn(outcome.Out, "1 steps");
}

TEST_F(TippSeries, FlattenReadsDatasetsOfQuadrilaterals)
{
  this->Folder.file(
    "a.2dm", "MESH2D\nE4Q 1 1 2 3 4 1\nND 1 0 0 0\nND 2 1 0 0\nND 3 1 1 0\nND 4 0 1 0\n");
  this->Folder.file("a.dat", "BEGSCL\nND 4\nNC 1\nNAME \"h\"\nTS 0 1\n1\n2\n3\n4\nENDDS\n");
  expectIn(this->run({ "flatten", "a.2dm", "-o", "flat", "--values", "a.dat" }).Out,
    "2 triangles, 4 points, 4 arrays");
  EXPECT_NE("", contentOf(this->Folder.path("flat/cell_data/OriginalCellId.npy")));
  EXPECT_NE("", contentOf(this->Folder.path("flat/point_data/h.npy")));
}

TEST_F(TippSeries, WrapShowsCellsOnBothSidesOfTheMeridian)
{
  this->Folder.file("fort.14", "title\n1 3\n1 178 0 1\n2 -179 0 2\n3 178 5 3\n1 3 1 2 3\n");
  expectIn(this->run({ "flatten", "fort.14", "-o", "flat", "--wrap" }).Out,
    "2 triangles, 6 points, 2 arrays");
}

TEST_F(TippSeries, ValuesAndWrapNeedTheMeshOfAModel)
{
  this->Folder.file("a.vtu", "");
  this->Folder.file("a.node", "1 2 0 0\n1 0 0\n");
  expectIn(this->run({ "flatten", "a.vtu", "-o", "flat", "--wrap" }, 2).Err, "--values and --wrap");
  this->Folder.file("a.ele", "0 3 0\n");
  expectIn(this->run({ "flatten", "a.node", "-o", "flat", "--values", "a.vtu" }, 1).Err,
    "leave out --values");
}

} // namespace
