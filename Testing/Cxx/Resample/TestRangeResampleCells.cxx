// SPDX-License-Identifier: BSD-3-Clause
#include "CellStorages.h"
#include "RangeResampleTesting.h"

#include "vtkCellData.h"
#include "vtkCommand.h"
#include "vtkDataSetAttributes.h"
#include "vtkIdTypeArray.h"
#include "vtkPartitionedDataSet.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPolyData.h"
#include "vtkStructuredGrid.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

#include <random>

namespace
{

/// A grid of the unit cube with slightly moved points, and cells of one type.
class CubeGrid
{
public:
  CubeGrid()
  {
    this->Points->SetDataTypeToDouble();
    std::mt19937 random(2);
    std::uniform_real_distribution<double> offset(-0.1, 0.1);
    for (int z = 0; z < 3; ++z)
    {
      for (int y = 0; y < 3; ++y)
      {
        for (int x = 0; x < 3; ++x)
        {
          const auto moved = [&](int i) { return i == 1 ? 0.5 + offset(random) : i / 2.0; };
          const double px = moved(x);
          const double py = moved(y);
          this->Points->InsertNextPoint(px, py, moved(z));
        }
      }
    }
    this->Grid->SetPoints(this->Points);
  }

  vtkIdType id(int x, int y, int z) const { return x + 3 * (y + 3 * z); }

  /// The corners of a cube of the grid, in the order of VTK_HEXAHEDRON.
  std::vector<vtkIdType> cube(int x, int y, int z) const
  {
    return { id(x, y, z), id(x + 1, y, z), id(x + 1, y + 1, z), id(x, y + 1, z), id(x, y, z + 1),
      id(x + 1, y, z + 1), id(x + 1, y + 1, z + 1), id(x, y + 1, z + 1) };
  }

  void add(int type, const std::vector<vtkIdType>& ids)
  {
    this->Grid->InsertNextCell(type, vtkIdType(ids.size()), ids.data());
  }

  vtkIdType addCentre(const std::vector<vtkIdType>& corners)
  {
    double centre[3] = { 0, 0, 0 };
    for (const vtkIdType corner : corners)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        centre[axis] += this->Points->GetPoint(corner)[axis] / double(corners.size());
      }
    }
    return this->Points->InsertNextPoint(centre);
  }

  vtkUnstructuredGrid* finish()
  {
    vtkNew<vtkDoubleArray> linear;
    linear->SetName("linear");
    vtkNew<vtkIdTypeArray> number;
    number->SetName("number");
    for (vtkIdType i = 0; i < this->Points->GetNumberOfPoints(); ++i)
    {
      linear->InsertNextValue(linearField(this->Points->GetPoint(i)));
    }
    for (vtkIdType i = 0; i < this->Grid->GetNumberOfCells(); ++i)
    {
      number->InsertNextValue(i);
    }
    this->Grid->GetPointData()->AddArray(linear);
    this->Grid->GetCellData()->AddArray(number);
    return this->Grid;
  }

private:
  vtkNew<vtkPoints> Points;
  vtkNew<vtkUnstructuredGrid> Grid;
};

template <typename Add>
vtkSmartPointer<vtkImageData> sampleCubes(CubeGrid& cubes, const Add& add, int n = 33)
{
  for (int i = 0; i < 8; ++i)
  {
    add(cubes.cube(i % 2, i / 2 % 2, i / 4));
  }
  const auto filter = unitFilter(3, n);
  filter->SetInputData(cubes.finish());
  filter->Update();
  return filter->GetOutput();
}

void expectFilled(vtkImageData* image)
{
  EXPECT_EQ(countValid(image), image->GetNumberOfPoints());
  EXPECT_LT(linearError(image, 3), 1e-13);
}

} // namespace

TEST(RangeResampleCells, HexahedraLeaveNoHolesThoughTheirFacesAreNotPlanar)
{
  CubeGrid cubes;
  expectFilled(sampleCubes(cubes, [&](const auto& ids) { cubes.add(VTK_HEXAHEDRON, ids); }));
}

