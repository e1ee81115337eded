// SPDX-License-Identifier: BSD-3-Clause
#include "Delaunay2DTesting.h"

#include "vtkDelaunay2D.h"
#include "vtkMatrix4x4.h"
#include "vtkPerspectiveTransform.h"
#include "vtkPointData.h"
#include "vtkTransform.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace testing_delaunay;

namespace
{

/// Points near a steep plane.
std::vector<Point3> slope()
{
  auto points = randomPoints(150);
  for (Point3& p : points)
  {
    p.z = 3 * p.x - 2 * p.y + 0.1 * p.z;
  }
  return points;
}

void transformPlane(vtkPolyData* input, vtkAbstractTransform* transform, Cells& expected,
  Cells& actual, int mode = VTK_SET_TRANSFORM_PLANE)
{
  vtkNew<vtkDelaunay2D> reference;
  reference->SetInputData(input);
  reference->SetTolerance(0);
  reference->SetOffset(1000);
  reference->SetProjectionPlaneMode(mode);
  reference->SetTransform(transform);
  expected = trianglesOf(reference);
  vtkNew<vtkTIPPDelaunay2D> delaunay;
  delaunay->SetInputData(input);
  delaunay->SetProjectionPlaneMode(mode);
  delaunay->SetTransform(transform);
  actual = trianglesOf(delaunay);
}

double matrixDifference(vtkAbstractTransform* a, vtkAbstractTransform* b)
{
  double difference = 0;
  for (int i = 0; i < 16; ++i)
  {
    difference = std::max(difference,
      std::fabs(vtkTransform::SafeDownCast(a)->GetMatrix()->GetElement(i / 4, i % 4) -
        vtkTransform::SafeDownCast(b)->GetMatrix()->GetElement(i / 4, i % 4)));
  }
  return difference;
}

} // namespace

TEST(Delaunay2DProjection, TransformDecidesThePlaneAsInVtkDelaunay2D)
{
  vtkNew<vtkTransform> transform;
  transform->RotateX(70);
  transform->RotateY(20);
  Cells expected, actual;
  transformPlane(dataset(randomPoints(150)), transform, expected, actual);
  EXPECT_EQ(expected, actual);
}

TEST(Delaunay2DProjection, TransformIsUsedInTheDefaultModeAsInVtkDelaunay2D)
{
  vtkNew<vtkTransform> transform;
  transform->RotateX(70);
  Cells expected, actual;
  transformPlane(dataset(randomPoints(150)), transform, expected, actual, VTK_DELAUNAY_XY_PLANE);
  EXPECT_EQ(expected, actual);
}

TEST(Delaunay2DProjection, TransformNeedNotBeLinear)
{
  vtkNew<vtkPerspectiveTransform> transform;
  const double matrix[16] = { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0.3, 0.2, 0.1, 1 };
  transform->SetMatrix(matrix);
  auto points = randomPoints(150);
  for (Point3& p : points)
  {
    p = { 2 + p.x, 2 + p.y, 2 + p.z };
  }
  Cells expected, actual;
  transformPlane(dataset(points), transform, expected, actual);
  EXPECT_EQ(expected, actual);
}

TEST(Delaunay2DProjection, OutputKeepsUntransformedPoints)
{
  const auto input = dataset(randomPoints(50));
  vtkNew<vtkTransform> transform;
  transform->RotateX(70);
  vtkNew<vtkTIPPDelaunay2D> delaunay;
  delaunay->SetInputData(input);
  delaunay->SetTransform(transform);
  delaunay->Update();
  EXPECT_EQ(input->GetPoints(), delaunay->GetOutput()->GetPoints());
}

TEST(Delaunay2DProjection, TransformModeWithoutTransformIsAnError)
{
  vtkNew<vtkTIPPDelaunay2D> delaunay;
  delaunay->SetInputData(dataset(randomPoints(50)));
  delaunay->SetProjectionPlaneMode(VTK_SET_TRANSFORM_PLANE);
  Messages messages(delaunay);
  Messages executive(delaunay->GetExecutive());
  delaunay->Update();
  ASSERT_EQ(1u, messages.Errors.size());
  EXPECT_NE(std::string::npos, messages.Errors[0].find("SetTransform"));
  EXPECT_EQ(0, delaunay->GetOutput()->GetNumberOfCells());
}

TEST(Delaunay2DProjection, ChangedTransformIsANewRun)
{
  vtkNew<vtkTransform> transform;
  vtkNew<vtkTIPPDelaunay2D> delaunay;
  delaunay->SetInputData(dataset(randomPoints(50)));
  delaunay->SetTransform(transform);
  const Cells before = trianglesOf(delaunay);
  transform->RotateX(70);
  EXPECT_NE(before, trianglesOf(delaunay));
}

