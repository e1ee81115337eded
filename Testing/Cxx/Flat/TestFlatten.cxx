// SPDX-License-Identifier: BSD-3-Clause
#include "Adcirc/AdcircGrid.h"
#include "ExpectIOError.h"
#include "Flat/FlatMesh.h"
#include "Flat/FlattenDataSet.h"
#include "FlatTesting.h"
#include "FlattenedSeries.h"
#include "SharedData.h"
#include "Vtk/DataSets.h"

#include "vtkBitArray.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkStringArray.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>

namespace
{

using tipp::FlatMesh;
using tipp::openFlatMesh;
using tipp::Scalar;
using tipp::test::expectIOError;
using tipp::test::FlattenedSeries;
using tipp::test::valuesOf;

class Flatten : public testing::Test
{
protected:
  std::string out() const { return this->Folder.path("flat"); }

  FlatMesh written(const tipp::FlatContent& content) const
  {
    EXPECT_TRUE(tipp::writeFlatMesh(this->out(), content));
    return openFlatMesh(this->out());
  }

  /// Writes an ADCIRC grid of two triangles, and returns its path.
  std::string grid() const
  {
    return this->Folder.file(
      "fort.14", "title\n2 4\n1 0 0 5\n2 1 0 6\n3 1 1 7\n4 0 1 8\n1 3 1 2 3\n2 3 1 3 4\n");
  }

  const tipp::test::TemporaryFolder Folder;
};

const tipp::RawArray& arrayNamed(const std::vector<tipp::RawArray>& arrays, const char* name)
{
  for (const tipp::RawArray& array : arrays)
  {
    if (array.Name == name)
    {
      return array;
    }
  }
  throw std::runtime_error(std::string("no array ") + name);
}

vtkSmartPointer<vtkUnstructuredGrid> quadAndTriangle()
{
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  vtkNew<vtkPoints> points;
  vtkNew<vtkIdTypeArray> ids;
  ids->SetName("a/id");
  for (int i = 0; i < 5; ++i)
  {
    points->InsertNextPoint(i % 2, i / 2, i);
    ids->InsertNextValue(10 * i);
  }
  grid->SetPoints(points);
  grid->GetPointData()->AddArray(ids);
  const vtkIdType quad[] = { 0, 1, 3, 2 };
  const vtkIdType triangle[] = { 2, 3, 4 };
  grid->InsertNextCell(VTK_QUAD, 4, quad);
  grid->InsertNextCell(VTK_TRIANGLE, 3, triangle);
  vtkNew<vtkDoubleArray> pair;
  pair->SetName("pair");
  pair->SetNumberOfComponents(2);
  pair->InsertNextTuple2(1, 2);
  pair->InsertNextTuple2(3, 4);
  grid->GetCellData()->AddArray(pair);
  vtkNew<vtkBitArray> bits;
  bits->SetName("bits");
  bits->InsertNextValue(1);
  bits->InsertNextValue(0);
  grid->GetCellData()->AddArray(bits);
  vtkNew<vtkStringArray> names;
  names->SetName("names");
  names->SetNumberOfValues(2);
  grid->GetCellData()->AddArray(names);
  return grid;
}

} // namespace

TEST_F(Flatten, ADataSetKeepsItsArraysAndTheIdsOfDividedCells)
{
  const auto grid = quadAndTriangle();
  const tipp::Flattened flattened = tipp::flattenDataSet(grid, "grid.vtu");
  EXPECT_EQ((std::vector<std::string>{ "names" }), flattened.ArraysLeftOut);
  const FlatMesh mesh = this->written(flattened.Content);
  EXPECT_EQ(3, mesh.Cells.Tuples);
  EXPECT_EQ(Scalar::Int32, mesh.Cells.Type);
  EXPECT_EQ(Scalar::Float32, mesh.Points.Type);
  EXPECT_EQ((std::vector<std::int64_t>{ 0, 10, 20, 30, 40 }),
    valuesOf<std::int64_t>(arrayNamed(mesh.PointData, "a/id")));
  EXPECT_EQ(
    (std::vector<double>{ 1, 2, 1, 2, 3, 4 }), valuesOf<double>(arrayNamed(mesh.CellData, "pair")));
  EXPECT_EQ((std::vector<std::uint8_t>{ 1, 1, 0 }),
    valuesOf<std::uint8_t>(arrayNamed(mesh.CellData, "bits")));
  EXPECT_EQ((std::vector<std::int64_t>{ 0, 0, 1 }),
    valuesOf<std::int64_t>(arrayNamed(mesh.CellData, "vtkOriginalCellIds")));
}