/// For each storage that vtkCellArray has.
TEST(RangeResampleCells, EveryStorageOfCellsMakesTheSameImage)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> linear;
  linear->SetName("linear");
  for (const double p : { 0., 0., 0., 1., 0., 0., 0., 1., 0., 1., 1., 0., 0., 0., 1. })
  {
    linear->InsertNextValue(p);
  }
  linear->SetNumberOfComponents(3);
  points->SetData(linear);
  const std::vector<std::pair<int, std::vector<std::int64_t>>> meshes = {
    { VTK_TRIANGLE, { 0, 1, 2, 2, 1, 3 } }, { VTK_TETRA, { 0, 1, 2, 4, 1, 2, 3, 4 } }
  };
  for (const auto& [type, ids] : meshes)
  {
    const bool flat = type == VTK_TRIANGLE;
    std::vector<vtkSmartPointer<vtkImageData>> images;
    for (const auto& [name, storage] : cellStorages())
    {
      vtkNew<vtkUnstructuredGrid> grid;
      grid->SetPoints(points);
      grid->SetCells(type, storedCells(storage, ids, flat ? 3 : 4));
      grid->GetPointData()->AddArray(linear);
      const auto filter = unitFilter(flat ? 2 : 3, 9);
      filter->SetInputData(grid);
      filter->Update();
      images.emplace_back(filter->GetOutput());
      EXPECT_GT(countValid(images.back()), flat ? 80 : 250) << name;
      EXPECT_TRUE(sameArrays(images.front(), images.back())) << name;
    }
  }
}

TEST(RangeResampleCells, WedgesLeaveNoHoles)
{
  CubeGrid cubes;
  expectFilled(sampleCubes(cubes,
    [&](const auto& c)
    {
      cubes.add(VTK_WEDGE, { c[0], c[1], c[2], c[4], c[5], c[6] });
      cubes.add(VTK_WEDGE, { c[0], c[2], c[3], c[4], c[6], c[7] });
    }));
}

TEST(RangeResampleCells, PyramidsLeaveNoHoles)
{
  CubeGrid cubes;
  expectFilled(sampleCubes(cubes,
    [&](const auto& c)
    {
      const vtkIdType apex = cubes.addCentre(c);
      const int faces[6][4] = { { 0, 4, 7, 3 }, { 1, 2, 6, 5 }, { 0, 1, 5, 4 }, { 3, 7, 6, 2 },
        { 0, 3, 2, 1 }, { 4, 5, 6, 7 } };
      for (const auto& face : faces)
      {
        cubes.add(VTK_PYRAMID, { c[face[0]], c[face[1]], c[face[2]], c[face[3]], apex });
      }
    }));
}

TEST(RangeResampleCells, CellArraysComeFromTheCellThatWasCut)
{
  CubeGrid cubes;
  const auto image = sampleCubes(
    cubes, [&](const auto& ids) { cubes.add(VTK_HEXAHEDRON, ids); }, 2);
  vtkDataArray* const number = image->GetPointData()->GetArray("number");
  for (int i = 0; i < 8; ++i)
  {
    EXPECT_EQ(number->GetTuple1(i), i);
  }
}

TEST(RangeResampleCells, VoxelsPixelsAndOtherTypesAreSampled)
{
  vtkNew<vtkStructuredGrid> structured;
  structured->SetDimensions(3, 3, 3);
  CubeGrid cubes;
  vtkUnstructuredGrid* const grid = cubes.finish();
  structured->SetPoints(grid->GetPoints());
  structured->GetPointData()->ShallowCopy(grid->GetPointData());
  const auto filter = unitFilter(3, 9);
  filter->SetInputData(structured);
  filter->Update();
  expectFilled(filter->GetOutput());

  CubeGrid other;
  const std::vector<vtkIdType> c = other.cube(0, 0, 0);
  other.add(VTK_VOXEL, { c[0], c[1], c[3], c[2], c[4], c[5], c[7], c[6] });
  filter->SetInputData(other.finish());
  filter->SetSamplingBounds(0, 0.3, 0, 0.3, 0, 0.3);
  filter->Update();
  expectFilled(filter->GetOutput());
}

