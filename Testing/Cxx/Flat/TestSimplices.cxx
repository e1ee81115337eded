// SPDX-License-Identifier: BSD-3-Clause
#include "Flat/FlattenDataSet.h"

#include "ExpectIOError.h"

#include "vtkCellType.h"
#include "vtkDataSetAttributes.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <random>

namespace
{

using tipp::flattenDataSet;
using tipp::Flattened;
using CellPoints = std::vector<vtkIdType>;

class FlattenedCells : public testing::Test
{
protected:
  FlattenedCells() { this->Grid->SetPoints(this->Points); }

  void insertPoints(std::initializer_list<std::array<double, 3>> points)
  {
    for (const auto& p : points)
    {
      this->Points->InsertNextPoint(p.data());
    }
  }

  void insert(int type, const CellPoints& ids)
  {
    this->Grid->InsertNextCell(type, vtkIdType(ids.size()), ids.data());
  }

  void insertUnitCube()
  {
    this->insertPoints({ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 }, { 0, 0, 1 },
      { 1, 0, 1 }, { 1, 1, 1 }, { 0, 1, 1 } });
  }

  const vtkNew<vtkPoints> Points;
  const vtkNew<vtkUnstructuredGrid> Grid;
};

std::int64_t count(const Flattened& simplices)
{
  return std::int64_t(simplices.Content.Cells.size()) / simplices.Content.CellSize;
}

/// The id of each simplex's cell in the data set; empty if no cell was cut or left out.
std::vector<std::int64_t> parentsOf(const Flattened& simplices)
{
  for (const tipp::FlatArray& array : simplices.Content.CellData)
  {
    if (array.Name == "vtkOriginalCellIds")
    {
      const auto* const ids = static_cast<const std::int64_t*>(array.Values);
      return { ids, ids + array.Tuples };
    }
  }
  return {};
}

/// The sum of all areas or volumes. Volumes must be positive.
double measure(vtkDataSet* data, const Flattened& simplices)
{
  double sum = 0;
  for (std::int64_t i = 0; i < count(simplices); ++i)
  {
    double p[4][3] = {};
    for (int c = 0; c < simplices.Content.CellSize; ++c)
    {
      data->GetPoint(
        simplices.Content.Cells[std::size_t(i * simplices.Content.CellSize + c)], p[c]);
    }
    double e[3][3];
    for (int axis = 0; axis < 3; ++axis)
    {
      e[0][axis] = p[1][axis] - p[0][axis];
      e[1][axis] = p[2][axis] - p[0][axis];
      e[2][axis] = p[3][axis] - p[0][axis];
    }
    const double normal[] = { e[0][1] * e[1][2] - e[0][2] * e[1][1],
      e[0][2] * e[1][0] - e[0][0] * e[1][2], e[0][0] * e[1][1] - e[0][1] * e[1][0] };
    if (simplices.Content.CellSize == 3)
    {
      sum += std::hypot(normal[0], normal[1], normal[2]) / 2;
      continue;
    }
    const double six = normal[0] * e[2][0] + normal[1] * e[2][1] + normal[2] * e[2][2];
    EXPECT_GT(six, 0);
    sum += six / 6;
  }
  return sum;
}

/// For each triangle, the number of tetrahedra that have it as a facet.
std::map<std::array<std::int64_t, 3>, int> sides(const Flattened& simplices)
{
  std::map<std::array<std::int64_t, 3>, int> counts;
  for (std::size_t i = 0; i < simplices.Content.Cells.size(); i += 4)
  {
    for (std::size_t left = 0; left < 4; ++left)
    {
      std::array<std::int64_t, 3> side{};
      std::size_t at = 0;
      for (std::size_t corner = 0; corner < 4; ++corner)
      {
        if (corner != left)
        {
          side[at++] = simplices.Content.Cells[i + corner];
        }
      }
      std::sort(side.begin(), side.end());
      ++counts[side];
    }
  }
  return counts;
}

} // namespace

