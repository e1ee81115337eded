// SPDX-License-Identifier: BSD-3-Clause
// Every input point is a vertex, merged into another point, or rejected.
#include "Delaunay2DTesting.h"

#include "vtkIdTypeArray.h"
#include "vtkPointData.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace testing_delaunay;

namespace
{

std::vector<vtkIdType> representativesOf(vtkTIPPDelaunay2D* delaunay)
{
  vtkDataArray* array = delaunay->GetOutput()->GetPointData()->GetArray("RepresentativePointId");
  auto ids = vtkIdTypeArray::SafeDownCast(array);
  return ids
    ? std::vector<vtkIdType>(ids->GetPointer(0), ids->GetPointer(0) + ids->GetNumberOfTuples())
    : std::vector<vtkIdType>{};
}

void expectNoTrianglesAndOneWarning(const std::vector<Point3>& points)
{
  vtkNew<vtkTIPPDelaunay2D> delaunay;
  delaunay->SetInputData(dataset(points));
  Messages messages(delaunay);
  delaunay->Update();
  EXPECT_EQ(0, delaunay->GetOutput()->GetNumberOfCells());
  EXPECT_EQ(vtkIdType(points.size()), delaunay->GetOutput()->GetNumberOfPoints());
  EXPECT_EQ(1u, messages.Warnings.size());
  EXPECT_TRUE(messages.Errors.empty());
}

} // namespace

TEST(Delaunay2DMerging, DuplicatesAreMappedToTheLowestIdOfEqualPoints)
{
  vtkNew<vtkTIPPDelaunay2D> delaunay;
  delaunay->SetInputData(
    dataset({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 0, 5 }, { 0, 1, 0 }, { 1, 0, 0 }, { 0, 0, 0 } }));
  EXPECT_EQ((Cells{ { 0, 1, 3 } }), trianglesOf(delaunay));
  EXPECT_EQ(3, delaunay->GetNumberOfDuplicatePoints());
  EXPECT_EQ((std::vector<vtkIdType>{ 0, 1, 0, 3, 1, 0 }), representativesOf(delaunay));
}

TEST(Delaunay2DMerging, MergedPointsStayInTheOutput)
{
  vtkNew<vtkTIPPDelaunay2D> delaunay;
  delaunay->SetInputData(dataset({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 1, 0 } }));
  delaunay->Update();
  EXPECT_EQ(4, delaunay->GetOutput()->GetNumberOfPoints());
}

TEST(Delaunay2DMerging, NegativeZeroIsZero)
{
  vtkNew<vtkTIPPDelaunay2D> delaunay;
  delaunay->SetInputData(dataset({ { 0, 0, 0 }, { -0.0, -0.0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } }));
  delaunay->Update();
  EXPECT_EQ(1, delaunay->GetNumberOfDuplicatePoints());
}

TEST(Delaunay2DMerging, ThereIsNoArrayIfNothingIsMerged)
{
  vtkNew<vtkTIPPDelaunay2D> delaunay;
  delaunay->SetInputData(dataset(randomPoints(30)));
  delaunay->Update();
  EXPECT_EQ(0, delaunay->GetNumberOfDuplicatePoints());
  EXPECT_EQ(0, delaunay->GetOutput()->GetPointData()->GetNumberOfArrays());
}

TEST(Delaunay2DMerging, ArrayIsNotMadeWhenSwitchedOff)
{
  vtkNew<vtkTIPPDelaunay2D> delaunay;
  delaunay->SetInputData(dataset({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 1, 0 } }));
  delaunay->GenerateRepresentativeIdsOff();
  delaunay->Update();
  EXPECT_EQ(1, delaunay->GetNumberOfDuplicatePoints());
  EXPECT_TRUE(representativesOf(delaunay).empty());
}