TEST(RangeResampleCells, QuadsPolygonsAndStripsAreSampled)
{
  vtkNew<vtkPolyData> surface;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> linear;
  linear->SetName("linear");
  for (int y = 0; y < 4; ++y)
  {
    for (int x = 0; x < 3; ++x)
    {
      const double p[3] = { x / 2.0, y / 3.0, 0 };
      points->InsertNextPoint(p);
      linear->InsertNextValue(linearField(p));
    }
  }
  surface->SetPoints(points);
  surface->GetPointData()->AddArray(linear);
  surface->AllocateExact(10, 40);
  const vtkIdType quads[2][4] = { { 0, 1, 4, 3 }, { 1, 2, 5, 4 } };
  surface->InsertNextCell(VTK_QUAD, 4, quads[0]);
  surface->InsertNextCell(VTK_QUAD, 4, quads[1]);
  const vtkIdType polygon[6] = { 3, 4, 5, 8, 7, 6 };
  surface->InsertNextCell(VTK_POLYGON, 6, polygon);
  const vtkIdType strip[6] = { 6, 9, 7, 10, 8, 11 };
  surface->InsertNextCell(VTK_TRIANGLE_STRIP, 6, strip);
  const auto filter = unitFilter(2, 25);
  filter->SetInputData(surface);
  filter->Update();
  EXPECT_EQ(countValid(filter->GetOutput()), 625);
  EXPECT_LT(linearError(filter->GetOutput(), 2), 1e-13);
}

TEST(RangeResampleCells, ReflexQuadsAreCutInside)
{
  vtkNew<vtkUnstructuredGrid> grid;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  // An arrow head with its notch at (0.5, 0.5).
  points->InsertNextPoint(0, 0, 0);
  points->InsertNextPoint(1, 0.5, 0);
  points->InsertNextPoint(0, 1, 0);
  points->InsertNextPoint(0.5, 0.5, 0);
  grid->SetPoints(points);
  const vtkIdType ids[4] = { 0, 1, 2, 3 };
  grid->InsertNextCell(VTK_QUAD, 4, ids);
  const auto filter = unitFilter(2, 5);
  filter->SetInputData(grid);
  filter->Update();
  EXPECT_FALSE(isValid(filter->GetOutput(), 11)); // at (0.25, 0.5)
  EXPECT_TRUE(isValid(filter->GetOutput(), 13));  // at (0.75, 0.5)
}

TEST(RangeResampleCells, SteepAndNoisySurfacesLoseNoSamples)
{
  Scene scene = jitteredScene(2, 8, 1);
  std::mt19937 random(1);
  for (const double slope : { 1e-13, 3.0 })
  {
    for (std::size_t i = 0; i < scene.Points.size(); i += 3)
    {
      scene.Points[i + 2] = slope * (scene.Points[i] + 1e-3 * double(random() % 1000));
    }
    const auto filter = unitFilter(2, 65);
    filter->SetInputData(gridOf(scene));
    filter->Update();
    EXPECT_EQ(countValid(filter->GetOutput()), 65 * 65);
  }
}

TEST(RangeResampleCells, SurfacesAreSampledAlongTheAxisOfOneSample)
{
  Scene scene = jitteredScene(2, 8, 1);
  for (int axis = 0; axis < 2; ++axis)
  {
    Scene upright = scene;
    for (std::size_t i = 0; i < scene.Points.size(); i += 3)
    {
      std::swap(upright.Points[i + std::size_t(axis)], upright.Points[i + 2]);
    }
    int dimensions[3] = { 17, 17, 17 };
    dimensions[axis] = 1;
    const auto filter = unitFilter(3, 17);
    filter->SetSamplingDimensions(dimensions);
    filter->SetInputData(gridOf(upright));
    filter->Update();
    EXPECT_EQ(countValid(filter->GetOutput()), 289);
    EXPECT_LT(linearError(filter->GetOutput(), 3), 1e-13);
  }
}

