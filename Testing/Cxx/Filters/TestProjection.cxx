// SPDX-License-Identifier: BSD-3-Clause
// Bounds, bounding points and views of a data set's points.
#include "Pipeline/InputPoints.h"

#include "vtkFloatArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkTransform.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace
{

using namespace tipp;

constexpr double NaN = std::numeric_limits<double>::quiet_NaN();
constexpr double Infinity = std::numeric_limits<double>::infinity();

vtkSmartPointer<vtkPoints> box()
{
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataTypeToDouble();
  points->InsertNextPoint(1, 2, 3);
  points->InsertNextPoint(4, 6, 15);
  points->InsertNextPoint(2, 5, 4);
  return points;
}

TEST(FiniteBounds, AreThoseOfAllFinitePoints)
{
  const Box3 bounds = finiteBounds(box());
  EXPECT_EQ((std::array<double, 6>{ 1, 4, 2, 6, 3, 15 }), vtkBoundsOf(bounds));
  EXPECT_EQ(9, bounds.center().z);
  EXPECT_EQ(13, diagonalOf(bounds));
}

TEST(FiniteBounds, IgnoreAPointWithACoordinateThatIsNotFinite)
{
  const auto points = box();
  points->InsertNextPoint(100, 100, NaN);
  points->InsertNextPoint(-Infinity, -100, 0);
  EXPECT_EQ(13, diagonalOf(finiteBounds(points)));
}

TEST(FiniteBounds, AreZeroWithoutFinitePoints)
{
  vtkNew<vtkPoints> points;
  EXPECT_EQ(0, diagonalOf(finiteBounds(points)));
  EXPECT_EQ(0, diagonalOf(finiteBounds(nullptr)));
  points->InsertNextPoint(NaN, 0, 0);
  EXPECT_EQ(0, finiteBounds(points).Max.y);
}

TEST(FiniteBounds, CentreOfHugeBoundsDoesNotOverflow)
{
  const Box3 bounds{ { 1.5e308, 0, 0 }, { 1.7e308, 0, 0 } };
  EXPECT_DOUBLE_EQ(1.6e308, bounds.center().x);
}

TEST(BoundingPoints, FollowThePointsOnACircleAroundTheirBox)
{
  const auto extended = appendPoints(box(), boundingCircle(finiteBounds(box()), 2));
  ASSERT_EQ(11, extended->GetNumberOfPoints());
  EXPECT_EQ(6, extended->GetPoint(1)[1]);
  for (vtkIdType i = 3; i < 11; ++i)
  {
    double p[3];
    extended->GetPoint(i, p);
    EXPECT_NEAR(26, std::hypot(p[0] - 2.5, p[1] - 4), 1e-12);
    EXPECT_EQ(9, p[2]);
  }
}

TEST(BoundingPoints, AreInDoublePrecision)
{
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(0, 0, 0);
  points->InsertNextPoint(1, 1, 0);
  ASSERT_EQ(VTK_FLOAT, points->GetDataType());
  EXPECT_EQ(VTK_DOUBLE, appendPoints(points, boundingCircle({}, 1))->GetDataType());
}

TEST(ProjectedPoints, NoPointsMakeAnEmptyView)
{
  vtkNew<vtkPoints> none;
  EXPECT_EQ(0U, ProjectedPoints(nullptr, nullptr).view().size());
  EXPECT_EQ(0U, ProjectedPoints(none, nullptr).view().size());
}

TEST(ProjectedPoints, DoublesAndFloatsAreViewedInPlace)
{
  const auto doubles = box();
  const ProjectedPoints ofDoubles(doubles, nullptr);
  vtkNew<vtkPoints> floats;
  floats->InsertNextPoint(1, 2, 3);
  const ProjectedPoints ofFloats(floats, nullptr);
  doubles->SetPoint(2, -7, 8, 0);
  floats->SetPoint(0, 0.5, -1, 0);
  ASSERT_EQ(3U, ofDoubles.view().size());
  EXPECT_EQ((Point2{ -7, 8 }), ofDoubles.view()[2]);
  ASSERT_EQ(1U, ofFloats.view().size());
  EXPECT_EQ((Point2{ 0.5, -1 }), ofFloats.view()[0]);
}

TEST(ProjectedPoints, OtherNumbersAreConverted)
{
  vtkNew<vtkIntArray> scalars;
  scalars->SetNumberOfComponents(3);
  scalars->InsertNextTuple3(16777217, -3, 5);
  vtkNew<vtkPoints> points;
  points->SetData(scalars);
  const ProjectedPoints projected(points, nullptr);
  ASSERT_EQ(1U, projected.view().size());
  EXPECT_EQ((Point2{ 16777217, -3 }), projected.view()[0]);
}

TEST(ProjectedPoints, ATransformComesFirst)
{
  vtkNew<vtkTransform> toPlane;
  toPlane->Translate(10, 20, 30);
  const auto points = box();
  const ProjectedPoints projected(points, toPlane);
  ASSERT_EQ(3U, projected.view().size());
  EXPECT_EQ((Point2{ 11, 22 }), projected.view()[0]);
  EXPECT_EQ(1, points->GetPoint(0)[0]);
}

} // namespace
