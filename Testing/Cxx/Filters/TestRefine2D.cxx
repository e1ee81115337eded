// SPDX-License-Identifier: BSD-3-Clause
#include "Delaunay2DTesting.h"
#include "TemporaryFolder.h"
#include "vtkTIPPRefine2D.h"

#include "vtkCallbackCommand.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkIntArray.h"
#include "vtkPointData.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace
{

using namespace testing_delaunay;
using Ids = std::vector<vtkIdType>;

/// A square of side 8 with a smaller one inside, whose plane is z = x + 2 y.
vtkSmartPointer<vtkPolyData> refinedSquares()
{
  std::vector<Point3> points{ { 0, 0, 0 }, { 8, 0, 0 }, { 8, 8, 0 }, { 0, 8, 0 }, { 3, 3, 0 },
    { 5, 3, 0 }, { 5, 5, 0 }, { 3, 5, 0 } };
  for (Point3& p : points)
  {
    p.z = p.x + 2 * p.y;
  }
  return dataset(points);
}

vtkSmartPointer<vtkCellArray> cellArray(const std::vector<Ids>& lists)
{
  auto array = vtkSmartPointer<vtkCellArray>::New();
  for (const Ids& ids : lists)
  {
    array->InsertNextCell(vtkIdType(ids.size()), ids.data());
  }
  return array;
}

const Ids Outer{ 0, 1, 2, 3 };
const Ids Inner{ 4, 5, 6, 7 };

struct Corner
{
  double X;
  double Y;
};

/// Calls visit(triangle, corners) for all triangles.
void forTriangles(
  vtkPolyData* mesh, const std::function<void(vtkIdType, const std::vector<Corner>&)>& visit)
{
  for (vtkIdType t = 0; t < mesh->GetNumberOfPolys(); ++t)
  {
    vtkIdType count = 0;
    const vtkIdType* ids = nullptr;
    mesh->GetPolys()->GetCellAtId(t, count, ids);
    std::vector<Corner> corners;
    for (vtkIdType i = 0; i < count; ++i)
    {
      double p[3];
      mesh->GetPoint(ids[i], p);
      corners.push_back({ p[0], p[1] });
    }
    visit(t, corners);
  }
}

double triangleArea(const std::vector<Corner>& p)
{
  return ((p[1].X - p[0].X) * (p[2].Y - p[0].Y) - (p[1].Y - p[0].Y) * (p[2].X - p[0].X)) / 2;
}

double meshArea(vtkPolyData* mesh)
{
  double sum = 0;
  forTriangles(mesh, [&sum](vtkIdType, const auto& corners) { sum += triangleArea(corners); });
  return sum;
}

/// The smallest angle, in degrees.
double triangleAngle(const std::vector<Corner>& p)
{
  constexpr double degree = 3.14159265358979323846 / 180;
  double least = 180;
  for (std::size_t i = 0; i < 3; ++i)
  {
    const Corner& a = p[(i + 1) % 3];
    const Corner& b = p[(i + 2) % 3];
    const double angle =
      std::fabs(std::atan2(b.Y - p[i].Y, b.X - p[i].X) - std::atan2(a.Y - p[i].Y, a.X - p[i].X)) /
      degree;
    least = std::min(least, std::min(angle, 360 - angle));
  }
  return least;
}

double meshAngle(vtkPolyData* mesh)
{
  double least = 180;
  forTriangles(mesh,
    [&least](vtkIdType, const auto& corners) { least = std::min(least, triangleAngle(corners)); });
  return least;
}

class Refine2D : public testing::Test
{
protected:
  vtkPolyData* run(vtkPolyData* input)
  {
    this->Filter->SetInputData(input);
    this->Filter->Update();
    return this->Filter->GetOutput();
  }

  vtkNew<vtkTIPPRefine2D> Filter;
  Messages Heard{ this->Filter.Get() };
  Messages OfPipeline{ this->Filter->GetExecutive() }; // suppresses their printing
};

TEST_F(Refine2D, TrianglesMeetTheAngle)
{
  const auto input = refinedSquares();
  input->SetLines(cellArray({ { 0, 1, 2, 3, 0 }, { 4, 5, 6, 7, 4 } }));
  vtkPolyData* const mesh = this->run(input);
  EXPECT_GE(meshAngle(mesh), 30 - 1e-9);
  EXPECT_DOUBLE_EQ(meshArea(mesh), 64);
  EXPECT_TRUE(this->Heard.Errors.empty());
}

TEST_F(Refine2D, InputPointsComeFirst)
{
  const auto input = refinedSquares();
  input->SetPolys(cellArray({ Outer }));
  this->Filter->SetMaximumArea(0.5);
  vtkPolyData* const mesh = this->run(input);
  ASSERT_GT(mesh->GetNumberOfPoints(), input->GetNumberOfPoints());
  for (vtkIdType i = 0; i < input->GetNumberOfPoints(); ++i)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      EXPECT_EQ(mesh->GetPoint(i)[axis], input->GetPoint(i)[axis]);
    }
  }
}