TEST(Delaunay2DMerging, PointsThatAreNotFiniteAreRejectedWithOneWarning)
{
  const double nan = std::nan("");
  const double infinity = std::numeric_limits<double>::infinity();
  vtkNew<vtkTIPPDelaunay2D> delaunay;
  delaunay->SetInputData(dataset({ { nan, 0, 0 }, { 0, 0, 0 }, { 1, 0, 0 }, { 0, infinity, 0 },
    { 0, 1, 0 }, { -infinity, nan, 0 } }));
  Messages messages(delaunay);
  EXPECT_EQ((Cells{ { 1, 2, 4 } }), trianglesOf(delaunay));
  EXPECT_EQ(3, delaunay->GetNumberOfRejectedPoints());
  EXPECT_EQ((std::vector<vtkIdType>{ -1, 1, 2, -1, 4, -1 }), representativesOf(delaunay));
  ASSERT_EQ(1u, messages.Warnings.size());
  EXPECT_NE(std::string::npos, messages.Warnings[0].find("3 of 6 points"));
}

TEST(Delaunay2DWithoutTriangles, NoPoints)
{
  expectNoTrianglesAndOneWarning({});
}

TEST(Delaunay2DWithoutTriangles, OnePoint)
{
  expectNoTrianglesAndOneWarning({ { 1, 2, 3 } });
}

TEST(Delaunay2DWithoutTriangles, TwoPoints)
{
  expectNoTrianglesAndOneWarning({ { 1, 2, 3 }, { 2, 3, 4 } });
}

TEST(Delaunay2DWithoutTriangles, EqualPoints)
{
  expectNoTrianglesAndOneWarning(std::vector<Point3>(50, { 1, 2, 3 }));
}

TEST(Delaunay2DWithoutTriangles, CollinearPoints)
{
  expectNoTrianglesAndOneWarning({ { 0, 0, 0 }, { 3, 6, 1 }, { 1, 2, 0 }, { 2, 4, 5 } });
}

TEST(Delaunay2DMerging, InputWithoutPointsObjectMakesAnEmptyOutput)
{
  vtkNew<vtkPolyData> empty;
  vtkNew<vtkTIPPDelaunay2D> delaunay;
  delaunay->SetInputData(empty);
  delaunay->BoundingTriangulationOn();
  delaunay->SetTolerance(0.1);
  Messages messages(delaunay);
  delaunay->Update();
  EXPECT_EQ(0, delaunay->GetOutput()->GetNumberOfPoints());
  EXPECT_EQ(1u, messages.Warnings.size());
}

TEST(Delaunay2DMerging, ToleranceIsAFractionOfTheDiagonal)
{
  // The diagonal's length is 5, so the tolerance 0.02 is a distance of 0.1.
  const auto input =
    dataset({ { 0, 0, 0 }, { 3, 0, 0 }, { 0, 4, 0 }, { 0.09, 0, 0 }, { 3, 0.11, 0 }, { 3, 4, 0 } });
  vtkNew<vtkTIPPDelaunay2D> delaunay;
  delaunay->SetInputData(input);
  delaunay->SetTolerance(0.02);
  delaunay->Update();
  EXPECT_EQ(1, delaunay->GetNumberOfDuplicatePoints());
  EXPECT_EQ((std::vector<vtkIdType>{ 0, 1, 2, 0, 4, 5 }), representativesOf(delaunay));
}

TEST(Delaunay2DMerging, TrianglesAfterMergingUseIdsOfTheInput)
{
  vtkNew<vtkTIPPDelaunay2D> delaunay;
  delaunay->SetInputData(
    dataset({ { 0, 0, 0 }, { 0.001, 0, 0 }, { 3, 0, 0 }, { 3, 0.001, 0 }, { 0, 4, 0 } }));
  delaunay->SetTolerance(0.01);
  EXPECT_EQ((Cells{ { 0, 2, 4 } }), trianglesOf(delaunay));
}

TEST(Delaunay2DMerging, InfinityDoesNotWidenTheTolerance)
{
  vtkNew<vtkTIPPDelaunay2D> delaunay;
  delaunay->SetInputData(dataset(
    { { 0, 0, 0 }, { 3, 0, 0 }, { 0, 4, 0 }, { std::numeric_limits<double>::infinity(), 0, 0 } }));
  delaunay->SetTolerance(0.01);
  Messages messages(delaunay);
  EXPECT_EQ((Cells{ { 0, 1, 2 } }), trianglesOf(delaunay));
  EXPECT_EQ(1, delaunay->GetNumberOfRejectedPoints());
}
