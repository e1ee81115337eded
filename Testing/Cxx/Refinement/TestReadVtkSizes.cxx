// SPDX-License-Identifier: BSD-3-Clause
#include "Meshes/MeshFiles.h"
#include "Refinement/ReadSizes.h"

#include "TemporaryFolder.h"

#include "vtkCellArray.h"
#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkXMLPolyDataWriter.h"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

namespace
{

using namespace tipp;

/// Writes an L without the upper right quarter of its box: its points, whose sizes are 1 below and
/// 5 at the top, and triangles or vertices.
std::string writeL(const std::string& path, bool hasTriangles)
{
  vtkNew<vtkPolyData> data;
  vtkNew<vtkPoints> points;
  vtkNew<vtkDoubleArray> sizes;
  sizes->SetName("size");
  const std::vector<std::array<double, 3>> given{ { 0, 0, 1 }, { 8, 0, 1 }, { 8, 3, 1 },
    { 4, 3, 1 }, { 4, 6, 5 }, { 0, 6, 5 } };
  vtkNew<vtkCellArray> vertices;
  for (const auto& [x, y, size] : given)
  {
    const vtkIdType point = points->InsertNextPoint(x, y, 0);
    sizes->InsertNextValue(size);
    vertices->InsertNextCell(1, &point);
  }
  vtkNew<vtkCellArray> triangles;
  for (const std::array<vtkIdType, 3>& ids :
    { std::array<vtkIdType, 3>{ 0, 1, 3 }, { 1, 2, 3 }, { 0, 3, 5 }, { 3, 4, 5 } })
  {
    triangles->InsertNextCell(3, ids.data());
  }
  data->SetPoints(points);
  data->GetPointData()->AddArray(sizes);
  hasTriangles ? data->SetPolys(triangles) : data->SetVerts(vertices);
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetFileName(path.c_str());
  writer->SetInputData(data);
  writer->Write();
  return path;
}

double sizeInNotch(const std::string& path)
{
  SizeArguments arguments;
  arguments.Size = path;
  arguments.Least = 0.5;
  return makeSizeFunction(arguments, {}, { { 0, 0 }, { 8, 6 } }, 2, {}).at({ 7, 3.5 });
}

TEST(ReadVtkSizes, MeshesKeepTheirTriangles)
{
  const test::TemporaryFolder folder;
  const std::string path = writeL(folder.path("a.vtp"), true);
  EXPECT_TRUE(holdsTriangles(path));
  EXPECT_NEAR(1, sizeInNotch(path), 1e-9); // that of the L's side
}

TEST(ReadVtkSizes, PointsAreTriangulated)
{
  const test::TemporaryFolder folder;
  const std::string path = writeL(folder.path("a.vtp"), false);
  EXPECT_FALSE(holdsTriangles(path));
  EXPECT_NEAR(1 + 2 / 3.0, sizeInNotch(path), 1e-9); // across the notch
}

} // namespace
