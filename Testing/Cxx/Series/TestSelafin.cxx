// SPDX-License-Identifier: BSD-3-Clause
#include "ExpectIOError.h"
#include "SelafinText.h"
#include "Series/MeshSeries.h"
#include "SharedData.h"
#include "TemporaryFolder.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <numeric>
#include <string>
#include <vector>

namespace
{

using namespace tipp;
using namespace tipp::test;
using Doubles = std::vector<double>;
using Ids = std::vector<std::int64_t>;

class Selafin : public testing::Test
{
protected:
  std::string file(const SelafinText& text) const
  {
    return this->Folder.file("a.slf", text.text());
  }
  TemporaryFolder Folder;
};

TEST_F(Selafin, IsReadInBothPrecisionsAndByteOrders)
{
  for (const bool isBig : { true, false })
  {
    for (const bool isDouble : { false, true })
    {
      SelafinText text;
      text.IsBig = isBig;
      text.IsDouble = isDouble;
      const auto series = openMeshSeries(this->file(text));
      const SeriesMesh mesh = series->readMesh();
      EXPECT_EQ(
        (Doubles{ 1000, 2000, 1001, 2000, 1001, 2001, 1000, 2001 }), mesh.XY); // with the origin
      EXPECT_EQ((Ids{ 0, 1, 2, 0, 2, 3 }), mesh.Triangles);
      EXPECT_EQ((Doubles{ 0, 60 }), series->Times);
      EXPECT_EQ("seconds since 2008-09-01 06:30:00", series->TimeUnits);
      ASSERT_EQ(2U, series->Variables.size());
      EXPECT_EQ("WATER DEPTH", series->Variables[0].Name);
      EXPECT_EQ("M/S", series->Variables[1].Units);
      EXPECT_EQ(isDouble ? Scalar::Float64 : Scalar::Float32, series->Variables[0].Type);
      Doubles values;
      series->read(1, 1, values);
      EXPECT_EQ((Doubles{ 5, 6, 7, 68 }), values);
      series->read(0, 0, values);
      EXPECT_EQ((Doubles{ 1, 2, 3, 4 }), values);
    }
  }
}

TEST_F(Selafin, QuadrilateralsAreCut)
{
  SelafinText text;
  text.HasQuadrilaterals = true;
  text.HasDate = false;
  const auto series = openMeshSeries(this->file(text));
  EXPECT_EQ((Ids{ 0, 0 }), series->readMesh().OriginalCells);
  EXPECT_EQ("seconds", series->TimeUnits);
}

TEST_F(Selafin, MeshesInSpaceAreRefused)
{
  SelafinText text;
  text.Planes = 5;
  const std::string path = this->file(text);
  expectIOError(path, "5 planes", [&] { openMeshSeries(path); });
}

TEST_F(Selafin, AStepThatIsNotCompleteIsLeftOutAndNamed)
{
  const std::string whole = SelafinText().text();
  const std::string path = this->Folder.file("a.slf", whole.substr(0, whole.size() - 5));
  const auto series = openMeshSeries(path);
  EXPECT_EQ((Doubles{ 0 }), series->Times);
  ASSERT_EQ(1U, series->LeftOut.size());
  EXPECT_EQ("step 1", series->LeftOut[0].Name);
}

TEST_F(Selafin, TimesThatDoNotAscendAreRefused)
{
  SelafinText text;
  text.Times = { 60, 60 };
  const std::string path = this->file(text);
  expectIOError(path, "do not ascend", [&] { openMeshSeries(path); });
}

TEST_F(Selafin, DamageAtAnyByteEndsInASentence)
{
  const std::string whole = SelafinText().text();
  for (std::size_t i = 0; i < whole.size(); ++i)
  {
    std::string mutant = whole;
    mutant[i] = char(mutant[i] ^ 0x41);
    for (const std::string& text : { mutant, whole.substr(0, i) })
    {
      const std::string path = this->Folder.file("a.slf", text);
      try
      {
        const auto series = openMeshSeries(path);
        Doubles values;
        for (std::size_t v = 0; v < series->Variables.size(); ++v)
        {
          series->read(v, 0, values);
          EXPECT_EQ(4U, values.size());
        }
      }
      catch (const IOError& error)
      {
        EXPECT_EQ('.', std::string(error.what()).back()) << error.what();
      }
    }
  }
}

TEST_F(Selafin, ARealFileHasItsValues)
{
  TIPP_REQUIRE_DATA(path, "meshes/example.slf");
  const auto series = openMeshSeries(path);
  const SeriesMesh mesh = series->readMesh();
  EXPECT_EQ(13541, series->Nodes);
  ASSERT_EQ(3U * 26000, mesh.Triangles.size());
  // Computed by NumPy from the file's bytes.
  EXPECT_EQ(
    561138436, std::accumulate(mesh.Triangles.begin(), mesh.Triangles.end(), std::int64_t(0)));
  Doubles values;
  series->read(findSeriesVariable(*series, "BOTTOM"), 0, values);
  EXPECT_NEAR(559155.2236093974, std::accumulate(values.begin(), values.end(), 0.0), 1e-6);
  EXPECT_EQ(100, values.at(100));
}

} // namespace
