// SPDX-License-Identifier: BSD-3-Clause
#include "MessageCounter.h"
#include "RangeResampleTesting.h"

#include "vtkCommand.h"
#include "vtkDataArraySelection.h"
#include "vtkPartitionedDataSet.h"
#include "vtkTypeInt64Array.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace
{

struct Said
{
  std::string Errors;
  std::string Warnings;
};

Said update(vtkRangeResampleFilter* filter)
{
  vtkNew<tipp::test::MessageCounter> errors;
  vtkNew<tipp::test::MessageCounter> warnings;
  filter->AddObserver(vtkCommand::ErrorEvent, errors);
  filter->AddObserver(vtkCommand::WarningEvent, warnings);
  filter->Update();
  return { errors->Text, warnings->Text };
}

const double infinity = std::numeric_limits<double>::infinity();
const std::vector<double> notFinite = { std::nan(""), infinity, -infinity };

vtkIdType cellsAt(vtkUnstructuredGrid* grid, vtkIdType point)
{
  vtkNew<vtkIdList> cells;
  grid->GetPointCells(point, cells);
  return cells->GetNumberOfIds();
}

/// The grid without the cells that have this point.
vtkSmartPointer<vtkUnstructuredGrid> without(vtkUnstructuredGrid* grid, vtkIdType point)
{
  const auto rest = vtkSmartPointer<vtkUnstructuredGrid>::New();
  rest->SetPoints(grid->GetPoints());
  rest->GetPointData()->ShallowCopy(grid->GetPointData());
  for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell)
  {
    vtkNew<vtkIdList> ids;
    grid->GetCellPoints(cell, ids);
    ids->IsId(point) < 0 ? rest->InsertNextCell(grid->GetCellType(cell), ids) : 0;
  }
  return rest;
}

vtkSmartPointer<vtkUnstructuredGrid> hexahedra()
{
  const auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> linear;
  linear->SetName("linear");
  for (int i = 0; i < 12; ++i)
  {
    const double p[3] = { 0.5 * (i % 3), i / 3 % 2 * 1.0, i / 6 * 1.0 };
    points->InsertNextPoint(p);
    linear->InsertNextValue(linearField(p));
  }
  grid->SetPoints(points);
  grid->GetPointData()->AddArray(linear);
  for (const vtkIdType first : { 0, 1 })
  {
    const vtkIdType ids[8] = { first, first + 1, first + 4, first + 3, first + 6, first + 7,
      first + 10, first + 9 };
    grid->InsertNextCell(VTK_HEXAHEDRON, 8, ids);
  }
  return grid;
}

} // namespace

TEST(RangeResampleDamaged, InvalidPointIdsAreAnError)
{
  for (const vtkTypeInt64 id :
    { vtkTypeInt64(-1), vtkTypeInt64(4), vtkTypeInt64(4294967299), vtkTypeInt64(999999999999) })
  {
    vtkNew<vtkTypeInt64Array> offsets;
    vtkNew<vtkTypeInt64Array> ids;
    for (const vtkTypeInt64 value : { vtkTypeInt64(0), vtkTypeInt64(1), id })
    {
      ids->InsertNextValue(value);
    }
    offsets->InsertNextValue(0);
    offsets->InsertNextValue(3);
    vtkNew<vtkCellArray> cells;
    cells->SetData(offsets.Get(), ids.Get());
    vtkNew<vtkPoints> points;
    points->SetNumberOfPoints(4);
    vtkNew<vtkUnstructuredGrid> grid;
    grid->SetPoints(points);
    grid->SetCells(VTK_TRIANGLE, cells);
    vtkNew<vtkPartitionedDataSet> parts;
    parts->SetPartition(0, grid);
    const auto filter = unitFilter(2, 5);
    for (vtkDataObject* input :
      { static_cast<vtkDataObject*>(grid), static_cast<vtkDataObject*>(parts) })
    {
      filter->SetInputDataObject(input);
      const std::string text = update(filter).Errors;
      EXPECT_NE(text.find("refer to point " + std::to_string(id)), std::string::npos) << text;
    }
  }
}

