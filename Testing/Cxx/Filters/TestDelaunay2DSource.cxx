// SPDX-License-Identifier: BSD-3-Clause
// vtkTIPPDelaunay2D with a second input of lines and polygons.
#include "Delaunay2DTesting.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkIdTypeArray.h"
#include "vtkPointData.h"
#include "vtkTable.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace
{

using namespace testing_delaunay;
using Ids = std::vector<vtkIdType>;

/// A source of lines and polygons between points of the input.
vtkSmartPointer<vtkPolyData> sourceOf(
  const std::vector<Ids>& lines, const std::vector<Ids>& polygons)
{
  auto source = vtkSmartPointer<vtkPolyData>::New();
  const auto cells = [](const std::vector<Ids>& lists)
  {
    auto array = vtkSmartPointer<vtkCellArray>::New();
    for (const Ids& ids : lists)
    {
      array->InsertNextCell(vtkIdType(ids.size()), ids.data());
    }
    return array;
  };
  source->SetLines(cells(lines));
  source->SetPolys(cells(polygons));
  return source;
}

/// A square with a centre point, and a smaller square inside it.
const std::vector<Point3> Squares{ { 0, 0, 0 }, { 8, 0, 0 }, { 8, 8, 8 }, { 0, 8, 8 }, { 3, 3, 0 },
  { 5, 3, 0 }, { 5, 5, 0 }, { 3, 5, 0 }, { 4, 4.25, 0 } };

bool tells(const std::vector<std::string>& messages, const std::string& text)
{
  return std::any_of(messages.begin(), messages.end(),
    [&text](const std::string& message) { return message.find(text) != std::string::npos; });
}

double areaOf(vtkPolyData* mesh)
{
  double area = 0;
  for (vtkIdType c = 0; c < mesh->GetNumberOfPolys(); ++c)
  {
    vtkIdType count = 0;
    const vtkIdType* ids = nullptr;
    mesh->GetPolys()->GetCellAtId(c, count, ids);
    double p[3][3];
    for (int i = 0; i < 3; ++i)
    {
      mesh->GetPoint(ids[i], p[i]);
    }
    area +=
      ((p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[1][1] - p[0][1]) * (p[2][0] - p[0][0])) / 2;
  }
  return area;
}

bool hasEdge(vtkPolyData* mesh, vtkIdType a, vtkIdType b)
{
  for (vtkIdType c = 0; c < mesh->GetNumberOfPolys(); ++c)
  {
    vtkIdType count = 0;
    const vtkIdType* ids = nullptr;
    mesh->GetPolys()->GetCellAtId(c, count, ids);
    if (std::count(ids, ids + 3, a) && std::count(ids, ids + 3, b))
    {
      return true;
    }
  }
  return false;
}

class Source : public testing::Test
{
protected:
  Source() { this->Filter->SetController(nullptr); }

  vtkPolyData* run(vtkPolyData* input, vtkPolyData* source)
  {
    this->Filter->SetInputData(input);
    this->Filter->SetSourceData(source);
    this->Filter->Update();
    return this->Filter->GetOutput();
  }

  vtkIdType total(const char* name)
  {
    return vtkIdType(
      this->Filter->GetStatistics()->GetFieldData()->GetArray(name)->GetComponent(0, 0));
  }

  vtkNew<vtkTIPPDelaunay2D> Filter;
  Messages Heard{ this->Filter.Get() };
  Messages OfPipeline{ this->Filter->GetExecutive() }; // suppresses their printing
};

TEST_F(Source, PolylineIsAChainOfEdges)
{
  const auto input = dataset(randomPoints(500));
  vtkPolyData* const mesh = this->run(input, sourceOf({ { 1, 2, 3 } }, {}));
  EXPECT_TRUE(this->Heard.Errors.empty());
  EXPECT_EQ(this->total("Constraints"), 2);
  ASSERT_EQ(this->total("ConstraintEdges"), 2 + this->total("CrossingPoints"));
  EXPECT_TRUE(hasEdge(mesh, 1, 2));
  EXPECT_TRUE(hasEdge(mesh, 2, 3));
}

TEST_F(Source, CounterClockwisePolygonKeepsItsInside)
{
  vtkPolyData* const mesh = this->run(dataset(Squares), sourceOf({}, { { 4, 5, 6, 7 } }));
  EXPECT_EQ(4, areaOf(mesh));
  EXPECT_EQ(4, mesh->GetNumberOfPolys());
  EXPECT_EQ(9, mesh->GetNumberOfPoints());
}

TEST_F(Source, ClockwisePolygonIsAHole)
{
  EXPECT_EQ(60, areaOf(this->run(dataset(Squares), sourceOf({}, { { 7, 6, 5, 4 } }))));
  EXPECT_EQ(
    60, areaOf(this->run(dataset(Squares), sourceOf({}, { { 0, 1, 2, 3 }, { 7, 6, 5, 4 } }))));
}

TEST_F(Source, PolygonsNest)
{
  // A country with a lake, which has an island.
  std::vector<Point3> points = Squares;
  points.insert(points.end(), { { 1, 1, 0 }, { 7, 1, 0 }, { 7, 7, 0 }, { 1, 7, 0 } });
  const auto source = sourceOf({}, { { 0, 1, 2, 3 }, { 12, 11, 10, 9 }, { 4, 5, 6, 7 } });
  EXPECT_EQ(64 - 36 + 4, areaOf(this->run(dataset(points), source)));
}

TEST_F(Source, PolygonsMayShareAnEdge)
{
  const std::vector<Point3> points{ { 0, 0, 0 }, { 2, 0, 0 }, { 2, 2, 0 }, { 0, 2, 0 }, { 4, 0, 0 },
    { 4, 2, 0 }, { 9, 9, 0 } };
  EXPECT_EQ(
    8, areaOf(this->run(dataset(points), sourceOf({}, { { 0, 1, 2, 3 }, { 1, 4, 5, 2 } }))));
}

TEST_F(Source, CrossingIsANewPointWithInterpolatedData)
{
  const auto input = dataset(Squares, VTK_FLOAT);
  vtkNew<vtkFloatArray> depth;
  depth->SetName("depth");
  for (int i = 0; i < 9; ++i)
  {
    depth->InsertNextValue(float(i));
  }
  input->GetPointData()->AddArray(depth);
  vtkPolyData* const mesh = this->run(input, sourceOf({ { 0, 2 }, { 5, 7 } }, {}));
  EXPECT_TRUE(this->Heard.Errors.empty());
  ASSERT_EQ(10, mesh->GetNumberOfPoints());
  EXPECT_EQ(VTK_DOUBLE, mesh->GetPoints()->GetDataType());
  const double* const p = mesh->GetPoint(9);
  EXPECT_EQ(4, p[0]);
  EXPECT_EQ(4, p[1]);
  EXPECT_EQ(0, p[2]) << "between points 4 and 6, which are on the first line";
  EXPECT_EQ(5, mesh->GetPointData()->GetArray("depth")->GetComponent(9, 0));
  EXPECT_EQ(8, mesh->GetPointData()->GetArray("depth")->GetComponent(8, 0));
  EXPECT_EQ(1, this->total("CrossingPoints"));
  EXPECT_EQ(64, areaOf(mesh));
}

TEST_F(Source, CrossingIsAnErrorUnlessSplit)
{
  this->Filter->SplitCrossingsOff();
  this->run(dataset(Squares), sourceOf({ { 0, 2 }, { 5, 7 } }, {}));
  EXPECT_TRUE(tells(this->Heard.Errors, "constraint 0 (points 0 and 2) crosses"));
  EXPECT_EQ(0, this->Filter->GetOutput()->GetNumberOfPolys());
}

TEST_F(Source, InvalidPointIdIsAnError)
{
  this->run(dataset(Squares), sourceOf({ { 0, 9 } }, {}));
  EXPECT_TRUE(
    tells(this->Heard.Errors, "cell 0 of the source names point 9, but the input has 9 points"));
}

TEST_F(Source, PolygonWithACornerThatIsNotFiniteIsAnError)
{
  std::vector<Point3> points = Squares;
  points[5].x = std::numeric_limits<double>::quiet_NaN();
  this->run(dataset(points), sourceOf({}, { { 4, 5, 6, 7 } }));
  EXPECT_TRUE(tells(this->Heard.Errors, "a polygon, has the corner 5"));
}

TEST_F(Source, LineWithAnEndThatIsNotFiniteIsLeftOutWithAWarning)
{
  std::vector<Point3> points = Squares;
  points[5].x = std::numeric_limits<double>::quiet_NaN();
  vtkPolyData* const mesh = this->run(dataset(points), sourceOf({ { 4, 5, 6 }, { 0, 2 } }, {}));
  EXPECT_EQ(64, areaOf(mesh));
  EXPECT_TRUE(tells(this->Heard.Warnings, "2 edges of the source have an end"));
}

TEST_F(Source, SourcePointsAreMergedByCoordinates)
{
  const auto source = dataset({ { 8, 8, 99 }, { 4, 0, 1 }, { 0, 0, 5 } });
  source->SetLines(sourceOf({ { 2, 1, 0 } }, {})->GetLines());
  this->Filter->MergeSourcePointsOn();
  vtkPolyData* const mesh = this->run(dataset(Squares), source);
  EXPECT_TRUE(this->Heard.Errors.empty());
  ASSERT_EQ(10, mesh->GetNumberOfPoints());
  EXPECT_EQ(8, mesh->GetPoint(2)[2]) << "the input's point counts";
  EXPECT_EQ(1, mesh->GetPoint(9)[2]);
  EXPECT_TRUE(hasEdge(mesh, 0, 9));
  EXPECT_TRUE(hasEdge(mesh, 9, 2) || this->total("CrossingPoints") > 0);
}

TEST_F(Source, LinesMarkConstraints)
{
  this->Filter->SetConstraintMarks(vtkTIPPDelaunay2D::LINES);
  vtkPolyData* const mesh =
    this->run(dataset(Squares), sourceOf({ { 0, 4 }, { 6, 2 } }, { { 4, 5, 6, 7 } }));
  ASSERT_EQ(6, mesh->GetNumberOfLines());
  vtkDataArray* const ids = mesh->GetCellData()->GetArray("ConstraintId");
  ASSERT_NE(nullptr, ids);
  ASSERT_EQ(mesh->GetNumberOfCells(), ids->GetNumberOfTuples());
  const std::vector<double> expected{ 0, 1, 2, 2, 2, 2, -1 };
  for (std::size_t i = 0; i < expected.size(); ++i)
  {
    EXPECT_EQ(expected[i], ids->GetComponent(vtkIdType(i), 0)) << i;
  }
}

TEST_F(Source, FlagsMarkConstraints)
{
  this->Filter->SetConstraintMarks(vtkTIPPDelaunay2D::EDGE_FLAGS);
  vtkPolyData* const mesh = this->run(dataset(Squares), sourceOf({}, { { 4, 5, 6, 7 } }));
  auto* const flags =
    vtkUnsignedCharArray::SafeDownCast(mesh->GetCellData()->GetArray("ConstraintEdges"));
  ASSERT_NE(nullptr, flags);
  ASSERT_EQ(4, flags->GetNumberOfTuples());
  for (vtkIdType c = 0; c < 4; ++c)
  {
    vtkIdType count = 0;
    const vtkIdType* ids = nullptr;
    mesh->GetPolys()->GetCellAtId(c, count, ids);
    for (int i = 0; i < 3; ++i)
    {
      EXPECT_EQ(ids[i] == 8 ? 1 : 0, flags->GetComponent(c, i)) << "opposite to the middle";
    }
  }
}

TEST_F(Source, NeighborsAreThoseOfTheConstrainedTriangles)
{
  this->Filter->GenerateNeighborIdsOn();
  vtkPolyData* const mesh = this->run(dataset(Squares), sourceOf({}, { { 4, 5, 6, 7 } }));
  vtkDataArray* const neighbors = mesh->GetCellData()->GetArray("NeighborIds");
  ASSERT_EQ(4, neighbors->GetNumberOfTuples());
  int hull = 0;
  for (vtkIdType c = 0; c < 4; ++c)
  {
    for (int i = 0; i < 3; ++i)
    {
      hull += neighbors->GetComponent(c, i) == -1;
    }
  }
  EXPECT_EQ(4, hull);
}

TEST_F(Source, ToleranceIsRefused)
{
  this->Filter->SetTolerance(0.001);
  this->run(dataset(Squares), sourceOf({ { 0, 2 } }, {}));
  EXPECT_TRUE(tells(this->Heard.Errors, "Tolerance does not go with a source"));
}

TEST_F(Source, WithoutItTheTriangulationIsPlainAgain)
{
  this->run(dataset(Squares), sourceOf({}, { { 4, 5, 6, 7 } }));
  EXPECT_NE(nullptr, this->Filter->GetSource());
  this->Filter->SetSourceConnection(nullptr);
  this->Filter->Update();
  EXPECT_EQ(nullptr, this->Filter->GetSource());
  EXPECT_EQ(64, areaOf(this->Filter->GetOutput()));
}

} // namespace