TEST(Delaunay2DProjection, BestFittingPlaneIsThatOfVtkDelaunay2D)
{
  const auto input = dataset(slope());
  const auto expected =
    vtkSmartPointer<vtkAbstractTransform>::Take(vtkDelaunay2D::ComputeBestFittingPlane(input));
  const auto actual =
    vtkSmartPointer<vtkAbstractTransform>::Take(vtkTIPPDelaunay2D::ComputeBestFittingPlane(input));
  EXPECT_LT(matrixDifference(expected, actual), 1e-12);
}

TEST(Delaunay2DProjection, BestFittingPlaneModeTriangulatesAsVtkDelaunay2D)
{
  Cells expected, actual;
  transformPlane(dataset(slope()), nullptr, expected, actual, VTK_BEST_FITTING_PLANE);
  EXPECT_EQ(expected, actual);
}

TEST(Delaunay2DProjection, VerticalPlaneIsTriangulatedInTheBestFittingPlane)
{
  auto points = randomPoints(100);
  for (Point3& p : points)
  {
    p.x = 5;
  }
  Cells expected, actual;
  transformPlane(dataset(points), nullptr, expected, actual, VTK_BEST_FITTING_PLANE);
  EXPECT_EQ(expected, actual);
  EXPECT_FALSE(actual.empty());
}

TEST(Delaunay2DProjection, BestFittingPlaneIgnoresPointsThatAreNotFinite)
{
  auto points = slope();
  const auto clean = vtkSmartPointer<vtkAbstractTransform>::Take(
    vtkTIPPDelaunay2D::ComputeBestFittingPlane(dataset(points)));
  points.push_back({ std::nan(""), 0, 0 });
  points.push_back({ 0, HUGE_VAL, 0 });
  const auto soiled = vtkSmartPointer<vtkAbstractTransform>::Take(
    vtkTIPPDelaunay2D::ComputeBestFittingPlane(dataset(points)));
  EXPECT_LT(matrixDifference(clean, soiled), 1e-12);
}

TEST(Delaunay2DProjection, NoFinitePointsHaveNoBestFittingPlane)
{
  EXPECT_EQ(nullptr, vtkTIPPDelaunay2D::ComputeBestFittingPlane(nullptr));
  EXPECT_EQ(nullptr, vtkTIPPDelaunay2D::ComputeBestFittingPlane(dataset({})));
  EXPECT_EQ(
    nullptr, vtkTIPPDelaunay2D::ComputeBestFittingPlane(dataset({ { std::nan(""), 0, 0 } })));
}

TEST(Delaunay2DProjection, BoundingTriangulationIsThatOfVtkDelaunay2D)
{
  const auto input = dataset(randomPoints(100));
  vtkNew<vtkDelaunay2D> reference;
  vtkNew<vtkTIPPDelaunay2D> delaunay;
  reference->SetInputData(input);
  reference->SetTolerance(0);
  reference->SetOffset(2);
  reference->BoundingTriangulationOn();
  delaunay->SetInputData(input);
  delaunay->SetOffset(2);
  delaunay->BoundingTriangulationOn();
  EXPECT_EQ(trianglesOf(reference), trianglesOf(delaunay));
  vtkPolyData* output = delaunay->GetOutput();
  ASSERT_EQ(108, output->GetNumberOfPoints());
  EXPECT_EQ(VTK_DOUBLE, output->GetPoints()->GetDataType());
  for (vtkIdType i = 0; i < 108; ++i)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      EXPECT_NEAR(reference->GetOutput()->GetPoint(i)[axis], output->GetPoint(i)[axis], 1e-12);
    }
  }
  EXPECT_EQ(100, input->GetNumberOfPoints());
}

TEST(Delaunay2DProjection, BoundingTriangulationIsLeftOutWithATransform)
{
  vtkNew<vtkTransform> transform;
  vtkNew<vtkTIPPDelaunay2D> delaunay;
  delaunay->SetInputData(dataset(randomPoints(100)));
  const Cells expected = trianglesOf(delaunay);
  delaunay->SetTransform(transform);
  delaunay->BoundingTriangulationOn();
  Messages messages(delaunay);
  EXPECT_EQ(expected, trianglesOf(delaunay));
  EXPECT_EQ(1u, messages.Warnings.size());
  EXPECT_EQ(100, delaunay->GetOutput()->GetNumberOfPoints());
}