TEST_F(Refine2D, ValuesOfNewPointsAreLinear)
{
  const auto input = refinedSquares();
  input->SetPolys(cellArray({ Outer }));
  vtkNew<vtkDoubleArray> values;
  values->SetName("Sum");
  for (vtkIdType i = 0; i < input->GetNumberOfPoints(); ++i)
  {
    values->InsertNextValue(input->GetPoint(i)[0] - input->GetPoint(i)[1]);
  }
  input->GetPointData()->AddArray(values);
  this->Filter->SetMaximumArea(0.1);
  vtkPolyData* const mesh = this->run(input);
  vtkDataArray* const sums = mesh->GetPointData()->GetArray("Sum");
  ASSERT_EQ(sums->GetNumberOfTuples(), mesh->GetNumberOfPoints());
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    double p[3];
    mesh->GetPoint(i, p);
    EXPECT_NEAR(p[2], p[0] + 2 * p[1], 1e-12);
    EXPECT_NEAR(sums->GetComponent(i, 0), p[0] - p[1], 1e-12);
  }
}

TEST_F(Refine2D, PolygonsDefineTheDomain)
{
  const auto input = refinedSquares();
  input->SetPolys(cellArray({ Outer, { 7, 6, 5, 4 } }));
  EXPECT_DOUBLE_EQ(meshArea(this->run(input)), 60);
}

TEST_F(Refine2D, LinesEncloseTheDomain)
{
  const auto input = refinedSquares();
  input->SetLines(cellArray({ { 4, 5, 6, 7, 4 } }));
  EXPECT_DOUBLE_EQ(meshArea(this->run(input)), 4);
}

TEST_F(Refine2D, ConvexIsTheHull)
{
  const auto input = refinedSquares();
  input->SetPolys(cellArray({ Inner }));
  this->Filter->ConvexOn();
  EXPECT_DOUBLE_EQ(meshArea(this->run(input)), 64);
}

TEST_F(Refine2D, HolesAreRemoved)
{
  const auto input = refinedSquares();
  input->SetLines(cellArray({ { 0, 1, 2, 3, 0 }, { 4, 5, 6, 7, 4 } }));
  this->Filter->AddHole(4, 4);
  EXPECT_DOUBLE_EQ(meshArea(this->run(input)), 60);
}

TEST_F(Refine2D, OpenLinesEncloseNothing)
{
  const auto input = refinedSquares();
  input->SetLines(cellArray({ { 4, 5, 6, 7 } }));
  EXPECT_EQ(this->run(input)->GetNumberOfPolys(), 0);
  ASSERT_EQ(this->Heard.Warnings.size(), 1u);
  EXPECT_NE(this->Heard.Warnings[0].find("enclose nothing"), std::string::npos);
}

TEST_F(Refine2D, RegionsLimitTheirAreas)
{
  const auto input = refinedSquares();
  input->SetPolys(cellArray({ Outer }));
  input->SetLines(cellArray({ { 4, 5, 6, 7, 4 } }));
  this->Filter->AddRegion(4, 4, 0.02);
  this->Filter->AddRegion(1, 1, 0);
  vtkPolyData* const mesh = this->run(input);
  vtkDataArray* const regions = mesh->GetCellData()->GetArray("Region");
  ASSERT_TRUE(regions);
  double inner = 0;
  double largest = 0;
  forTriangles(mesh,
    [&](vtkIdType t, const auto& corners)
    {
      const double area = triangleArea(corners);
      const bool isInner = regions->GetComponent(t, 0) == 0;
      inner += isInner ? area : 0;
      largest = isInner ? largest : std::max(largest, area);
      EXPECT_TRUE(!isInner || area <= 0.02);
    });
  EXPECT_NEAR(inner, 4, 1e-12);
  EXPECT_GT(largest, 0.02);
}

TEST_F(Refine2D, RegionOutsideOfTheDomainIsAnError)
{
  const auto input = refinedSquares();
  input->SetPolys(cellArray({ Outer }));
  this->Filter->AddRegion(9, 9, 1);
  EXPECT_EQ(this->run(input)->GetNumberOfCells(), 0);
  ASSERT_EQ(this->Heard.Errors.size(), 1u);
  EXPECT_NE(this->Heard.Errors[0].find("region 0 is in no triangle"), std::string::npos);
}