TEST(RangeResampleCells, ASurfaceInABoxRepeatsItsValuesAlongZ)
{
  const auto filter = unitFilter(3, 5);
  filter->SetInputData(gridOf(jitteredScene(2, 4, 1)));
  filter->Update();
  vtkImageData* const image = filter->GetOutput();
  EXPECT_EQ(countValid(image), 125);
  vtkDataArray* const linear = image->GetPointData()->GetArray("linear");
  for (int i = 0; i < 125; ++i)
  {
    EXPECT_EQ(linear->GetTuple1(i), linear->GetTuple1(i % 25));
  }
}

TEST(RangeResampleCells, HiddenCellsAreIgnoredAndDuplicatesAreNot)
{
  const auto grid = gridOf(regularScene(2, 1));
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  ghosts->InsertNextValue(vtkDataSetAttributes::DUPLICATECELL);
  ghosts->InsertNextValue(vtkDataSetAttributes::HIDDENCELL);
  grid->GetCellData()->AddArray(ghosts);
  const auto filter = unitFilter(2, 5);
  filter->SetInputData(grid);
  filter->Update();
  EXPECT_EQ(countValid(filter->GetOutput()), 15);
}

TEST(RangeResampleCells, HiddenCellsAndNoDataCanBeCombined)
{
  const auto grid = gridOf(regularScene(2, 2)); // cells 0 and 1 are the lower left quarter
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  ghosts->SetNumberOfValues(8);
  ghosts->Fill(0);
  ghosts->SetValue(0, vtkDataSetAttributes::HIDDENCELL);
  grid->GetCellData()->AddArray(ghosts);
  grid->GetPointData()->GetArray("linear")->SetTuple1(8, -99999); // the upper right corner
  const auto filter = unitFilter(2, 9);
  filter->SetInputData(grid);
  filter->UseNoDataValueOn();
  filter->Update();
  EXPECT_FALSE(isValid(filter->GetOutput(), 9 * 1 + 3)); // in the hidden cell
  EXPECT_TRUE(isValid(filter->GetOutput(), 9 * 3 + 1));
  EXPECT_FALSE(isValid(filter->GetOutput(), 9 * 7 + 6)); // in a cell at that corner
  EXPECT_TRUE(isValid(filter->GetOutput(), 9 * 1 + 6));
}

TEST(RangeResampleCells, PartsOfACollectionMakeTheImageOfTheWhole)
{
  for (const Scene& scene : { jitteredScene(2, 12, 3), jitteredScene(3, 5, 3) })
  {
    const auto filter = unitFilter(scene.Dimension, 21);
    filter->SetInputData(gridOf(scene));
    filter->Update();
    vtkNew<vtkImageData> whole;
    whole->DeepCopy(filter->GetOutput());
    for (const int parts : { 1, 3, 64 })
    {
      vtkNew<vtkPartitionedDataSetCollection> collection;
      vtkNew<vtkPartitionedDataSet> first;
      vtkNew<vtkPartitionedDataSet> second;
      for (int i = 0; i < parts; ++i)
      {
        vtkPartitionedDataSet* const to = i % 3 == 2 ? second.Get() : first.Get();
        to->SetPartition(to->GetNumberOfPartitions(), gridOf(scene, i, parts));
      }
      collection->SetPartitionedDataSet(0, first);
      collection->SetPartitionedDataSet(1, second);
      filter->SetInputData(collection);
      filter->Update();
      EXPECT_TRUE(sameArrays(whole, filter->GetOutput())) << parts;
    }
  }
}