TEST_F(Flatten, GhostsAreLeftOutWithTheirMarks)
{
  const auto grid = quadAndTriangle();
  for (vtkDataSetAttributes* const data :
    { static_cast<vtkDataSetAttributes*>(grid->GetPointData()),
      static_cast<vtkDataSetAttributes*>(grid->GetCellData()) })
  {
    vtkNew<vtkUnsignedCharArray> ghosts;
    ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
    for (int i = 0; i < (data == grid->GetPointData() ? 5 : 2); ++i)
    {
      ghosts->InsertNextValue(i == 1 ? vtkDataSetAttributes::DUPLICATECELL : 0);
    }
    data->AddArray(ghosts);
  }
  const tipp::Flattened flattened = tipp::flattenDataSet(grid, "grid.vtu");
  const FlatMesh mesh = this->written(flattened.Content);
  EXPECT_EQ(2, mesh.Cells.Tuples);
  EXPECT_EQ(1U, mesh.PointData.size());
  EXPECT_THROW(arrayNamed(mesh.CellData, "vtkGhostType"), std::runtime_error);
}

TEST_F(Flatten, DoesNotReplaceAnotherFolder)
{
  std::filesystem::create_directory(this->out());
  this->Folder.file("flat/notes", "mine");
  const auto grid = quadAndTriangle();
  const tipp::Flattened flattened = tipp::flattenDataSet(grid, "grid.vtu");
  expectIOError(
    this->out(), "exists already", [&] { tipp::writeFlatMesh(this->out(), flattened.Content); });
  EXPECT_EQ("mine", tipp::test::contentOf(this->Folder.path("flat/notes")));
}

TEST_F(Flatten, LeavesNothingBehindWhenStopped)
{
  const auto grid = quadAndTriangle();
  const tipp::Flattened flattened = tipp::flattenDataSet(grid, "grid.vtu");
  EXPECT_FALSE(tipp::writeFlatMesh(this->out(), flattened.Content, [] { return true; }));
  EXPECT_EQ(0U, this->Folder.fileCount());
}

TEST_F(Flatten, ArraysOfOneNameAreRefusedAndNothingIsLeft)
{
  const auto grid = quadAndTriangle();
  tipp::Flattened flattened = tipp::flattenDataSet(grid, "grid.vtu");
  flattened.Content.PointData.push_back(flattened.Content.PointData[0]);
  EXPECT_THROW(tipp::writeFlatMesh(this->out(), flattened.Content), tipp::IOError);
  EXPECT_EQ(0U, this->Folder.fileCount());
}

TEST_F(Flatten, AnAdcircGridWithOneStepHasNoTimes)
{
  const std::string path =
    this->Folder.file("maxele.63", "title\n1 4 1 1 1\n10 1\n1 0.5\n2 -99999\n3 1\n4 2\n");
  const FlatMesh mesh = this->written(FlattenedSeries(this->grid(), { path }).Content);
  EXPECT_TRUE(mesh.Times.empty());
  EXPECT_EQ(
    (std::vector<double>{ 5, 6, 7, 8 }), valuesOf<double>(arrayNamed(mesh.PointData, "depth")));
  EXPECT_EQ((std::vector<double>{ 0.5, -99999, 1, 2 }),
    valuesOf<double>(arrayNamed(mesh.PointData, "maxele")));
}