/// Checks that no triangle is larger than the equilateral one of the side that h gives there.
void expectSizes(vtkPolyData* mesh, const std::function<double(double, double)>& h)
{
  forTriangles(mesh,
    [&](vtkIdType, const auto& p)
    {
      const double side = h((p[0].X + p[1].X + p[2].X) / 3, (p[0].Y + p[1].Y + p[2].Y) / 3);
      EXPECT_LE(triangleArea(p), std::sqrt(3.0) / 4 * side * side * (1 + 1e-9));
    });
}

vtkSmartPointer<vtkDoubleArray> sizeArray(
  vtkPolyData* data, const std::function<double(double, double)>& h)
{
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName("h");
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    array->InsertNextValue(h(data->GetPoint(i)[0], data->GetPoint(i)[1]));
  }
  return array;
}

TEST_F(Refine2D, SizesAreInterpolatedOnTheInput)
{
  const auto h = [](double x, double y) { return 0.2 + 0.1 * x + 0.05 * y; };
  const auto input = refinedSquares();
  input->SetPolys(cellArray({ Outer }));
  input->GetPointData()->AddArray(sizeArray(input, h));
  this->Filter->SetSizeArrayName("h");
  expectSizes(this->run(input), h);
}

TEST_F(Refine2D, SizesAreThoseOfTheSecondInput)
{
  const auto h = [](double x, double y) { return 0.9 - 0.1 * x + 0.05 * y; };
  const auto input = refinedSquares();
  input->SetPolys(cellArray({ Outer }));
  const auto mesh = dataset({ { -1, -1, 5 }, { 9, -1, 0 }, { 9, 9, 0 }, { -1, 9, 7 } }, VTK_FLOAT);
  mesh->SetPolys(cellArray({ Outer }));
  mesh->GetPointData()->AddArray(sizeArray(mesh, h));
  this->Filter->SetSizeData(mesh);
  this->Filter->SetSizeArrayName("h");
  expectSizes(this->run(input), h);
}

TEST_F(Refine2D, MissingSizeArrayIsAnError)
{
  this->Filter->SetSizeArrayName("h");
  this->run(refinedSquares());
  ASSERT_EQ(this->Heard.Errors.size(), 1u);
  EXPECT_NE(this->Heard.Errors[0].find("the input has no point array 'h'"), std::string::npos);
}

TEST_F(Refine2D, SizeThatIsNotPositiveIsAnError)
{
  const auto input = refinedSquares();
  input->GetPointData()->AddArray(sizeArray(input, [](double x, double) { return x; }));
  this->Filter->SetSizeArrayName("h");
  this->run(input);
  ASSERT_EQ(this->Heard.Errors.size(), 1u);
  EXPECT_NE(this->Heard.Errors[0].find("The size at point 0"), std::string::npos);
}

TEST_F(Refine2D, TrianglesOutsideOfBoundsAreMarked)
{
  const auto input = dataset({ { 0, 0, 0 }, { 8, 0, 0 }, { 8, 1, 0 } });
  input->SetPolys(cellArray({ { 0, 1, 2 } }));
  vtkPolyData* const mesh = this->run(input);
  vtkDataArray* const marks = mesh->GetCellData()->GetArray("OutsideBounds");
  ASSERT_TRUE(marks);
  forTriangles(mesh,
    [&](vtkIdType t, const auto& corners)
    {
      const bool isThin = triangleAngle(corners) < 30 - 1e-9;
      EXPECT_EQ(marks->GetComponent(t, 0), isThin ? vtkTIPPRefine2D::INPUT_ANGLE : 0);
    });
  EXPECT_LT(meshAngle(mesh), 8);
}

TEST_F(Refine2D, WithoutBoundsNoPointsAreAdded)
{
  const auto input = dataset(randomPoints(60));
  this->Filter->SetMinimumAngle(0);
  EXPECT_EQ(this->run(input)->GetNumberOfPoints(), 60);
}

TEST_F(Refine2D, KeptSegmentsHaveNoNewPoints)
{
  const auto input = refinedSquares();
  input->SetPolys(cellArray({ Outer }));
  this->Filter->SetMaximumArea(0.5);
  this->Filter->KeepSegmentsOn();
  this->Filter->GenerateSegmentsOn();
  vtkPolyData* const mesh = this->run(input);
  EXPECT_EQ(mesh->GetNumberOfLines(), 4);
  EXPECT_EQ(mesh->GetCellData()->GetArray("ConstraintId")->GetComponent(0, 0), 0);
  EXPECT_EQ(
    mesh->GetCellData()->GetArray("OutsideBounds")->GetNumberOfTuples(), mesh->GetNumberOfCells());
}

