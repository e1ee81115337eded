// SPDX-License-Identifier: BSD-3-Clause
// The output of vtkTIPPDelaunay2D for different kinds of input.
#include "Delaunay2DTesting.h"

#include "vtkCellData.h"
#include "vtkDelaunay2D.h"
#include "vtkDoubleArray.h"
#include "vtkIdList.h"
#include "vtkPointData.h"
#include "vtkSOADataArrayTemplate.h"
#include "vtkStructuredGrid.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace testing_delaunay;

namespace
{

Cells reference(vtkPointSet* input)
{
  vtkNew<vtkDelaunay2D> delaunay;
  delaunay->SetInputData(input);
  delaunay->SetTolerance(0);
  delaunay->SetOffset(1000); // VTK's border is convex only with a large offset
  return trianglesOf(delaunay);
}

Cells triangulated(vtkPointSet* input)
{
  vtkNew<vtkTIPPDelaunay2D> delaunay;
  delaunay->SetInputData(input);
  return trianglesOf(delaunay);
}

std::vector<vtkIdType> cornersOf(vtkPolyData* mesh, vtkIdType cell)
{
  vtkIdType size = 0;
  const vtkIdType* ids = nullptr;
  mesh->GetCellPoints(cell, size, ids);
  return { ids, ids + size };
}

} // namespace

TEST(Delaunay2DOutput, TrianglesEqualVtkDelaunay2D)
{
  for (unsigned seed = 1; seed <= 5; ++seed)
  {
    const auto input = dataset(randomPoints(200, seed));
    EXPECT_EQ(reference(input), triangulated(input)) << "seed " << seed;
  }
}

TEST(Delaunay2DOutput, TrianglesAreCounterClockwise)
{
  vtkNew<vtkTIPPDelaunay2D> delaunay;
  delaunay->SetInputData(dataset(randomPoints(500)));
  delaunay->Update();
  vtkPolyData* output = delaunay->GetOutput();
  ASSERT_GT(output->GetNumberOfPolys(), 0);
  vtkIdType size;
  const vtkIdType* ids;
  vtkCellArray* polys = output->GetPolys();
  for (polys->InitTraversal(); polys->GetNextCell(size, ids);)
  {
    ASSERT_EQ(3, size);
    double a[3], b[3], c[3];
    output->GetPoint(ids[0], a);
    output->GetPoint(ids[1], b);
    output->GetPoint(ids[2], c);
    ASSERT_GT((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]), 0);
  }
}

TEST(Delaunay2DOutput, PointsAreTheInputsOwn)
{
  const auto input = dataset(randomPoints(20), VTK_FLOAT);
  vtkNew<vtkTIPPDelaunay2D> delaunay;
  delaunay->SetInputData(input);
  delaunay->Update();
  EXPECT_EQ(input->GetPoints(), delaunay->GetOutput()->GetPoints());
}

TEST(Delaunay2DOutput, PointDataAreTheInputsOwn)
{
  const auto input = dataset(randomPoints(20));
  vtkNew<vtkDoubleArray> depth;
  depth->SetName("depth");
  depth->SetNumberOfTuples(20);
  depth->Fill(7);
  input->GetPointData()->SetScalars(depth);
  vtkNew<vtkTIPPDelaunay2D> delaunay;
  delaunay->SetInputData(input);
  delaunay->Update();
  vtkPointData* output = delaunay->GetOutput()->GetPointData();
  EXPECT_EQ(depth.Get(), output->GetScalars());
  EXPECT_EQ(1, output->GetNumberOfArrays());
}

TEST(Delaunay2DOutput, IdsThatFitAreStoredIn32Bits)
{
  vtkNew<vtkTIPPDelaunay2D> delaunay;
  delaunay->SetInputData(dataset(randomPoints(50)));
  delaunay->Update();
  EXPECT_FALSE(delaunay->GetOutput()->GetPolys()->IsStorage64Bit());
}

TEST(Delaunay2DOutput, ZIsIgnored)
{
  auto points = randomPoints(100);
  const Cells expected = triangulated(dataset(points));
  for (Point3& p : points)
  {
    p.z = std::nan("");
  }
  EXPECT_EQ(expected, triangulated(dataset(points)));
}

TEST(Delaunay2DOutput, FloatPointsAreNotConverted)
{
  const auto input = dataset(randomPoints(200), VTK_FLOAT);
  EXPECT_EQ(reference(input), triangulated(input));
}

