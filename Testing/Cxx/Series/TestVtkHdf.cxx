// SPDX-License-Identifier: BSD-3-Clause
#include "ExpectIOError.h"
#include "NetcdfWriter.h"
#include "Series/MeshSeries.h"
#include "TemporaryFolder.h"
#include "Vtk/DataSets.h"

#include "vtkCell.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

namespace
{

using namespace tipp;
using namespace tipp::test;
using Ids = std::vector<std::int64_t>;
using Doubles = std::vector<double>;

/// What is written into a file: two parts, a square of a pixel, and a triangle with a ghost of
/// another one.
struct Content
{
  Doubles PointCounts{ 4, 4 };
  Doubles CellCounts{ 1, 2 };
  Doubles IdCounts{ 4, 6 };
  Doubles Points{ 0, 0, 5, 1, 0, 5, 0, 1, 5, 1, 1, 5, //
    1, 0, 7, 2, 0, 7, 2, 1, 7, 1, 1, 7 };
  Doubles Ids{ 0, 1, 2, 3, 0, 1, 2, 0, 2, 3 };
  Doubles Offsets{ 0, 4, 0, 3, 6 };
  Doubles Types{ 8, 5, 5 };
  Doubles Ghosts{ 0, 0, 1 };
  Doubles Level{ 0, 1, 2, 3, 4, 5, 6, 7 };
};

/// Offsets of steps; empty: the file has none.
struct Steps
{
  Doubles Times;
  Doubles Parts;
  Doubles Points;
  Doubles Cells;
  Doubles Ids;
  Doubles Level;
  Doubles PartCounts;
};

class VtkHdf : public testing::Test
{
protected:
  void write(const Content& content, const Steps& steps = {},
    const std::string& type = "UnstructuredGrid") const
  {
    NetcdfWriter w(this->Path);
    w.group("VTKHDF");
    const int root = w.file();
    w.text(NC_GLOBAL, "Type", type);
    w.number(NC_GLOBAL, "Version", NC_INT64, { 2, 1 });
    const auto put = [&w](const std::string& name, nc_type numbers, const Doubles& values)
    { w.put(w.variable(name, numbers, { w.dimension("of" + name, values.size()) }), values); };
    put("NumberOfPoints", NC_INT64, content.PointCounts);
    put("NumberOfCells", NC_INT64, content.CellCounts);
    put("NumberOfConnectivityIds", NC_INT64, content.IdCounts);
    put("Connectivity", NC_INT64, content.Ids);
    put("Offsets", NC_INT64, content.Offsets);
    put("Types", NC_UBYTE, content.Types);
    const std::vector<int> vectors{ w.dimension("points", content.Points.size() / 3),
      w.dimension("three", 3) };
    w.put(w.variable("Points", NC_FLOAT, vectors), content.Points);
    w.group("PointData", root);
    put("level", NC_DOUBLE, content.Level);
    w.group("CellData", root);
    put("vtkGhostType", NC_UBYTE, content.Ghosts);
    if (!steps.Times.empty())
    {
      w.group("Steps", root);
      const int group = w.file();
      put("Values", NC_DOUBLE, steps.Times);
      put("PartOffsets", NC_INT64, steps.Parts);
      put("PointOffsets", NC_INT64, steps.Points);
      put("CellOffsets", NC_INT64, steps.Cells);
      put("ConnectivityIdOffsets", NC_INT64, steps.Ids);
      put("NumberOfParts", NC_INT64, steps.PartCounts);
      w.group("PointDataOffsets", group);
      put("level", NC_INT64, steps.Level);
      w.group("CellDataOffsets", group);
      put("vtkGhostType", NC_INT64, Doubles(steps.Times.size(), 0));
    }
    w.close();
  }

  /// Two steps of one mesh.
  static Steps twoSteps()
  {
    return { { 0, 60 }, { 0, 0 }, { 0, 0 }, { 0, 0 }, { 0, 0 }, { 0, 8 }, { 2, 2 } };
  }

