// SPDX-License-Identifier: BSD-3-Clause
#include "CellStorages.h"
#include "ExpectIOError.h"
#include "Vtk/DataSets.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkRectilinearGrid.h"
#include "vtkSOADataArrayTemplate.h"
#include "vtkStructuredGrid.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <cmath>
#include <limits>
#include <vector>

namespace
{

using CellIds = std::vector<vtkTypeInt64>;

template <typename Array>
vtkSmartPointer<Array> someArray(const CellIds& values)
{
  const auto array = vtkSmartPointer<Array>::New();
  for (const vtkTypeInt64 value : values)
  {
    array->InsertNextValue(typename Array::ValueType(value));
  }
  return array;
}

template <typename Array = vtkTypeInt64Array>
vtkSmartPointer<vtkCellArray> someCells(const CellIds& offsets, const CellIds& ids)
{
  const auto cells = vtkSmartPointer<vtkCellArray>::New();
  cells->SetData(someArray<Array>(offsets), someArray<Array>(ids));
  return cells;
}

vtkSmartPointer<vtkPoints> somePoints(int count)
{
  const auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataTypeToDouble();
  for (int i = 0; i < count; ++i)
  {
    points->InsertNextPoint(i, double(i) * i, 0);
  }
  return points;
}

vtkSmartPointer<vtkUnstructuredGrid> someGrid(
  const std::vector<int>& types, vtkCellArray* cells, int points = 4)
{
  const auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  grid->SetPoints(somePoints(points));
  vtkNew<vtkUnsignedCharArray> typeArray;
  for (const int type : types)
  {
    typeArray->InsertNextValue((unsigned char)(type));
  }
  grid->SetCells(typeArray.Get(), cells);
  return grid;
}

vtkSmartPointer<vtkUnstructuredGrid> twoTriangles(vtkTypeInt64 last = 3)
{
  return someGrid({ VTK_TRIANGLE, VTK_TRIANGLE }, someCells({ 0, 3, 6 }, { 0, 1, 2, 0, 2, last }));
}

void expectRefusal(vtkDataSet* data, const std::string& words)
{
  tipp::test::expectIOError("the input", words, [&] { tipp::checkDataSet(data, "the input"); });
}

/// Invalid ids for a data set of four points, and how the message shows them.
const CellIds badIds = { -1, 4, 4294967299, 999999999999,
  std::numeric_limits<vtkTypeInt64>::min() };

} // namespace

TEST(CheckDataSet, ValidDataSetsPass)
{
  EXPECT_NO_THROW(tipp::checkDataSet(twoTriangles(), "the input"));
  EXPECT_NO_THROW(tipp::checkDataSet(vtkNew<vtkUnstructuredGrid>(), "the input"));
  EXPECT_NO_THROW(tipp::checkDataSet(vtkNew<vtkPolyData>(), "the input"));
}

TEST(CheckDataSet, RefusesInvalidPointIds)
{
  for (const vtkTypeInt64 id : badIds)
  {
    expectRefusal(twoTriangles(id),
      "its cells refer to point " + std::to_string(id) + " at number 1, but there are 4 points");
  }
  expectRefusal(someGrid({ VTK_TRIANGLE }, someCells<vtkTypeInt32Array>({ 0, 3 }, { 0, 4, 1 })),
    "refer to point 4");
}

TEST(CheckDataSet, RefusesABadIdInEveryStorageOfCells)
{
  for (const auto& [name, storage] : cellStorages())
  {
    SCOPED_TRACE(name);
    EXPECT_NO_THROW(tipp::checkDataSet(
      someGrid({ VTK_TRIANGLE, VTK_TRIANGLE }, storedCells(storage, { 0, 1, 2, 0, 2, 3 }, 3)),
      "the input"));
    expectRefusal(
      someGrid({ VTK_TRIANGLE, VTK_TRIANGLE }, storedCells(storage, { 0, 1, 2, 0, 2, 4 }, 3)),
      "its cells refer to point 4 at number 1, but there are 4 points");
  }
}

TEST(CheckDataSet, RefusesIdsInAllCellsOfASurface)
{
  using Set = void (vtkPolyData::*)(vtkCellArray*);
  const std::vector<std::pair<Set, std::string>> kinds = {
    { &vtkPolyData::SetVerts, "vertex cells" }, { &vtkPolyData::SetLines, "lines" },
    { &vtkPolyData::SetPolys, "polygons" }, { &vtkPolyData::SetStrips, "triangle strips" }
  };
  for (const auto& [set, name] : kinds)
  {
    for (const vtkTypeInt64 id : badIds)
    {
      vtkNew<vtkPolyData> surface;
      surface->SetPoints(somePoints(4));
      (surface->*set)(someCells({ 0, 3 }, { 0, id, 1 }));
      expectRefusal(surface, "its " + name + " refer to point " + std::to_string(id));
    }
  }
}

