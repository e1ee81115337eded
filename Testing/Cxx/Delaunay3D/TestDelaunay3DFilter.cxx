// SPDX-License-Identifier: BSD-3-Clause
#include "Delaunay2DTesting.h"

#include "PointsInSpace.h"

#include "vtkTIPPDelaunay2D.h"
#include "vtkTIPPDelaunay3D.h"

#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDelaunay3D.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkTable.h"
#include "vtkTetra.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numeric>

using namespace testing_delaunay;

namespace
{

/// The cells of each type, each as its sorted point ids.
std::map<int, Cells> cellsByType(vtkUnstructuredGrid* grid)
{
  std::map<int, Cells> cells;
  for (vtkIdType i = 0; i < grid->GetNumberOfCells(); ++i)
  {
    vtkIdType size = 0;
    const vtkIdType* ids = nullptr;
    grid->GetCellPoints(i, size, ids);
    std::vector<vtkIdType> cell(ids, ids + size);
    std::sort(cell.begin(), cell.end());
    cells[grid->GetCellType(i)].insert(cell);
  }
  return cells;
}

vtkTypeInt64 total(vtkTable* statistics, const char* name)
{
  return vtkIdTypeArray::SafeDownCast(statistics->GetFieldData()->GetArray(name))->GetValue(0);
}

} // namespace

TEST(Delaunay3DFilter, TetrahedraAreThoseOfVtkDelaunay3D)
{
  const auto input = dataset(randomPoints(200));
  vtkNew<vtkDelaunay3D> reference;
  reference->SetInputData(input);
  reference->SetTolerance(0);
  reference->SetOffset(1000); // VTK's border is convex only with a large offset
  reference->Update();
  vtkNew<vtkTIPPDelaunay3D> delaunay;
  delaunay->SetInputData(input);
  delaunay->Update();
  EXPECT_EQ(cellsByType(reference->GetOutput()), cellsByType(delaunay->GetOutput()));
}

TEST(Delaunay3DFilter, KeepsPointsAndPointData)
{
  for (const int type : { VTK_DOUBLE, VTK_FLOAT })
  {
    const auto input = dataset(randomPoints(100), type);
    vtkNew<vtkDoubleArray> values;
    values->SetName("values");
    values->SetNumberOfTuples(100);
    values->Fill(4);
    input->GetPointData()->AddArray(values);
    vtkNew<vtkTIPPDelaunay3D> delaunay;
    delaunay->SetInputData(input);
    delaunay->Update();
    EXPECT_EQ(input->GetPoints(), delaunay->GetOutput()->GetPoints());
    EXPECT_EQ(values.Get(), delaunay->GetOutput()->GetPointData()->GetArray("values"));
    EXPECT_EQ(nullptr, delaunay->GetOutput()->GetPointData()->GetArray("RepresentativePointId"));
  }
}

TEST(Delaunay3DFilter, TetrahedraHavePositiveVolumes)
{
  vtkNew<vtkTIPPDelaunay3D> delaunay;
  delaunay->SetInputData(dataset(randomPoints(300)));
  delaunay->Update();
  vtkUnstructuredGrid* const grid = delaunay->GetOutput();
  ASSERT_GT(grid->GetNumberOfCells(), 1000);
  for (vtkIdType i = 0; i < grid->GetNumberOfCells(); ++i)
  {
    double p[4][3];
    for (int k = 0; k < 4; ++k)
    {
      grid->GetPoint(grid->GetCell(i)->GetPointId(k), p[k]);
    }
    EXPECT_GT(vtkTetra::ComputeVolume(p[0], p[1], p[2], p[3]), 0);
  }
}