TEST_F(Flatten, DryNodesOfAdcircHaveNoValueInASeries)
{
  const std::string path =
    this->Folder.file("maxele.63", "title\n1 4 1 1 1\n10 1\n1 0.5\n2 -99999\n3 1\n4 2\n");
  const auto series = tipp::openMeshSeries(this->grid(), { { path }, false });
  std::vector<double> values;
  series->read(tipp::findSeriesVariable(*series, "maxele"), 0, values);
  EXPECT_NE(values.at(1), values.at(1));
  EXPECT_EQ(0.5, values.at(0));
}

TEST_F(Flatten, AnAdcircGridWithStepsVariesInTime)
{
  // The second time step has values for two of the four nodes only.
  const std::string values = this->Folder.file(
    "fort.64", "title\n2 4 1 1 2\n10 1\n1 1 2\n2 3 4\n3 5 6\n4 7 8\n20 2 2 -9\n1 0 0\n3 1 1\n");
  const FlatMesh mesh = this->written(FlattenedSeries(this->grid(), { values }).Content);
  EXPECT_EQ((std::vector<double>{ 10, 20 }), mesh.Times);
  ASSERT_EQ(1U, mesh.PointSeries.size());
  EXPECT_EQ("fort.64", mesh.PointSeries[0][0].Name);
  EXPECT_EQ(
    (std::vector<double>{ 1, 2, 3, 4, 5, 6, 7, 8 }), valuesOf<double>(mesh.PointSeries[0][0]));
  EXPECT_EQ(
    (std::vector<double>{ 0, 0, -9, -9, 1, 1, -9, -9 }), valuesOf<double>(mesh.PointSeries[0][1]));
}

TEST_F(Flatten, AdcircValuesGoToTheNodesOfTheirNumbers)
{
  const std::string grid =
    this->Folder.file("fort.14", "title\n1 3\n70 0 0 5\n9 1 0 6\n20 1 1 7\n1 3 70 9 20\n");
  const std::string dense =
    this->Folder.file("maxele.63", "title\n1 3 1 1 1\n10 1\n9 0.9\n20 2\n70 7\n");
  const std::string sparse = this->Folder.file("maxvel.63", "title\n1 3 1 1 1\n10 1 1 -9\n20 2\n");
  const FlatMesh mesh = this->written(FlattenedSeries(grid, { dense, sparse }).Content);
  EXPECT_EQ(
    (std::vector<double>{ 7, 0.9, 2 }), valuesOf<double>(arrayNamed(mesh.PointData, "maxele")));
  EXPECT_EQ(
    (std::vector<double>{ -9, -9, 2 }), valuesOf<double>(arrayNamed(mesh.PointData, "maxvel")));
}

TEST_F(Flatten, AdcircStepsMayGiveFewNodes)
{
  // Fewer lines than nodes, as ADCIRC writes where most of a large grid is dry.
  std::string grid = "title\n0 40\n";
  for (int node = 1; node <= 40; ++node)
  {
    grid += std::to_string(node) + " " + std::to_string(node) + " 0 0\n";
  }
  const std::string path = this->Folder.file("fort.14", grid);
  const std::string values = this->Folder.file("fort.63",
    "run\n3 40 3600.0 3600 1 FileFmtVersion: 1050624\n  3.6D+03 3600 2 -99999.0\n7 1.0E-001\n40 "
    "2.5-101\n 7.2E+03 7200 0 -99999.0\n 1.08E+04 10800 1 0.5\n1 3\n");
  const FlattenedSeries flattened(path, { values });
  const tipp::FlatContent& content = flattened.Content;
  EXPECT_EQ((std::vector<double>{ 3600, 7200, 10800 }), content.Times);
  const auto given = [&](std::int64_t step, int node)
  { return FlattenedSeries::valueAt(content.PointData.at(1), step, std::size_t(node - 1)); };
  for (int node = 1; node <= 40; ++node)
  {
    EXPECT_EQ(node == 7 ? 0.1 : node == 40 ? 2.5e-101 : -99999, given(0, node)) << node;
    EXPECT_EQ(-99999, given(1, node)) << node;
    EXPECT_EQ(node == 1 ? 3 : 0.5, given(2, node)) << node;
  }
}