/// VTK's GetCellType() crashes for these cells.
TEST(CheckDataSet, RefusesCellsOfTooFewVertices)
{
  using Set = void (vtkPolyData::*)(vtkCellArray*);
  const std::vector<std::pair<Set, vtkTypeInt64>> kinds = { { &vtkPolyData::SetVerts, 1 },
    { &vtkPolyData::SetLines, 2 }, { &vtkPolyData::SetPolys, 3 }, { &vtkPolyData::SetStrips, 3 } };
  for (const auto& [set, least] : kinds)
  {
    for (vtkTypeInt64 size = 0; size <= least; ++size)
    {
      CellIds ids{ 0, 1, 2 };
      ids.resize(std::size_t(size));
      vtkNew<vtkPolyData> surface;
      surface->SetPoints(somePoints(4));
      (surface->*set)(someCells({ 0, size }, ids));
      if (size < least)
      {
        EXPECT_THROW(tipp::checkDataSet(surface, "the input"), tipp::IOError) << size;
      }
      else
      {
        EXPECT_NO_THROW(tipp::checkDataSet(surface, "the input")) << size;
      }
    }
  }
}

TEST(CheckDataSet, RefusesCellsWithoutPoints)
{
  const auto grid = twoTriangles();
  grid->SetPoints(nullptr);
  expectRefusal(grid, "there are 0 points");
}

TEST(CheckDataSet, RefusesABadIdInALaterChunk)
{
  const vtkTypeInt64 count = 200000;
  CellIds offsets{ 0 };
  CellIds ids;
  for (vtkTypeInt64 i = 0; i < count; ++i)
  {
    ids.insert(ids.end(), { 0, 1, 2 });
    offsets.push_back(vtkTypeInt64(ids.size()));
  }
  ids[3 * 150000] = 7;
  ids[3 * 190000] = 8;
  const auto grid =
    someGrid(std::vector<int>(std::size_t(count), VTK_TRIANGLE), someCells(offsets, ids));
  expectRefusal(grid, "refer to point 7 at number 150000");
}

TEST(CheckDataSet, RefusesOffsetsThatDoNotAscendOrEndBeyondTheIds)
{
  expectRefusal(someGrid({ VTK_TRIANGLE, VTK_TRIANGLE }, someCells({ 0, 3, 2 }, { 0, 1, 2 })),
    "offsets that do not ascend: 2 after 3");
  expectRefusal(
    someGrid({ VTK_TRIANGLE, VTK_TRIANGLE }, someCells({ 0, 3, 6 }, { 0, 1, 2 })), "end at 6 of 3");
  expectRefusal(
    someGrid({ VTK_TRIANGLE }, someCells({ 1, 4 }, { 0, 1, 2, 3 })), "begin at vertex id 1");
  expectRefusal(
    someGrid({ VTK_TRIANGLE }, someCells({ -3, 0 }, { 0, 1, 2 })), "begin at vertex id -3");
}

TEST(CheckDataSet, RefusesTypesThatAreUnknownOrDoNotFitTheCell)
{
  const auto cells = someCells({ 0, 3, 6 }, { 0, 1, 2, 0, 2, 3 });
  expectRefusal(
    someGrid({ VTK_TRIANGLE, 99 }, cells), "its cell 1 is of type 99, which VTK does not");
  expectRefusal(someGrid({ VTK_TRIANGLE, VTK_TETRA }, cells), "cannot have 3 vertices");
  expectRefusal(someGrid({ VTK_QUAD, VTK_QUAD }, cells), "its cell 0 is of type 9");
  expectRefusal(someGrid({ VTK_TRIANGLE }, cells), "1 cell types for 2 cells");
  expectRefusal(
    someGrid({ VTK_LAGRANGE_QUADRILATERAL, VTK_TRIANGLE }, cells), "cannot have 3 vertices");
  EXPECT_NO_THROW(
    tipp::checkDataSet(someGrid({ VTK_LAGRANGE_TRIANGLE, VTK_POLYGON }, cells), "the input"));
}

TEST(CheckDataSet, RefusesPolygonsOfTwoPoints)
{
  vtkNew<vtkPolyData> surface;
  surface->SetPoints(somePoints(4));
  surface->SetPolys(someCells({ 0, 2 }, { 0, 1 }));
  expectRefusal(surface, "one of 2 vertices");
}

TEST(CheckDataSet, RefusesFacesOfPolyhedraThatAreCutOrReferToNoPoint)
{
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 4, 0)
  const auto polyhedron = [](const CellIds& ends, const CellIds& ids, const CellIds& list)
  {
    const auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
    grid->SetPoints(somePoints(4));
    vtkNew<vtkUnsignedCharArray> types;
    types->InsertNextValue(VTK_POLYHEDRON);
    grid->SetPolyhedralCells(types.Get(), someCells({ 0, 4 }, { 0, 1, 2, 3 }),
      someCells({ 0, vtkTypeInt64(list.size()) }, list), someCells(ends, ids));
    return grid;
  };
  const CellIds ends = { 0, 3, 6, 9, 12 };
  const CellIds whole = { 0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2 };
  EXPECT_NO_THROW(tipp::checkDataSet(polyhedron(ends, whole, { 0, 1, 2, 3 }), "the input"));
  CellIds bad = whole;
  bad[1] = 9;
  expectRefusal(polyhedron(ends, bad, { 0, 1, 2, 3 }), "its faces of polyhedra refer to point 9");
  expectRefusal(polyhedron(ends, whole, { 0, 1, 2, 4 }), "its lists of faces refer to face 4");
  expectRefusal(polyhedron(ends, whole, {}), "faces that are not all there");
