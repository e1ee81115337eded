// SPDX-License-Identifier: BSD-3-Clause
// Properties of vtkTIPPDelaunay2D on several ranks, compared with one rank.
#include "RankData.h"

#include "vtkTIPPDelaunay2D.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataSetAttributes.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkMultiProcessController.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTransform.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace
{

using namespace tipp;
using namespace tipp::test;

using Configure = std::function<void(vtkTIPPDelaunay2D*)>;

/// A triangle, and for each of its corners the corners of the triangle opposite to it. All are
/// global point ids; -1: there is none.
struct Cell
{
  Triangle Corners;
  std::array<Triangle, 3> Neighbors;

  bool operator<(const Cell& other) const { return this->Corners < other.Corners; }
};

/// A triangle of an output.
struct OutputCell
{
  Triangle Corners; ///< as in the output
  std::int64_t Number;
  std::int64_t IsGhost;
  std::array<std::int64_t, 3> Neighbors; ///< numbers
};

/// The positions of points in space: of a rough surface, with some points close to others.
std::vector<Point3> surface(const std::string& kind, std::size_t count)
{
  const Coordinates xy = makePointSet(kind, count);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<Point3> points;
  for (std::size_t i = 0; i < xy.size() / 2; ++i)
  {
    const Point3 p = { xy[2 * i], xy[2 * i + 1], 0.1 * xy[2 * i] + 0.01 * uniform(random) };
    points.push_back(p);
    if (i % 7 == 0)
    {
      points.push_back({ p.x + 1e-3 * uniform(random), p.y + 1e-3 * uniform(random), p.z });
    }
  }
  std::shuffle(points.begin(), points.end(), random);
  return points;
}

/// The points whose indices the ids name, with the ids as global ids unless `withIds` is false.
vtkSmartPointer<vtkPolyData> dataOf(
  const std::vector<Point3>& points, const std::vector<PointId>& own, bool withIds)
{
  vtkNew<vtkPoints> positions;
  positions->SetDataTypeToDouble();
  vtkNew<vtkIdTypeArray> ids;
  ids->SetName("ids");
  for (const PointId id : own)
  {
    const Point3& p = points[std::size_t(id)];
    positions->InsertNextPoint(p.x, p.y, p.z);
    ids->InsertNextValue(id);
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(positions);
  if (withIds)
  {
    data->GetPointData()->SetGlobalIds(ids);
  }
  return data;
}

vtkSmartPointer<vtkPolyData> shareAsData(
  const std::vector<Point3>& points, Share share, bool withIds)
{
  const Coordinates none(2 * points.size(), 0);
  return dataOf(points, shareOf(none, share, rank(), ranks()).GlobalIds, withIds);
}

std::vector<OutputCell> outputCells(vtkPolyData* mesh)
{
  vtkDataArray* const neighbors = mesh->GetCellData()->GetArray("NeighborIds");
  vtkDataArray* const pointIds = mesh->GetPointData()->GetGlobalIds();
  vtkDataArray* const cellIds = mesh->GetCellData()->GetGlobalIds();
  auto* const ghosts = vtkUnsignedCharArray::SafeDownCast(
    mesh->GetCellData()->GetAbstractArray(vtkDataSetAttributes::GhostArrayName()));
  std::vector<OutputCell> cells;
  mesh->BuildCells();
  for (vtkIdType i = 0; i < mesh->GetNumberOfCells(); ++i)
  {
    vtkIdType size = 0;
    const vtkIdType* corners = nullptr;
    mesh->GetCellPoints(i, size, corners);
    OutputCell cell{ {}, cellIds ? idAt(cellIds, i) : i, ghosts && ghosts->GetValue(i) ? 1 : 0,
      { -1, -1, -1 } };
    for (int k = 0; k < 3; ++k)
    {
      cell.Corners[std::size_t(k)] = pointIds ? idAt(pointIds, corners[k]) : corners[k];
      if (neighbors)
      {
        cell.Neighbors[std::size_t(k)] =
          static_cast<vtkIdTypeArray*>(neighbors)->GetTypedComponent(i, k);
      }
    }
    cells.push_back(cell);
  }
  return cells;
}

/// Replaces numbers by corners, the lowest of which comes first. Ghosts must have the neighbours
/// that their owners have, and are left out.
std::vector<Cell> withCorners(const std::vector<OutputCell>& cells)
{
  std::map<std::int64_t, OutputCell> byNumber;
  for (const OutputCell& cell : cells)
  {
    if (cell.IsGhost == 0)
    {
      byNumber[cell.Number] = cell;
    }
  }
  std::vector<Cell> result;
  for (const OutputCell& cell : cells)
  {
    if (cell.IsGhost != 0)
    {
      EXPECT_EQ(byNumber.at(cell.Number).Neighbors, cell.Neighbors);
      continue;
    }
    Cell one{ cell.Corners, {} };
    for (std::size_t k = 0; k < 3; ++k)
    {
      const std::int64_t number = cell.Neighbors[k];
      const Triangle none = { -1, -1, -1 };
      const Triangle& of = number < 0 ? none : byNumber.at(number).Corners;
      one.Neighbors[k] = canonical(of[0], of[1], of[2]);
    }
    const auto lowest = std::min_element(one.Corners.begin(), one.Corners.end());
    const auto turn = lowest - one.Corners.begin();
    std::rotate(one.Corners.begin(), one.Corners.begin() + turn, one.Corners.end());
    std::rotate(one.Neighbors.begin(), one.Neighbors.begin() + turn, one.Neighbors.end());
    result.push_back(one);
  }
  std::sort(result.begin(), result.end());
  return result;
}

/// The merged points and their representatives, and rejected points with -1, sorted.
using Pairs = std::vector<std::pair<std::int64_t, std::int64_t>>;

Pairs gatherMerged(vtkPolyData* mesh)
{
  std::vector<std::array<std::int64_t, 2>> own;
  vtkFieldData* const data = mesh->GetFieldData();
  for (vtkIdType i = 0; i < data->GetArray("DuplicatePointIds")->GetNumberOfTuples(); ++i)
  {
    own.push_back({ idAt(data->GetArray("DuplicatePointIds"), i),
      idAt(data->GetArray("DuplicateRepresentativeIds"), i) });
  }
  for (vtkIdType i = 0; i < data->GetArray("RejectedPointIds")->GetNumberOfTuples(); ++i)
  {
    own.push_back({ idAt(data->GetArray("RejectedPointIds"), i), -1 });
  }
  Communicator box(vtkMultiProcessController::GetGlobalController());
  Pairs all;
  for (const auto& part : box.gather(own))
  {
    for (const auto& [point, representative] : part)
    {
      all.emplace_back(point, representative);
    }
  }
  box.barrier();
  std::sort(all.begin(), all.end());
  return all;
}

Pairs mergedOf(vtkPolyData* mesh)
{
  Pairs all;
  vtkDataArray* const ids = mesh->GetPointData()->GetArray("RepresentativePointId");
  for (vtkIdType i = 0; ids && i < ids->GetNumberOfTuples(); ++i)
  {
    if (idAt(ids, i) != i)
    {
      all.emplace_back(i, idAt(ids, i));
    }
  }
  return all;
}

/// Expects that the ranks together have the triangles, neighbours and merged points of one rank.
void expectSameAsOneRank(
  const std::vector<Point3>& points, const Configure& configure, int ghostLevels = 0)
{
  std::vector<PointId> all(points.size());
  std::iota(all.begin(), all.end(), 0);
  vtkNew<vtkTIPPDelaunay2D> alone;
  alone->SetController(nullptr);
  alone->SetInputData(dataOf(points, all, false));
  configure(alone);
  alone->Update();
  const std::vector<Cell> expected = withCorners(outputCells(alone->GetOutput()));
  EXPECT_FALSE(expected.empty());
  for (const Share share : { Share::Blocks, Share::Uneven, Share::AllOnLast })
  {
    SCOPED_TRACE(nameOf(share));
    vtkNew<vtkTIPPDelaunay2D> filter;
    filter->SetInputData(shareAsData(points, share, share != Share::Blocks));
    configure(filter);
    filter->UpdatePiece(rank(), ranks(), ghostLevels);
    const Pairs merged = ranks() > 1 ? gatherMerged(filter->GetOutput()) : Pairs();
    Communicator box(vtkMultiProcessController::GetGlobalController());
    std::vector<OutputCell> cells;
    for (const auto& part : box.gather(outputCells(filter->GetOutput())))
    {
      cells.insert(cells.end(), part.begin(), part.end());
    }
    box.barrier();
    EXPECT_EQ(alone->GetNumberOfDuplicatePoints(), filter->GetNumberOfDuplicatePoints());
    if (rank() > 0)
    {
      continue;
    }
    const std::vector<Cell> found = withCorners(cells);
    ASSERT_EQ(expected.size(), found.size());
    for (std::size_t i = 0; i < found.size(); ++i)
    {
      ASSERT_EQ(expected[i].Corners, found[i].Corners);
      ASSERT_EQ(expected[i].Neighbors, found[i].Neighbors);
    }
    if (ranks() > 1)
    {
      EXPECT_EQ(mergedOf(alone->GetOutput()), merged);
    }
  }
}

/// The cells of an output by global point ids: ascending, then -1.
using CellPoints = std::array<std::int64_t, 3>;

std::vector<CellPoints> cellPoints(vtkPolyData* mesh)
{
  vtkDataArray* const ids = mesh->GetPointData()->GetGlobalIds();
  std::vector<CellPoints> cells;
  mesh->BuildCells();
  for (vtkIdType i = 0; i < mesh->GetNumberOfCells(); ++i)
  {
    vtkIdType size = 0;
    const vtkIdType* corners = nullptr;
    mesh->GetCellPoints(i, size, corners);
    CellPoints cell = { -1, -1, -1 };
    std::transform(corners, corners + size, cell.begin(),
      [ids](vtkIdType point) { return ids ? idAt(ids, point) : point; });
    std::sort(cell.begin(), cell.begin() + size);
    cells.push_back(cell);
  }
  return cells;
}

/// Expects that the ranks together have the triangles, lines and vertices of one rank.
void expectSameAlphaShape(const std::vector<Point3>& points, const Configure& configure)
{
  std::vector<PointId> all(points.size());
  std::iota(all.begin(), all.end(), 0);
  vtkNew<vtkTIPPDelaunay2D> alone;
  alone->SetController(nullptr);
  alone->SetInputData(dataOf(points, all, false));
  configure(alone);
  vtkObject::GlobalWarningDisplayOff();
  alone->Update();
  std::vector<CellPoints> expected = cellPoints(alone->GetOutput());
  std::sort(expected.begin(), expected.end());
  EXPECT_FALSE(expected.empty());
  for (const Share share : { Share::Blocks, Share::Uneven, Share::AllOnLast })
  {
    SCOPED_TRACE(nameOf(share));
    vtkNew<vtkTIPPDelaunay2D> filter;
    filter->SetInputData(shareAsData(points, share, share != Share::Blocks));
    configure(filter);
    filter->Update();
    Communicator box(vtkMultiProcessController::GetGlobalController());
    std::vector<CellPoints> cells;
    for (const auto& part : box.gather(cellPoints(filter->GetOutput())))
    {
      cells.insert(cells.end(), part.begin(), part.end());
    }
    box.barrier();
    std::sort(cells.begin(), cells.end());
    if (rank() == 0)
    {
      EXPECT_EQ(expected.size(), cells.size());
      EXPECT_TRUE(expected == cells);
    }
  }
  vtkObject::GlobalWarningDisplayOn();
}

} // namespace

TEST(Delaunay2DOptionsOnRanks, AlphaShapeIsThatOfOneRank)
{
  for (const double alpha : { 0.005, 0.012, 0.03 })
  {
    expectSameAlphaShape(
      surface("uniform", 2000), [alpha](vtkTIPPDelaunay2D* filter) { filter->SetAlpha(alpha); });
  }
  expectSameAlphaShape(surface("uniform", 2000),
    [](vtkTIPPDelaunay2D* filter)
    {
      filter->SetAlpha(0.012);
      filter->AlphaTrisOff();
      filter->AlphaVertsOff();
    });
}

TEST(Delaunay2DOptionsOnRanks, AlphaShapeOfALatticeIsThatOfOneRank)
{
  std::vector<Point3> points;
  for (int i = 0; i < 900; ++i) // all circumradii are nearly equal
  {
    points.push_back({ 0.1 * (i % 30), 0.1 * (i / 30), 0.3 * (i % 30) });
  }
  std::shuffle(points.begin(), points.end(), std::mt19937(3));
  for (const double alpha : { 0.05 * std::sqrt(11.0), 0.16, 0.17 })
  {
    expectSameAlphaShape(points, [alpha](vtkTIPPDelaunay2D* filter) { filter->SetAlpha(alpha); });
  }
}

TEST(Delaunay2DOptionsOnRanks, AlphaShapeHasPointsWithoutTriangles)
{
  std::vector<Point3> points = surface("uniform", 500);
  expectSameAlphaShape(points,
    [](vtkTIPPDelaunay2D* filter)
    {
      filter->SetAlpha(0.1);
      filter->SetMaximumEdgeLength(0.02);
      filter->SetTolerance(1e-4);
    });
  for (Point3& p : points)
  {
    p.y = 2 * p.x;
  }
  points[7] = points[5];
  points[9].x = NAN;
  expectSameAlphaShape(points, [](vtkTIPPDelaunay2D* filter) { filter->SetAlpha(0.1); });
}

TEST(Delaunay2DOptionsOnRanks, NeighborIdsAreTheTrianglesAcrossTheEdges)
{
  for (const bool isGathered : { false, true })
  {
    for (const int ghostLevels : { 0, 1 })
    {
      expectSameAsOneRank(
        surface("uniform", 3000),
        [isGathered](vtkTIPPDelaunay2D* filter)
        {
          filter->GenerateNeighborIdsOn();
          filter->SetGatherOnFirstRank(isGathered);
        },
        ghostLevels);
    }
  }
}

TEST(Delaunay2DOptionsOnRanks, MaximumEdgeLengthLeavesOutTheSameTriangles)
{
  for (const double longest : { 0.02, 0.05, 1e-4 })
  {
    std::vector<Point3> points = surface("uniform", 3000);
    // A few points without a short edge.
    points.push_back({ -3, 5, 0 });
    points.push_back({ 4, -2, 0 });
    points.push_back({ 0.5, 0.5, 0 });
    points.push_back({ 0.5 + 1e-5, 0.5, 0 });
    points.push_back({ 0.5, 0.5 + 1e-5, 0 });
    expectSameAsOneRank(
      points,
      [longest](vtkTIPPDelaunay2D* filter)
      {
        filter->SetMaximumEdgeLength(longest);
        filter->GenerateNeighborIdsOn();
      },
      1);
  }
}

TEST(Delaunay2DOptionsOnRanks, ToleranceMergesTheSamePoints)
{
  for (const double tolerance : { 1e-9, 5e-4, 0.02, 0.2 })
  {
    expectSameAsOneRank(surface("uniform", 2000),
      [tolerance](vtkTIPPDelaunay2D* filter) { filter->SetTolerance(tolerance); });
  }
}

TEST(Delaunay2DOptionsOnRanks, PointsThatAreNotFiniteAreRejectedBesideATolerance)
{
  std::vector<Point3> points = surface("uniform", 500);
  points[3].x = NAN;
  points[points.size() - 2].y = INFINITY;
  expectSameAsOneRank(points, [](vtkTIPPDelaunay2D* filter) { filter->SetTolerance(0.01); });
}

TEST(Delaunay2DOptionsOnRanks, BestFittingPlaneIsThatOfOneRank)
{
  std::vector<Point3> points = surface("uniform", 3000);
  for (Point3& p : points) // nearly upright, so that another plane gives other triangles
  {
    p = { p.x, 0.3 * p.x + p.z, 0.9 * p.y - 0.1 * p.x };
  }
  expectSameAsOneRank(points,
    [](vtkTIPPDelaunay2D* filter) { filter->SetProjectionPlaneMode(VTK_BEST_FITTING_PLANE); });
}

TEST(Delaunay2DOptionsOnRanks, BoundingTriangulationHasTheSamePoints)
{
  expectSameAsOneRank(surface("uniform", 2000),
    [](vtkTIPPDelaunay2D* filter)
    {
      filter->BoundingTriangulationOn();
      filter->SetOffset(1.5);
    });
}

TEST(Delaunay2DOptionsOnRanks, PropertiesOfTheFirstRankCount)
{
  const std::vector<Point3> points = surface("uniform", 1000);
  expectSameAsOneRank(points,
    [](vtkTIPPDelaunay2D* filter)
    {
      const bool counts = rank() == 0 || !filter->GetController();
      filter->SetTolerance(counts ? 0.002 : 0.05);
      filter->SetMaximumEdgeLength(counts ? 0.2 : 0);
    });
}
