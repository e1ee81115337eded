// SPDX-License-Identifier: BSD-3-Clause
#include "Sampling/RemapMesh.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>

namespace
{

using namespace tipp;

/// A grid of `columns` x `rows` unit squares from (x, y) on. Square i of the source has the value
/// i, and each point its coordinate x.
vtkSmartPointer<vtkPolyData> squares(double x, double y, int columns, int rows)
{
  const vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  const vtkNew<vtkDoubleArray> atPoints;
  atPoints->SetName("x");
  for (int i = 0; i < (columns + 1) * (rows + 1); ++i)
  {
    const double at = x + i % (columns + 1);
    points->InsertNextPoint(at, y + double(i / (columns + 1)), 0);
    atPoints->InsertNextValue(at);
  }
  const vtkNew<vtkCellArray> cells;
  const vtkNew<vtkDoubleArray> ofCells;
  ofCells->SetName("number");
  for (int i = 0; i < columns * rows; ++i)
  {
    const vtkIdType corner = i / columns * (columns + 1) + i % columns;
    const vtkIdType corners[4] = { corner, corner + 1, corner + columns + 2, corner + columns + 1 };
    cells->InsertNextCell(4, corners);
    ofCells->InsertNextValue(i);
  }
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->SetPoints(points);
  mesh->SetPolys(cells);
  mesh->GetPointData()->AddArray(atPoints);
  mesh->GetCellData()->AddArray(ofCells);
  return mesh;
}

double valueOf(vtkPointSet* mesh, const char* name, vtkIdType cell)
{
  return mesh->GetCellData()->GetArray(name)->GetComponent(cell, 0);
}

TEST(MeshRemapper, PolygonsAreAveragedAsAWhole)
{
  // The target's square covers half of the source's squares 0 and 1.
  MeshRemapper remapper(squares(0.5, 0, 1, 1), {}, 2);
  ASSERT_TRUE(remapper.add(squares(0, 0, 2, 1), {}));
  const auto result = remapper.finish(-1);
  EXPECT_EQ(result->GetNumberOfCells(), 1);
  EXPECT_DOUBLE_EQ(valueOf(result, "number", 0), 0.5);
  EXPECT_DOUBLE_EQ(valueOf(result, "x", 0), 1);
  EXPECT_DOUBLE_EQ(valueOf(result, "CoveredShare", 0), 1);
}

TEST(MeshRemapper, CellsThatAreNotCoveredHaveTheNullValue)
{
  MeshRemapper remapper(squares(0, 0, 2, 1), { "number" }, 1);
  ASSERT_TRUE(remapper.add(squares(0, 0, 1, 1), {}));
  const auto result = remapper.finish(-7);
  EXPECT_EQ(valueOf(result, "number", 0), 0);
  EXPECT_EQ(valueOf(result, "number", 1), -7);
  EXPECT_EQ(valueOf(result, "CoveredShare", 1), 0);
  EXPECT_EQ(remapper.covered(), 1);
  EXPECT_EQ(result->GetCellData()->GetArray("x"), nullptr);
}

TEST(MeshRemapper, PartsAddUpToTheWhole)
{
  MeshRemapper remapper(squares(0.25, 0.25, 1, 1), { "x" }, 1);
  ASSERT_TRUE(remapper.add(squares(0, 0, 1, 2), {}));
  ASSERT_TRUE(remapper.add(squares(1, 0, 1, 2), {}));
  const auto result = remapper.finish(0);
  EXPECT_DOUBLE_EQ(valueOf(result, "x", 0), 0.75);
  EXPECT_DOUBLE_EQ(valueOf(result, "CoveredShare", 0), 1);
}

TEST(MeshRemapper, OverlappingCellsEachCount)
{
  MeshRemapper remapper(squares(0, 0, 1, 1), { "number" }, 1);
  ASSERT_TRUE(remapper.add(squares(0, 0, 1, 1), {}));
  ASSERT_TRUE(remapper.add(squares(-1, 0, 2, 1), {}));
  const auto result = remapper.finish(0);
  EXPECT_DOUBLE_EQ(valueOf(result, "CoveredShare", 0), 2);
  EXPECT_DOUBLE_EQ(valueOf(result, "number", 0), 0.5);
  EXPECT_EQ(remapper.coveredTwice(), 1);
}

TEST(MeshRemapper, AnArrayThatTheSourceLacksIsNamedBeforeTheWork)
{
  MeshRemapper remapper(squares(0, 0, 1, 1), { "depth" }, 1);
  try
  {
    remapper.add(squares(0, 0, 1, 1), {});
    FAIL() << "the array is not there";
  }
  catch (const std::runtime_error& error)
  {
    EXPECT_NE(std::string(error.what()).find("'depth'"), std::string::npos) << error.what();
  }
}

} // namespace
