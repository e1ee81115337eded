// SPDX-License-Identifier: BSD-3-Clause
#include "Delaunay2DTesting.h"

#include "vtkDelaunay2D.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace testing_delaunay;

namespace
{

/// Two clusters and a few isolated points, whose alpha shape has triangles, lines and vertices.
std::vector<Point3> clumps()
{
  auto points = randomPoints(120);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    points[i].x = (i % 2 ? 3.0 : 0.0) + points[i].x;
    points[i].z *= 0.1;
  }
  const Point3 strays[] = { { 1.7, 2.5, 0 }, { 1.75, 2.51, 0 }, { -2, 5, 0 }, { 2.1, -1, 0 } };
  points.insert(points.end(), std::begin(strays), std::end(strays));
  return points;
}

struct Shape
{
  Cells Triangles, Lines, Vertices;
};

Shape shapeOf(vtkPolyDataAlgorithm* algorithm)
{
  algorithm->Update();
  vtkPolyData* output = algorithm->GetOutput();
  return { cellsOf(output->GetPolys()), cellsOf(output->GetLines()), cellsOf(output->GetVerts()) };
}

} // namespace

TEST(Delaunay2DAlpha, CellsAreThoseOfVtkDelaunay2D)
{
  const auto input = dataset(clumps());
  for (double alpha : { 0.01, 0.05, 0.1, 0.2, 0.5, 2.0 })
  {
    vtkNew<vtkDelaunay2D> reference;
    reference->SetInputData(input);
    reference->SetTolerance(0);
    reference->SetOffset(1000);
    reference->SetAlpha(alpha);
    vtkNew<vtkTIPPDelaunay2D> delaunay;
    delaunay->SetInputData(input);
    delaunay->SetAlpha(alpha);
    const Shape expected = shapeOf(reference);
    const Shape actual = shapeOf(delaunay);
    EXPECT_EQ(expected.Triangles, actual.Triangles) << "alpha " << alpha;
    EXPECT_EQ(expected.Lines, actual.Lines) << "alpha " << alpha;
    EXPECT_EQ(expected.Vertices, actual.Vertices) << "alpha " << alpha;
  }
}

TEST(Delaunay2DAlpha, AMediumRadiusMakesAllKindsOfCells)
{
  vtkNew<vtkTIPPDelaunay2D> delaunay;
  delaunay->SetInputData(dataset(clumps()));
  delaunay->SetAlpha(0.1);
  const Shape shape = shapeOf(delaunay);
  EXPECT_FALSE(shape.Triangles.empty());
  EXPECT_FALSE(shape.Lines.empty());
  EXPECT_FALSE(shape.Vertices.empty());
}

TEST(Delaunay2DAlpha, EachFlagControlsOneKindOfCell)
{
  vtkNew<vtkTIPPDelaunay2D> delaunay;
  delaunay->SetInputData(dataset(clumps()));
  delaunay->SetAlpha(0.1);
  const Shape all = shapeOf(delaunay);
  delaunay->AlphaTrisOff();
  Shape shape = shapeOf(delaunay);
  EXPECT_TRUE(shape.Triangles.empty());
  EXPECT_EQ(all.Lines, shape.Lines);
  EXPECT_EQ(all.Vertices, shape.Vertices);
  delaunay->AlphaTrisOn();
  delaunay->AlphaLinesOff();
  delaunay->AlphaVertsOff();
  shape = shapeOf(delaunay);
  EXPECT_EQ(all.Triangles, shape.Triangles);
  EXPECT_TRUE(shape.Lines.empty());
  EXPECT_TRUE(shape.Vertices.empty());
}

TEST(Delaunay2DAlpha, SwitchesDoNothingWithoutAlpha)
{
  vtkNew<vtkTIPPDelaunay2D> delaunay;
  delaunay->SetInputData(dataset(clumps()));
  const Shape all = shapeOf(delaunay);
  delaunay->AlphaTrisOff();
  EXPECT_EQ(all.Triangles, shapeOf(delaunay).Triangles);
  EXPECT_TRUE(all.Lines.empty());
  EXPECT_TRUE(all.Vertices.empty());
}

TEST(Delaunay2DAlpha, RadiusIsMeasuredInSpace)
{
  vtkNew<vtkTIPPDelaunay2D> delaunay;
  delaunay->SetInputData(dataset({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 100 } }));
  delaunay->SetAlpha(10);
  const Shape shape = shapeOf(delaunay);
  EXPECT_TRUE(shape.Triangles.empty());
  EXPECT_EQ((Cells{ { 0, 1 } }), shape.Lines);
  EXPECT_EQ((Cells{ { 2 } }), shape.Vertices);
}

TEST(Delaunay2DAlpha, DuplicatesAndRejectedPointsAreNoVertices)
{
  vtkNew<vtkTIPPDelaunay2D> delaunay;
  delaunay->SetInputData(
    dataset({ { 0, 0, 0 }, { 9, 0, 0 }, { 0, 9, 0 }, { 9, 0, 0 }, { std::nan(""), 1, 0 } }));
  delaunay->SetAlpha(1);
  Messages messages(delaunay);
  EXPECT_EQ((Cells{ { 0 }, { 1 }, { 2 } }), shapeOf(delaunay).Vertices);
}