TEST_F(FlattenedCells, TrianglesAreTheSameTriangles)
{
  this->insertPoints({ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } });
  this->insert(VTK_TRIANGLE, { 0, 1, 2 });
  this->insert(VTK_TRIANGLE, { 2, 3, 0 });
  const Flattened simplices = flattenDataSet(this->Grid, "a");
  EXPECT_EQ(3, simplices.Content.CellSize);
  EXPECT_EQ((std::vector<std::int64_t>{ 0, 1, 2, 2, 3, 0 }), simplices.Content.Cells);
  EXPECT_TRUE(parentsOf(simplices).empty());
  EXPECT_TRUE(simplices.Cut.empty());
}

TEST_F(FlattenedCells, EveryKindOfPlaneCellCoverIt)
{
  this->insertPoints({ { 0, 0, 0 }, { 2, 0, 0 }, { 2, 1, 0 }, { 1, 2, 0 }, { 0, 1, 0 } });
  this->insert(VTK_QUAD, { 0, 1, 2, 4 });
  this->insert(VTK_TRIANGLE, { 4, 2, 3 });
  const Flattened simplices = flattenDataSet(this->Grid, "a");
  EXPECT_EQ(3, count(simplices));
  EXPECT_EQ((std::vector<std::int64_t>{ 0, 0, 1 }), parentsOf(simplices));
  EXPECT_EQ(1, simplices.Cut.at("vtkQuad"));
  EXPECT_DOUBLE_EQ(3, measure(this->Grid, simplices));

  vtkNew<vtkUnstructuredGrid> others;
  others->SetPoints(this->Points);
  const vtkIdType polygon[] = { 0, 1, 2, 3, 4 };
  const vtkIdType pixel[] = { 0, 1, 4, 2 };
  const vtkIdType strip[] = { 0, 1, 4, 2 };
  others->InsertNextCell(VTK_POLYGON, 5, polygon);
  others->InsertNextCell(VTK_PIXEL, 4, pixel);
  others->InsertNextCell(VTK_TRIANGLE_STRIP, 4, strip);
  EXPECT_DOUBLE_EQ(3 + 2 + 2, measure(others, flattenDataSet(others, "a")));
}

TEST_F(FlattenedCells, AConcavePolygonStayInsideIt)
{
  this->insertPoints({ { 0, 0, 0 }, { 2, 0, 0 }, { 2, 2, 0 }, { 1, 0.5, 0 }, { 0, 2, 0 } });
  this->insert(VTK_POLYGON, { 0, 1, 2, 3, 4 });
  EXPECT_NEAR(2.5, measure(this->Grid, flattenDataSet(this->Grid, "a")), 1e-12);
}

TEST_F(FlattenedCells, EveryKindOfSolidCellFillIt)
{
  this->insertUnitCube();
  const std::pair<int, CellPoints> cells[] = { { VTK_HEXAHEDRON, { 0, 1, 2, 3, 4, 5, 6, 7 } },
    { VTK_VOXEL, { 0, 1, 3, 2, 4, 5, 7, 6 } }, { VTK_WEDGE, { 0, 1, 3, 4, 5, 7 } },
    { VTK_PYRAMID, { 0, 1, 2, 3, 4 } }, { VTK_TETRA, { 0, 1, 3, 4 } } };
  const double volumes[] = { 1, 1, 0.5, 1 / 3.0, 1 / 6.0 };
  for (std::size_t i = 0; i < 5; ++i)
  {
    vtkNew<vtkUnstructuredGrid> grid;
    grid->SetPoints(this->Points);
    grid->InsertNextCell(cells[i].first, vtkIdType(cells[i].second.size()), cells[i].second.data());
    const Flattened simplices = flattenDataSet(grid, "a");
    EXPECT_EQ(4, simplices.Content.CellSize);
    EXPECT_NEAR(volumes[i], measure(grid, simplices), 1e-12) << i;
  }
}