TEST(Delaunay3DFilter, ALatticeIsFilled)
{
  std::vector<Point3> points;
  for (int i = 0; i < 12 * 12 * 12; ++i)
  {
    points.push_back({ double(i % 12), double(i / 12 % 12), double(i / 144) });
  }
  vtkNew<vtkTIPPDelaunay3D> delaunay;
  delaunay->SetInputData(dataset(points));
  delaunay->Update();
  double volume = 0;
  for (vtkIdType i = 0; i < delaunay->GetOutput()->GetNumberOfCells(); ++i)
  {
    auto* const tetra = vtkTetra::SafeDownCast(delaunay->GetOutput()->GetCell(i));
    double p[4][3];
    for (int k = 0; k < 4; ++k)
    {
      tetra->GetPoints()->GetPoint(k, p[k]);
    }
    volume += vtkTetra::ComputeVolume(p[0], p[1], p[2], p[3]);
  }
  EXPECT_NEAR(11 * 11 * 11, volume, 1e-9);
}

TEST(Delaunay3DFilter, MapsDuplicatesAndRejectedPoints)
{
  auto points = randomPoints(50);
  points.push_back(points[7]);
  points.push_back({ 0.5, std::nan(""), 0.5 });
  vtkNew<vtkTIPPDelaunay3D> delaunay;
  Messages messages(delaunay);
  delaunay->SetInputData(dataset(points));
  delaunay->Update();
  EXPECT_EQ(1, delaunay->GetNumberOfDuplicatePoints());
  EXPECT_EQ(1, delaunay->GetNumberOfRejectedPoints());
  EXPECT_EQ(1U, messages.Warnings.size());
  auto* const ids = vtkIdTypeArray::SafeDownCast(
    delaunay->GetOutput()->GetPointData()->GetArray("RepresentativePointId"));
  ASSERT_NE(nullptr, ids);
  EXPECT_EQ(7, ids->GetValue(50));
  EXPECT_EQ(-1, ids->GetValue(51));
  EXPECT_EQ(3, ids->GetValue(3));
}

TEST(Delaunay3DFilter, NeighborIdsAreMutual)
{
  vtkNew<vtkTIPPDelaunay3D> delaunay;
  delaunay->SetInputData(dataset(randomPoints(100)));
  delaunay->GenerateNeighborIdsOn();
  delaunay->Update();
  vtkUnstructuredGrid* const grid = delaunay->GetOutput();
  auto* const neighbors =
    vtkIdTypeArray::SafeDownCast(grid->GetCellData()->GetArray("NeighborIds"));
  ASSERT_NE(nullptr, neighbors);
  ASSERT_EQ(grid->GetNumberOfCells(), neighbors->GetNumberOfTuples());
  for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell)
  {
    for (int corner = 0; corner < 4; ++corner)
    {
      const vtkIdType other = neighbors->GetTypedComponent(cell, corner);
      int mutual = other < 0 ? 1 : 0;
      for (int k = 0; k < 4 && other >= 0; ++k)
      {
        mutual += neighbors->GetTypedComponent(other, k) == cell ? 1 : 0;
      }
      EXPECT_EQ(1, mutual);
    }
  }
}

TEST(Delaunay3DFilter, AlphaShapeEqualsVtkDelaunay3D)
{
  const auto input = dataset(randomPoints(200));
  for (const double alpha : { 0.08, 0.12, 0.2 })
  {
    vtkNew<vtkDelaunay3D> reference;
    reference->SetInputData(input);
    reference->SetTolerance(0);
    reference->SetOffset(1000);
    reference->SetAlpha(alpha);
    reference->Update();
    vtkNew<vtkTIPPDelaunay3D> delaunay;
    delaunay->SetInputData(input);
    delaunay->SetAlpha(alpha);
    delaunay->Update();
    auto expected = cellsByType(reference->GetOutput());
    auto found = cellsByType(delaunay->GetOutput());
    EXPECT_EQ(expected[VTK_TETRA], found[VTK_TETRA]) << alpha;
    EXPECT_GT(found[VTK_TETRA].size(), 0U);
    // Every point must be in a cell, and no triangle may be a face of a tetrahedron.
    std::set<vtkIdType> covered;
    for (const auto& [type, cells] : found)
    {
      for (const auto& cell : cells)
      {
        covered.insert(cell.begin(), cell.end());
      }
    }
    EXPECT_EQ(200U, covered.size());
    for (const auto& triangle : found[VTK_TRIANGLE])
    {
      for (const auto& tetra : found[VTK_TETRA])
      {
        EXPECT_FALSE(std::includes(tetra.begin(), tetra.end(), triangle.begin(), triangle.end()));
      }
    }
  }
}