  static Content ofTwoSteps()
  {
    Content content;
    content.Level.insert(content.Level.end(), { 10, 11, 12, 13, 14, 15, 16, 17 });
    return content;
  }

  TemporaryFolder Folder;
  const std::string Path = this->Folder.path("m.vtkhdf");
};

TEST_F(VtkHdf, GridsHaveThePointsAndCellsOfAllParts)
{
  this->write(Content());
  const vtkSmartPointer<vtkDataSet> data = readDataSet(this->Path);
  EXPECT_EQ(8, data->GetNumberOfPoints());
  ASSERT_EQ(3, data->GetNumberOfCells());
  EXPECT_EQ(8, data->GetCellType(0));
  EXPECT_EQ(7, data->GetCell(2)->GetPointId(2));
  EXPECT_EQ(7.0, data->GetPoint(7)[2]);
  EXPECT_EQ(6.0, data->GetPointData()->GetArray("level")->GetTuple1(6));
  EXPECT_EQ(1.0, data->GetCellData()->GetArray("vtkGhostType")->GetTuple1(2));
  EXPECT_FALSE(isMeshSeries(this->Path));
}

TEST_F(VtkHdf, StepsAreASeriesWithoutGhosts)
{
  this->write(ofTwoSteps(), twoSteps());
  ASSERT_TRUE(isMeshSeries(this->Path));
  const auto series = openMeshSeries(this->Path);
  EXPECT_EQ("VTKHDF", series->Kind);
  EXPECT_EQ((Doubles{ 0, 60 }), series->Times);
  const SeriesMesh mesh = series->readMesh();
  EXPECT_EQ((Ids{ 0, 0, 1 }), mesh.OriginalCells);
  ASSERT_EQ(9U, mesh.Triangles.size());
  EXPECT_EQ((Ids{ 4, 5, 6 }), Ids(mesh.Triangles.begin() + 6, mesh.Triangles.end()));
  Doubles values;
  series->read(findSeriesVariable(*series, "level"), 1, values);
  EXPECT_EQ((Doubles{ 10, 11, 12, 13, 14, 15, 16, 17 }), values);
  series->read(findSeriesVariable(*series, "elevation"), 1, values);
  EXPECT_EQ((Doubles{ 5, 5, 5, 5, 7, 7, 7, 7 }), values);
}

TEST_F(VtkHdf, StepsAreArraysOfOneDataSet)
{
  this->write(ofTwoSteps(), twoSteps());
  const vtkSmartPointer<vtkDataSet> data = readDataSet(this->Path);
  EXPECT_EQ(3, data->GetNumberOfCells());
  vtkPointData* const points = data->GetPointData();
  EXPECT_EQ(2, points->GetNumberOfArrays());
  EXPECT_EQ(6.0, points->GetArray("level step 0")->GetTuple1(6));
  EXPECT_EQ(16.0, points->GetArray("level step 1")->GetTuple1(6));
  EXPECT_EQ(1.0, data->GetCellData()->GetArray("vtkGhostType")->GetTuple1(2));
  EXPECT_EQ(2, readPointSet(this->Path)->GetNumberOfCells()) << "without the ghost cell";
}

TEST_F(VtkHdf, AnArrayWithTheSameValuesAtEachStepDoesNotVary)
{
  Steps steps = twoSteps();
  steps.Level = { 0, 0 };
  this->write(Content(), steps);
  const auto series = openMeshSeries(this->Path);
  EXPECT_FALSE(series->Variables[findSeriesVariable(*series, "level")].Varies);
  EXPECT_NE(nullptr, readPointSet(this->Path)->GetPointData()->GetArray("level"));
}

TEST_F(VtkHdf, StepsMayRepeatTheMesh)
{
  Content content = ofTwoSteps();
  const auto twice = [](Doubles& values)
  {
    const Doubles copy = values;
    values.insert(values.end(), copy.begin(), copy.end());
  };
  for (Doubles* values : { &content.PointCounts, &content.CellCounts, &content.IdCounts,
         &content.Points, &content.Ids, &content.Offsets, &content.Types })
  {
    twice(*values);
  }
  const Steps steps{ { 0, 60 }, { 0, 2 }, { 0, 8 }, { 0, 3 }, { 0, 10 }, { 0, 8 }, { 2, 2 } };
  this->write(content, steps);
  Doubles values;
  openMeshSeries(this->Path)->read(0, 1, values);
  EXPECT_EQ(17, values.at(7));

  content.Points.back() = 3;
  this->write(content, steps);
  const auto moving = openMeshSeries(this->Path);
  moving->read(0, 0, values);
  expectIOError(
    this->Path, "has other points or cells at step 1", [&] { moving->read(0, 1, values); });
}

TEST_F(VtkHdf, CountsAndIdsBeyondTheFileAreErrors)
{
  const auto expect = [this](const Content& content, const std::string& problem)
  {
    this->write(content);
    expectIOError(this->Path, problem, [this] { readDataSet(this->Path); });
  };
  Content content;
  content.PointCounts = { 4, 5 };
  expect(content, "tuples of 'Points'");
  content = {};
  content.CellCounts = { 1, 1e15 };
  expect(content, "has a count of");
  content = {};
  content.CellCounts = { -1, 2 };
  expect(content, "has a count of -1");
  content = {};
  content.Ids[5] = 4;
  expect(content, "has a cell at point 4 of a part of 4 points");
  content = {};
  content.Offsets[3] = 9;
  expect(content, "offsets do not ascend");
  content = {};
  content.PointCounts = { 8 };
  expect(content, "other numbers of parts");
  content = {};
  content.Types[1] = 42;
  expect(content, "has polyhedra");
  this->write({}, {}, "ImageData");
  expectIOError(
    this->Path, "a data set of the type 'ImageData'", [this] { readDataSet(this->Path); });
}

TEST_F(VtkHdf, StepsBeyondTheFileAreErrors)
{
  const auto expect = [this](const Steps& steps, const std::string& problem)
  {
    this->write(ofTwoSteps(), steps);
    Doubles values;
    expectIOError(this->Path, problem, [&] { openMeshSeries(this->Path)->read(0, 1, values); });
  };
  Steps steps = twoSteps();
  steps.Parts = { 0, 1 };
  expect(steps, "has step 1 (from 0) at parts that there are not");
  steps = twoSteps();
  steps.Level = { 0, 9 };
  expect(steps, "lacks the array 'level' at some of its 2 steps");
  steps = twoSteps();
  steps.Points = { 0 };
  expect(steps, "has 'PointOffsets' that are not integers of 2 steps");
  steps = twoSteps();
  steps.Times = { 60, 0 };
  expect(steps, "times that do not ascend");
}

TEST_F(VtkHdf, ArraysThatSomeStepsLackAreErrorsAtEveryStep)
{
  // vtkHDFWriter writes the first offsets if the array begins at the last step, the second if it
  // ends before that one.
  for (const Doubles& offsets : { Doubles{ 8 }, Doubles{ 0, 8 } })
  {
    Steps steps = twoSteps();
    steps.Level = offsets;
    this->write({}, steps);
    for (const std::int64_t step : { 0, 1 })
    {
      Doubles values;
      expectIOError(this->Path, "lacks the array 'level' at some of its 2 steps",
        [&] { openMeshSeries(this->Path)->read(0, step, values); });
    }
  }
}

TEST_F(VtkHdf, FilesOfAnotherKindAreNamed)
{
  this->Folder.file("m.vtkhdf", "# vtk DataFile Version 5.1");
  expectIOError(this->Path, "is not an HDF5 file", [this] { readDataSet(this->Path); });
  NetcdfWriter(this->Path).close();
  expectIOError(this->Path, "it has no group 'VTKHDF'", [this] { readDataSet(this->Path); });
}

} // namespace
