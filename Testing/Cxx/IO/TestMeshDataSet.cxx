// SPDX-License-Identifier: BSD-3-Clause
#include "Meshes/MeshFiles.h"
#include "TemporaryFolder.h"
#include "Vtk/DataSets.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <gtest/gtest.h>

namespace
{

using namespace tipp;

PointTable square()
{
  PointTable table;
  table.XY = { 0, 0, 2, 0, 2, 2, 0, 2 };
  table.Columns = { { "z", { 5, 6, 7, 8 } }, { "depth", { 1, 2, 3, 4 } } };
  return table;
}

const std::int32_t Ids32[] = { 0, 1, 2, 0, 2, 3 };
const std::int64_t Ids64[] = { 0, 1, 2, 0, 2, 3 };

void expectTriangles(vtkDataSet* data)
{
  ASSERT_EQ(2, data->GetNumberOfCells());
  vtkNew<vtkIdList> points;
  for (vtkIdType cell = 0; cell < 2; ++cell)
  {
    data->GetCellPoints(cell, points);
    ASSERT_EQ(3, points->GetNumberOfIds());
    for (vtkIdType i = 0; i < 3; ++i)
    {
      EXPECT_EQ(Ids64[3 * cell + i], points->GetId(i));
    }
  }
}

TEST(MeshDataSet, ColumnZIsTheThirdCoordinateAndOthersArePointData)
{
  const PointTable table = square();
  const auto data = makePolyData(table, TrianglesView(Ids32, 2));
  ASSERT_EQ(4, data->GetNumberOfPoints());
  EXPECT_EQ(7, data->GetPoint(2)[2]);
  EXPECT_EQ(2, data->GetPoint(1)[0]);
  EXPECT_EQ(1, data->GetPointData()->GetNumberOfArrays());
  ASSERT_NE(nullptr, data->GetPointData()->GetArray("depth"));
  EXPECT_EQ(3, data->GetPointData()->GetArray("depth")->GetTuple1(2));
}

TEST(MeshDataSet, WithoutAColumnZPointsLieInThePlane)
{
  PointTable table = square();
  table.Columns.clear();
  const auto data = makePolyData(table, TrianglesView(Ids32, 2));
  EXPECT_EQ(0, data->GetPoint(2)[2]);
}

TEST(MeshDataSet, RegionsAreCellDataOfFiles)
{
  const tipp::test::TemporaryFolder folder;
  MeshOptions options;
  const std::vector<std::int32_t> given{ 4, -1 };
  options.Regions = given;
  options.Neighbors = true;
  for (const char* const name : { "mesh.vtp", "mesh.vtu" })
  {
    const std::string path = folder.path(name);
    ASSERT_TRUE(writeMesh(path, square(), TrianglesView(Ids32, 2), options));
    const vtkSmartPointer<vtkDataSet> data = readDataSet(path);
    vtkDataArray* const regions = data->GetCellData()->GetArray("Region");
    ASSERT_NE(nullptr, regions) << name;
    EXPECT_EQ(4, regions->GetTuple1(0));
    EXPECT_EQ(-1, regions->GetTuple1(1));
    EXPECT_NE(nullptr, data->GetCellData()->GetArray(neighborIdsName));
  }
}

TEST(MeshDataSet, IdsOfEitherSizeMakeTheSameCells)
{
  const PointTable table = square();
  expectTriangles(makePolyData(table, TrianglesView(Ids32, 2)));
  expectTriangles(makePolyData(table, TrianglesView(Ids64, 2)));
}

TEST(MeshDataSet, ConnectivityAndColumnsAreNotCopied)
{
  const PointTable table = square();
  const auto data = makePolyData(table, TrianglesView(Ids32, 2));
  EXPECT_EQ(Ids32, data->GetPolys()->GetConnectivityArray()->GetVoidPointer(0));
  EXPECT_EQ(
    table.Columns[1].Values.data(), data->GetPointData()->GetArray("depth")->GetVoidPointer(0));
}

} // namespace