TEST(Delaunay3DFilter, AlphaFlagsChooseCells)
{
  vtkNew<vtkTIPPDelaunay3D> delaunay;
  delaunay->SetInputData(dataset(randomPoints(200)));
  delaunay->SetAlpha(0.1);
  delaunay->Update();
  const auto all = cellsByType(delaunay->GetOutput());
  delaunay->AlphaTetsOff();
  delaunay->AlphaLinesOff();
  delaunay->Update();
  auto some = cellsByType(delaunay->GetOutput());
  EXPECT_EQ(0U, some.count(VTK_TETRA));
  EXPECT_EQ(0U, some.count(VTK_LINE));
  EXPECT_EQ(all.at(VTK_TRIANGLE), some[VTK_TRIANGLE]);
  delaunay->AlphaTrisOff();
  delaunay->AlphaVertsOff();
  delaunay->Update();
  EXPECT_EQ(0, delaunay->GetOutput()->GetNumberOfCells());
}

TEST(Delaunay3DFilter, ToleranceMergesClosePoints)
{
  auto points = randomPoints(100);
  points.push_back({ points[3].x + 1e-6, points[3].y, points[3].z });
  vtkNew<vtkTIPPDelaunay3D> delaunay;
  delaunay->SetInputData(dataset(points));
  delaunay->Update();
  EXPECT_EQ(0, delaunay->GetNumberOfDuplicatePoints());
  delaunay->SetTolerance(1e-5);
  delaunay->Update();
  EXPECT_EQ(1, delaunay->GetNumberOfDuplicatePoints());
}

TEST(Delaunay3DFilter, BoundingTriangulationHasAnOctahedron)
{
  vtkNew<vtkTIPPDelaunay3D> delaunay;
  delaunay->SetInputData(dataset(randomPoints(100)));
  delaunay->BoundingTriangulationOn();
  delaunay->SetOffset(5);
  delaunay->Update();
  ASSERT_EQ(106, delaunay->GetOutput()->GetNumberOfPoints());
  std::set<vtkIdType> used;
  const auto cells = cellsByType(delaunay->GetOutput());
  for (const auto& cell : cells.at(VTK_TETRA))
  {
    used.insert(cell.begin(), cell.end());
  }
  EXPECT_EQ(106U, used.size());
}

TEST(Delaunay3DFilter, PointsInAPlaneMakeTrianglesAndAWarning)
{
  std::vector<Point3> points = randomPoints(30);
  for (Point3& p : points)
  {
    p.z = 2;
  }
  const auto input = dataset(points);
  vtkNew<vtkTIPPDelaunay3D> delaunay;
  Messages messages(delaunay);
  delaunay->SetInputData(input);
  delaunay->GenerateNeighborIdsOn();
  delaunay->Update();
  vtkNew<vtkTIPPDelaunay2D> reference;
  reference->SetInputData(input);
  reference->Update();
  const auto found = cellsByType(delaunay->GetOutput());
  ASSERT_EQ(1U, found.count(VTK_TRIANGLE));
  EXPECT_EQ(reference->GetOutput()->GetNumberOfPolys(), vtkIdType(found.at(VTK_TRIANGLE).size()));
  auto* const neighbors = delaunay->GetOutput()->GetCellData()->GetArray("NeighborIds");
  ASSERT_NE(nullptr, neighbors);
  EXPECT_EQ(3, neighbors->GetNumberOfComponents());
  EXPECT_EQ(input->GetPoints(), delaunay->GetOutput()->GetPoints());
  ASSERT_EQ(1U, messages.Warnings.size());
  EXPECT_NE(std::string::npos, messages.Warnings[0].find("plane"));
  EXPECT_TRUE(messages.Errors.empty());
}