TEST_F(Refine2D, MostPointsLimitsTheMesh)
{
  const auto input = refinedSquares();
  input->SetPolys(cellArray({ Outer }));
  this->Filter->SetMaximumArea(0.01);
  this->Filter->SetMostPoints(10);
  EXPECT_EQ(this->run(input)->GetNumberOfPoints(), input->GetNumberOfPoints() + 10);
}

/// Expects the same points, with values, and the same triangles.
void expectSameMesh(vtkPolyData* expected, vtkPolyData* found)
{
  ASSERT_EQ(found->GetNumberOfPoints(), expected->GetNumberOfPoints());
  EXPECT_EQ(cellsOf(found->GetPolys()), cellsOf(expected->GetPolys()));
  for (vtkIdType i = 0; i < expected->GetNumberOfPoints(); ++i)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      ASSERT_EQ(found->GetPoint(i)[axis], expected->GetPoint(i)[axis]);
    }
  }
}

TEST_F(Refine2D, MemoryLimitDoesNotMatter)
{
  const tipp::test::TemporaryFolder folder;
  const auto input = refinedSquares();
  input->SetPolys(cellArray({ Outer }));
  this->Filter->SetMaximumArea(0.001);
  this->Filter->AddRegion(1, 1, 0.01);
  this->Filter->SetSmoothingRounds(2);
  vtkNew<vtkPolyData> expected;
  expected->DeepCopy(this->run(input));
  this->Filter->SetMemoryLimit(1 << 20);
  this->Filter->SetScratchFolder(folder.path(".").c_str());
  vtkPolyData* const found = this->run(input);
  expectSameMesh(expected, found);
  const auto regionsOf = [](vtkPolyData* mesh)
  { return vtkIntArray::SafeDownCast(mesh->GetCellData()->GetArray("Region")); };
  for (vtkIdType t = 0; t < expected->GetNumberOfCells(); ++t)
  {
    ASSERT_EQ(regionsOf(found)->GetValue(t), regionsOf(expected)->GetValue(t));
  }
}

TEST_F(Refine2D, AScratchFolderThatIsMissingIsAnError)
{
  this->Filter->SetMemoryLimit(1 << 20);
  this->Filter->SetScratchFolder("missing");
  EXPECT_EQ(this->run(refinedSquares())->GetNumberOfCells(), 0);
  ASSERT_EQ(this->Heard.Errors.size(), 1U);
  EXPECT_NE(this->Heard.Errors[0].find("missing: cannot be written"), std::string::npos)
    << this->Heard.Errors[0];
}

TEST_F(Refine2D, ThreadsDoNotMatter)
{
  const auto input = dataset(randomPoints(500));
  input->GetPointData()->AddArray(
    sizeArray(input, [](double x, double y) { return 0.005 + 0.02 * (x + y); }));
  this->Filter->SetSizeArrayName("h");
  this->Filter->SetNumberOfThreads(1);
  vtkNew<vtkPolyData> one;
  one->DeepCopy(this->run(input));
  this->Filter->SetNumberOfThreads(4);
  expectSameMesh(one, this->run(input));
}

TEST_F(Refine2D, ValuesOutOfRangeAreErrors)
{
  const auto expectError = [this](const char* words)
  {
    this->Heard.Errors.clear();
    EXPECT_EQ(this->run(refinedSquares())->GetNumberOfCells(), 0);
    ASSERT_EQ(this->Heard.Errors.size(), 1U);
    EXPECT_NE(this->Heard.Errors[0].find(words), std::string::npos) << this->Heard.Errors[0];
  };
  this->Filter->SetMinimumAngle(-5);
  expectError("MinimumAngle is -5; give a number from 0 to 34.");
  this->Filter->SetMinimumAngle(35);
  expectError("MinimumAngle is 35; give a number from 0 to 34.");
  this->Filter->SetMinimumAngle(30);
  this->Filter->SetMaximumArea(-1);
  expectError("MaximumArea is -1; give 0 or more.");
  this->Filter->SetMaximumArea(0);
  this->Filter->SetMostPoints(-1);
  expectError("MostPoints is -1; give 0 or more.");
}

TEST_F(Refine2D, AbortLeavesTheOutputEmpty)
{
  vtkNew<vtkCallbackCommand> abort;
  abort->SetCallback([](vtkObject* filter, unsigned long, void*, void*)
    { static_cast<vtkAlgorithm*>(filter)->SetAbortExecute(1); });
  this->Filter->AddObserver(vtkCommand::ProgressEvent, abort);
  this->Filter->SetMaximumArea(1e-4);
  EXPECT_EQ(this->run(refinedSquares())->GetNumberOfCells(), 0);
}

} // namespace