#else
  const auto polyhedron = [](const CellIds& faces)
  {
    const auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
    grid->SetPoints(somePoints(4));
    vtkNew<vtkUnsignedCharArray> types;
    types->InsertNextValue(VTK_POLYHEDRON);
    grid->SetCells(types.Get(), someCells({ 0, 4 }, { 0, 1, 2, 3 }),
      someArray<vtkIdTypeArray>({ 0 }), someArray<vtkIdTypeArray>(faces));
    return grid;
  };
  const CellIds whole = { 4, 3, 0, 2, 1, 3, 0, 1, 3, 3, 1, 2, 3, 3, 0, 3, 2 };
  EXPECT_NO_THROW(tipp::checkDataSet(polyhedron(whole), "the input"));
  CellIds bad = whole;
  bad[3] = 9;
  expectRefusal(polyhedron(bad), "its polyhedron 0 refers to point 9");
  bad = whole;
  bad[6] = 999999999999;
  expectRefusal(polyhedron(bad), "refers to point 999999999999");
  expectRefusal(polyhedron({ 4, 3, 0, 2, 1 }), "faces that are not all there");
  bad = whole;
  bad[5] = -2147483648;
  expectRefusal(polyhedron(bad), "its polyhedron 0 has -2147483648 corners of a face");
  expectRefusal(polyhedron({ -1, 3, 0, 2, 1 }), "its polyhedron 0 has -1 faces");
#endif
}

TEST(CheckDataSet, RefusesGridsWithTooFewPoints)
{
  vtkNew<vtkStructuredGrid> grid;
  grid->SetDimensions(3, 2, 1);
  grid->SetPoints(somePoints(5));
  expectRefusal(grid, "5 points, too few for a grid of 3 x 2 x 1");
  vtkNew<vtkRectilinearGrid> lines;
  lines->SetDimensions(3, 2, 1);
  vtkNew<vtkDoubleArray> one;
  one->InsertNextValue(0);
  lines->SetXCoordinates(one);
  lines->SetYCoordinates(one);
  lines->SetZCoordinates(one);
  expectRefusal(lines, "its axis x has 1 coordinates for 3 points");
}

TEST(CheckDataSet, RefusesArraysOfTooFewValues)
{
  vtkNew<vtkFloatArray> array;
  array->SetName("heat");
  array->InsertNextValue(1);
  const auto ofPoints = twoTriangles();
  ofPoints->GetPointData()->AddArray(array);
  expectRefusal(ofPoints, "its array 'heat' has 1 values for 4 points");
  const auto ofCells = twoTriangles();
  ofCells->GetCellData()->AddArray(array);
  expectRefusal(ofCells, "its array 'heat' has 1 values for 2 cells");
}

TEST(CheckDataSet, ChecksAModifiedDataSetAgain)
{
  const auto grid = twoTriangles();
  EXPECT_NO_THROW(tipp::checkDataSet(grid, "the input"));
  grid->SetCells(VTK_TRIANGLE, someCells({ 0, 3 }, { 0, 1, 9 }));
  expectRefusal(grid, "refer to point 9");
}

TEST(CheckDataSet, FindsCoordinatesThatAreNotFinite)
{
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : { infinity, -infinity, std::nan(""), 0.0, 1e308 })
  {
    for (const int type : { VTK_FLOAT, VTK_DOUBLE })
    {
      vtkNew<vtkPolyData> data;
      const auto points = somePoints(70000);
      data->SetPoints(points);
      EXPECT_TRUE(tipp::allPointsFinite(data));
      vtkNew<vtkPoints> others;
      others->SetDataType(type);
      others->DeepCopy(points);
      const double value = type == VTK_FLOAT && bad > 1e300 && bad < infinity ? 1e30 : bad;
      others->SetPoint(69000, 1, value, 2);
      data->SetPoints(others);
      EXPECT_EQ(tipp::allPointsFinite(data), std::isfinite(value)) << value;
    }
  }
  vtkNew<vtkSOADataArrayTemplate<double>> parted;
  parted->SetNumberOfComponents(3);
  parted->SetNumberOfTuples(2);
  parted->Fill(1);
  parted->SetComponent(1, 2, infinity);
  vtkNew<vtkPoints> points;
  points->SetData(parted);
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  EXPECT_FALSE(tipp::allPointsFinite(data));
}