TEST(Delaunay3DFilter, AlphaAppliesToTrianglesOfAPlane)
{
  std::vector<Point3> points;
  for (int i = 0; i < 5; ++i)
  {
    points.push_back({ double(i), 0, 3 });
    points.push_back({ double(i), 4, 3 });
  }
  points.push_back({ 0.5, 0.5, 3 });
  vtkNew<vtkTIPPDelaunay3D> delaunay;
  Messages messages(delaunay);
  delaunay->SetInputData(dataset(points));
  delaunay->SetAlpha(0.6);
  delaunay->Update();
  auto found = cellsByType(delaunay->GetOutput());
  EXPECT_EQ((Cells{ { 0, 2, 10 } }), found[VTK_TRIANGLE]);
  EXPECT_EQ(7U, found[VTK_LINE].size());
  EXPECT_EQ(0U, found.count(VTK_VERTEX));
  delaunay->AlphaLinesOff();
  delaunay->Update();
  found = cellsByType(delaunay->GetOutput());
  EXPECT_EQ(0U, found.count(VTK_LINE));
}

TEST(Delaunay3DFilter, PointsOnALineAreAWarning)
{
  vtkNew<vtkTIPPDelaunay3D> delaunay;
  Messages messages(delaunay);
  delaunay->SetInputData(dataset({ { 0, 0, 0 }, { 1, 1, 1 }, { 3, 3, 3 } }));
  delaunay->Update();
  EXPECT_EQ(0, delaunay->GetOutput()->GetNumberOfCells());
  ASSERT_EQ(1U, messages.Warnings.size());
  EXPECT_NE(std::string::npos, messages.Warnings[0].find("line"));
}

TEST(Delaunay3DFilter, AnEmptyInputIsAWarning)
{
  vtkNew<vtkPolyData> input;
  vtkNew<vtkTIPPDelaunay3D> delaunay;
  Messages messages(delaunay);
  delaunay->SetInputData(input);
  delaunay->Update();
  EXPECT_EQ(1U, messages.Warnings.size());
  EXPECT_TRUE(messages.Errors.empty());
}

TEST(Delaunay3DFilter, StatisticsAreATable)
{
  auto points = randomPoints(4000);
  points.push_back(points[0]);
  vtkNew<vtkTIPPDelaunay3D> delaunay;
  delaunay->SetInputData(dataset(points));
  delaunay->SetNumberOfPartitions(8);
  delaunay->SetNumberOfThreads(2);
  delaunay->Update();
  vtkTable* const statistics = delaunay->GetStatistics();
  EXPECT_EQ(4001, total(statistics, "Points"));
  EXPECT_EQ(delaunay->GetOutput()->GetNumberOfCells(), total(statistics, "Tetrahedra"));
  EXPECT_EQ(1, total(statistics, "DuplicatePoints"));
  EXPECT_EQ(8, total(statistics, "Partitions"));
  EXPECT_EQ(2, total(statistics, "Threads"));
  EXPECT_GE(total(statistics, "WorkerVertices"), 4000);
}

TEST(Delaunay3DFilter, NaNPropertiesAreErrors)
{
  vtkNew<vtkTIPPDelaunay3D> delaunay;
  Messages messages(delaunay);
  delaunay->SetInputData(dataset(randomPoints(10)));
  delaunay->SetAlpha(std::nan(""));
  delaunay->Update();
  EXPECT_EQ(1U, messages.Errors.size());
  EXPECT_EQ(0, delaunay->GetOutput()->GetNumberOfCells());
}