// Cubes of a lattice whose points are numbered at random. Neighbouring cubes must cut their common
// face along the same diagonal: each facet inside belongs to two tetrahedra.
TEST_F(FlattenedCells, NeighboursAgreeOnTheirFaces)
{
  constexpr vtkIdType n = 5;
  std::vector<vtkIdType> number(n * n * n);
  std::iota(number.begin(), number.end(), vtkIdType(0));
  std::shuffle(number.begin(), number.end(), std::mt19937(4));
  this->Points->SetNumberOfPoints(n * n * n);
  const auto at = [&](vtkIdType i, vtkIdType j, vtkIdType k)
  { return number[std::size_t(i + n * (j + n * k))]; };
  for (vtkIdType k = 0; k < n; ++k)
  {
    for (vtkIdType j = 0; j < n; ++j)
    {
      for (vtkIdType i = 0; i < n; ++i)
      {
        this->Points->SetPoint(at(i, j, k), double(i), double(j), double(k));
        if (i > 0 && j > 0 && k > 0)
        {
          this->insert(VTK_HEXAHEDRON,
            { at(i - 1, j - 1, k - 1), at(i, j - 1, k - 1), at(i, j, k - 1), at(i - 1, j, k - 1),
              at(i - 1, j - 1, k), at(i, j - 1, k), at(i, j, k), at(i - 1, j, k) });
        }
      }
    }
  }
  const Flattened simplices = flattenDataSet(this->Grid, "a");
  EXPECT_NEAR(64, measure(this->Grid, simplices), 1e-9);
  int alone = 0;
  for (const auto& [side, count] : sides(simplices))
  {
    EXPECT_LE(count, 2);
    alone += count == 1;
  }
  EXPECT_EQ(6 * 16 * 2, alone);
}

TEST_F(FlattenedCells, AnImageFillIt)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(3, 4, 2);
  const Flattened simplices = flattenDataSet(image, "a");
  EXPECT_NEAR(6, measure(image, simplices), 1e-12);
  EXPECT_EQ(6, simplices.Cut.at("vtkVoxel"));
}

TEST_F(FlattenedCells, OfMixedDimensionsReportTheCellsLeftOut)
{
  this->insertUnitCube();
  this->insert(VTK_TRIANGLE, { 0, 1, 2 });
  this->insert(VTK_TETRA, { 0, 1, 3, 4 });
  this->insert(VTK_LINE, { 0, 1 });
  this->insert(VTK_LINE, { 2, 1 });
  this->insert(VTK_VERTEX, { 2 });
  const Flattened simplices = flattenDataSet(this->Grid, "a");
  EXPECT_EQ(1, count(simplices));
  EXPECT_EQ((std::vector<std::int64_t>{ 1 }), parentsOf(simplices));
  EXPECT_EQ(1, simplices.LeftOut.at("vtkTriangle"));
  EXPECT_EQ(2, simplices.LeftOut.at("vtkLine"));
  EXPECT_EQ(1, simplices.LeftOut.at("vtkVertex"));
}

TEST_F(FlattenedCells, GhostCellsAreLeftOut)
{
  this->insertPoints({ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } });
  this->insert(VTK_TRIANGLE, { 0, 1, 2 });
  this->insert(VTK_TRIANGLE, { 2, 3, 0 });
  this->Grid->AllocateCellGhostArray()->SetValue(0, vtkDataSetAttributes::DUPLICATECELL);
  const Flattened simplices = flattenDataSet(this->Grid, "a");
  EXPECT_EQ((std::vector<std::int64_t>{ 2, 3, 0 }), simplices.Content.Cells);
  EXPECT_EQ(1, simplices.GhostCells);
}

TEST_F(FlattenedCells, DataWithoutAreaAreRefused)
{
  this->insertPoints({ { 0, 0, 0 }, { 1, 0, 0 } });
  this->insert(VTK_LINE, { 0, 1 });
  tipp::test::expectIOError(
    "a.vtu", "no cells with an area", [&] { flattenDataSet(this->Grid, "a.vtu"); });
}

TEST_F(FlattenedCells, OfCurvedCellsFollowTheirPointsOrAreRefused)
{
  this->insertPoints(
    { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0.5, 0, 0 }, { 0.5, 0.5, 0 }, { 0, 0.5, 0 } });
  this->insert(VTK_QUADRATIC_TRIANGLE, { 0, 1, 2, 3, 4, 5 });
  const Flattened simplices = flattenDataSet(this->Grid, "a");
  EXPECT_EQ(4, count(simplices));
  EXPECT_DOUBLE_EQ(0.5, measure(this->Grid, simplices));
  this->insert(VTK_QUADRATIC_QUAD, { 0, 1, 2, 3, 4, 5, 0, 1 });
  tipp::test::expectIOError("a.vtu", "curved", [&] { flattenDataSet(this->Grid, "a.vtu"); });
}