TEST(Delaunay2DOutput, IntegerPointsAreTriangulated)
{
  auto points = randomPoints(100);
  for (Point3& p : points)
  {
    p = { std::floor(1e6 * p.x), std::floor(1e6 * p.y), 0 };
  }
  EXPECT_EQ(triangulated(dataset(points)), triangulated(dataset(points, VTK_INT)));
}

TEST(Delaunay2DOutput, PointsInSeparateCoordinateArraysAreTriangulated)
{
  const auto points = randomPoints(100);
  vtkNew<vtkSOADataArrayTemplate<float>> scalars;
  scalars->SetNumberOfComponents(3);
  for (const Point3& p : points)
  {
    scalars->InsertNextTuple3(p.x, p.y, p.z);
  }
  const auto input = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> separate;
  separate->SetData(scalars);
  input->SetPoints(separate);
  EXPECT_EQ(triangulated(dataset(points, VTK_FLOAT)), triangulated(input));
}

TEST(Delaunay2DOutput, UnstructuredGridIsTriangulatedByItsPoints)
{
  const auto input = dataset(randomPoints(100));
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(input->GetPoints());
  EXPECT_EQ(triangulated(input), triangulated(grid));
}

TEST(Delaunay2DOutput, StructuredGridIsTriangulatedByItsPoints)
{
  const auto input = dataset(randomPoints(100));
  vtkNew<vtkStructuredGrid> grid;
  grid->SetDimensions(10, 10, 1);
  grid->SetPoints(input->GetPoints());
  EXPECT_EQ(triangulated(input), triangulated(grid));
}

TEST(Delaunay2DOutput, LatticeIsCoveredByTwoTrianglesASquare)
{
  std::vector<Point3> points;
  for (int i = 0; i < 30 * 20; ++i)
  {
    points.push_back({ double(i % 30), double(i / 30), 0 });
  }
  EXPECT_EQ(2u * 29 * 19, triangulated(dataset(points)).size());
}

TEST(Delaunay2DOutput, OrderOfThePointsDoesNotMatterOnALattice)
{
  std::vector<Point3> points;
  for (int i = 0; i < 8 * 8; ++i)
  {
    points.push_back({ double(i % 8), double(i / 8), 0 });
  }
  const Cells forward = triangulated(dataset(points));
  std::reverse(points.begin(), points.end());
  Cells renumbered;
  for (std::vector<vtkIdType> cell : triangulated(dataset(points)))
  {
    for (vtkIdType& id : cell)
    {
      id = 63 - id;
    }
    std::sort(cell.begin(), cell.end());
    renumbered.insert(cell);
  }
  EXPECT_EQ(forward, renumbered);
}

/// The array is compared with VTK's GetCellEdgeNeighbors().
TEST(Delaunay2DOutput, NeighborsAreTheTrianglesOppositeToEachCorner)
{
  vtkNew<vtkTIPPDelaunay2D> delaunay;
  delaunay->SetInputData(dataset(randomPoints(500)));
  delaunay->GenerateNeighborIdsOn();
  delaunay->Update();
  vtkPolyData* const output = delaunay->GetOutput();
  output->BuildLinks();
  vtkDataArray* const neighbors = output->GetCellData()->GetArray("NeighborIds");
  ASSERT_NE(nullptr, neighbors);
  ASSERT_EQ(output->GetNumberOfCells(), neighbors->GetNumberOfTuples());
  vtkNew<vtkIdList> beyond;
  for (vtkIdType cell = 0; cell < output->GetNumberOfCells(); ++cell)
  {
    const std::vector<vtkIdType> corners = cornersOf(output, cell);
    for (int i = 0; i < 3; ++i)
    {
      output->GetCellEdgeNeighbors(
        cell, corners[std::size_t((i + 1) % 3)], corners[std::size_t((i + 2) % 3)], beyond);
      ASSERT_EQ(beyond->GetNumberOfIds() == 0 ? -1 : beyond->GetId(0),
        vtkIdType(neighbors->GetComponent(cell, i)));
    }
  }
}

TEST(Delaunay2DOutput, NeighborsAreLeftOutWithAlpha)
{
  vtkNew<vtkTIPPDelaunay2D> delaunay;
  delaunay->SetInputData(dataset(randomPoints(500)));
  delaunay->GenerateNeighborIdsOn();
  delaunay->SetAlpha(0.1);
  const Messages messages(delaunay);
  delaunay->Update();
  EXPECT_EQ(0, delaunay->GetOutput()->GetCellData()->GetNumberOfArrays());
  EXPECT_EQ(1U, messages.Warnings.size());
}