TEST(RangeResampleDamaged, CellsWithACornerThatIsNotFiniteAreLeftOutAndCounted)
{
  for (const int device :
    { vtkRangeResampleFilter::DEVICE_OPENMP, vtkRangeResampleFilter::DEVICE_OPENCL })
  {
    for (const int dimension : { 2, 3 })
    {
      for (int axis = 0; axis < dimension; ++axis)
      {
        for (const double bad : notFinite)
        {
          const auto grid = gridOf(jitteredScene(dimension, 4, 1));
          const vtkIdType point = grid->GetNumberOfPoints() / 2;
          const auto filter = unitFilter(dimension, dimension == 2 ? 400 : 60);
          filter->SetDevice(device);
          filter->SetInputData(without(grid, point));
          filter->Update();
          vtkNew<vtkImageData> expected;
          expected->DeepCopy(filter->GetOutput());
          const std::string count = std::to_string(cellsAt(grid, point)) + " cells have a corner";
          double p[3];
          grid->GetPoint(point, p);
          p[axis] = bad;
          grid->GetPoints()->SetPoint(point, p);
          grid->GetPoints()->Modified();
          filter->SetInputData(grid);
          const Said said = update(filter);
          EXPECT_EQ(said.Errors, "");
          EXPECT_NE(said.Warnings.find(count), std::string::npos) << said.Warnings;
          EXPECT_TRUE(sameArrays(expected, filter->GetOutput())) << device << axis << bad;
        }
      }
    }
  }
}

TEST(RangeResampleDamaged, AHexahedronIsLeftOutAsAWhole)
{
  const auto grid = hexahedra();
  grid->GetPoints()->SetPoint(0, std::nan(""), 0, 0);
  const auto filter = unitFilter(3, 9);
  filter->SetInputData(grid);
  const Said said = update(filter);
  EXPECT_NE(said.Warnings.find("1 cell has a corner"), std::string::npos) << said.Warnings;
  EXPECT_EQ(countValid(filter->GetOutput()), 5 * 9 * 9);
  EXPECT_LT(linearError(filter->GetOutput(), 3), 1e-12);
}

TEST(RangeResampleDamaged, HeightsOfASurfaceNeedNotBeFinite)
{
  const auto grid = gridOf(jitteredScene(2, 4, 1));
  const auto filter = unitFilter(2, 9);
  filter->SetInputData(grid);
  filter->Update();
  const vtkIdType all = countValid(filter->GetOutput());
  double p[3];
  grid->GetPoint(7, p);
  grid->GetPoints()->SetPoint(7, p[0], p[1], std::nan(""));
  grid->GetPoints()->Modified();
  EXPECT_EQ(update(filter).Warnings, "");
  EXPECT_EQ(countValid(filter->GetOutput()), all);
}

TEST(RangeResampleDamaged, BoundsAreThoseOfFinitePoints)
{
  for (const double bad : notFinite)
  {
    const auto grid = gridOf(jitteredScene(2, 4, 1));
    const auto filter = unitFilter(2, 9);
    filter->UseInputBoundsOn();
    filter->SetInputData(grid);
    grid->GetPoints()->SetPoint(7, bad, 100, 0);
    EXPECT_EQ(update(filter).Errors, "");
    double bounds[6];
    filter->GetOutput()->GetBounds(bounds);
    EXPECT_EQ(bounds[0], 0);
    EXPECT_EQ(bounds[1], 1);
    EXPECT_EQ(bounds[3], 1);
  }
}

TEST(RangeResampleDamaged, ARangeOutsideOfTheMeshIsAWarning)
{
  const auto filter = unitFilter(2, 9);
  filter->SetInputData(gridOf(jitteredScene(2, 4, 1)));
  EXPECT_EQ(update(filter).Warnings, "");
  filter->SetSamplingBounds(5, 6, 5, 6, 0, 0);
  const Said said = update(filter);
  EXPECT_EQ(said.Errors, "");
  EXPECT_NE(said.Warnings.find("No sample lies in a cell of the mesh"), std::string::npos);
}

TEST(RangeResampleDamaged, AnUnknownArrayIsAnErrorThatListsTheArrays)
{
  const auto filter = unitFilter(2, 9);
  filter->SetInputData(gridOf(jitteredScene(2, 4, 1)));
  filter->GetPointDataArraySelection()->EnableArray("depth");
  const Said said = update(filter);
  EXPECT_NE(said.Warnings.find("'depth' in the input, so it is not sampled; there are 'linear'."),
    std::string::npos)
    << said.Warnings;
}