TEST_F(Flatten, AdcircValuesThatAreCutOffOrOfAnotherGridAreRefused)
{
  const std::string grid = this->grid();
  const std::pair<const char*, const char*> cases[] = {
    { "title\n", "file ends before" },
    { "title\n1 4 1 1 1\n10 1\n1 0.5\n", "announces" },
    { "title\n1 999999999999 1 1 1\n10 1\n", "at 999999999999 nodes, but the grid has 4" },
    { "title\n1 3 1 1 1\n10 1\n1 1\n2 1\n3 1\n", "the grid has 4" },
    { "title\n1 4 1 1 1\n10 1\n1 1\n2 1\n3 1\n9 1\n", "names node 9" },
    { "title\n1 4 1 1 1\n10 1\n1 1\n2 1\n3 1\n1 2\n", "node 1 twice" },
    { "title\n1 4 1 1 1\n10 1\n1 1\n2 1\n3 x\n4 1\n", "'x' is not a number" },
  };
  for (const auto& [text, words] : cases)
  {
    const std::string values = this->Folder.file("fort.63", text);
    expectIOError(values, words, [&] { FlattenedSeries(grid, { values }); });
  }
}

TEST_F(Flatten, AdcircStepsOfAnInterruptedRunAreLeftOut)
{
  const std::string grid = this->grid();
  const std::string whole =
    "title\n4 4 1 1 1\n10 1\n1 1\n2 1\n3 1\n4 1\n20 2\n1 2\n2 2\n3 2\n4 2\n";
  for (const char* rest : { "", "30 3\n", "30 3\n1 3\n", "30 3\n1 3\n2 3\n3 3.", "3", "30 3\n1",
         "30 3\n1 3\n2 3\n3 3\n4 3" }) // its last number may be cut
  {
    const std::string values = this->Folder.file("fort.63", whole + rest);
    const FlattenedSeries flattened(grid, { values });
    EXPECT_EQ((std::vector<double>{ 10, 20 }), flattened.Content.Times) << rest;
    EXPECT_EQ(2.0, FlattenedSeries::valueAt(flattened.Content.PointData.at(1), 1, 3));
    ASSERT_EQ(1U, flattened.Series->LeftOut.size());
    EXPECT_EQ("step 2", flattened.Series->LeftOut[0].Name);
  }
  for (const char* rest : { "30 3\n1 3\n2 x\n3 3\n4 3\n", "30 3\n1 3\n2 3\n3 3\n4 y\n" })
  {
    const std::string values = this->Folder.file("fort.63", whole + rest);
    expectIOError(values, "is not a number", [&] { FlattenedSeries(grid, { values }); });
  }
}

TEST_F(Flatten, ARealTimeSeriesIsWhole)
{
  TIPP_REQUIRE_DATA(grid, "adcirc/internal_overflow/internal_overflow.grd");
  TIPP_REQUIRE_DATA(values, "adcirc/internal_overflow/fort.63");
  const FlatMesh mesh = this->written(FlattenedSeries(grid, { values }).Content);
  EXPECT_EQ(2716, mesh.Points.Tuples);
  EXPECT_EQ(4978, mesh.Cells.Tuples);
  EXPECT_EQ(43U, mesh.Times.size());
  EXPECT_EQ(12000, mesh.Times[0]);
  EXPECT_EQ(43U, mesh.PointSeries.at(0).size());
}

TEST_F(Flatten, ARealMeshOfTetrahedraIsWhole)
{
  TIPP_REQUIRE_DATA(path, "tets/bracket_appended_compressed.vtu");
  const auto data = tipp::readDataSet(path);
  const tipp::Flattened flattened = tipp::flattenDataSet(data, path);
  EXPECT_TRUE(flattened.Cut.empty());
  const FlatMesh mesh = this->written(flattened.Content);
  EXPECT_EQ(206208, mesh.Cells.Tuples);
  EXPECT_EQ(50000, mesh.Points.Tuples);
  EXPECT_EQ(5U, mesh.PointData.size() + mesh.CellData.size());
  arrayNamed(mesh.CellData, "Material #");
}
