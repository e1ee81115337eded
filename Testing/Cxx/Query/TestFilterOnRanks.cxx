// SPDX-License-Identifier: BSD-3-Clause
#include "QueryRanksTesting.h"

#include "Query/Queries.h"

#include "vtkCellArray.h"
#include "vtkDoubleArray.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPartitionedMeshQuery.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>

using namespace tipp;
using namespace tipp::test;

namespace
{

class FilterOnRanks : public QueryRanksTest
{
};

TEST_F(FilterOnRanks, TheFilterLeavesValuesOnOwnersAndSharesZonesAndDescents)
{
  const SourceMesh source = makeSource(latticeTriangles(10, 0.3));
  this->store(source, "grid:3x3");
  vtkNew<vtkPartitionedMeshQuery> query;
  query->SetFileName(this->Path.c_str());
  vtkNew<vtkDoubleArray> asked;
  asked->SetNumberOfComponents(3);
  asked->InsertNextTuple3(0.31, 0.32, 0);
  asked->InsertNextTuple3(0.77, 0.81, 0);
  asked->InsertNextTuple3(9, 9, 0);
  vtkNew<vtkPolyData> values;
  ASSERT_EQ(1, query->InterpolateOnOwners(asked, values));
  EXPECT_TRUE(values->GetPointData()->GetArray("value"));
  EXPECT_TRUE(values->GetPointData()->GetArray("AskingRank"));
  std::vector<std::int64_t> count = { values->GetNumberOfPoints(), values->GetNumberOfVerts() };
  this->Ranks.together([&] { this->Ranks.sum(count); });
  EXPECT_EQ(2 * this->Ranks.size(), count[0]);
  EXPECT_EQ(count[0], count[1]);

  vtkNew<vtkIdTypeArray> cells;
  vtkNew<vtkDoubleArray> distances;
  ASSERT_EQ(1, query->Closest(asked, cells, nullptr, distances));
  ASSERT_EQ(3, cells->GetNumberOfValues());
  EXPECT_LE(0, cells->GetValue(2));
  EXPECT_EQ(0, distances->GetValue(0));
  EXPECT_NEAR(std::sqrt(128), distances->GetValue(2), 1e-9);

  vtkNew<vtkPolyData> lines;
  ASSERT_EQ(1, query->Descend(asked, "value", 0, lines));
  EXPECT_EQ(2, lines->GetNumberOfLines());

  vtkNew<vtkPoints> corners;
  corners->InsertNextPoint(-1, -1, 0);
  corners->InsertNextPoint(2, -1, 0);
  corners->InsertNextPoint(2, 2, 0);
  corners->InsertNextPoint(-1, 2, 0);
  vtkNew<vtkCellArray> polygons;
  const vtkIdType ids[4] = { 0, 1, 2, 3 };
  polygons->InsertNextCell(4, ids);
  vtkNew<vtkPolyData> zone;
  zone->SetPoints(corners);
  zone->SetPolys(polygons);
  vtkNew<vtkPointData> statistics;
  ASSERT_EQ(1, query->ZoneStatistics(zone, "value", 0, 0, statistics));
  EXPECT_EQ(double(source.cells()), statistics->GetArray("Cells")->GetComponent(0, 0));
}

TEST_F(FilterOnRanks, AMeshThatIsReplacedIsOpenedAgain)
{
  vtkNew<vtkDoubleArray> asked;
  asked->SetNumberOfComponents(3);
  asked->InsertNextTuple3(0.31, 0.32, 0);
  asked->InsertNextTuple3(0.77, 0.81, 0);
  vtkNew<vtkPartitionedMeshQuery> query;
  query->SetFileName(this->Path.c_str());
  for (const int size : { 10, 4, 7 })
  {
    const SourceMesh source = makeSource(latticeTriangles(size, 0.3));
    this->store(source, "grid:2x2");
    vtkNew<vtkPartitionedMeshQuery> fresh;
    fresh->SetFileName(this->Path.c_str());
    vtkNew<vtkIdTypeArray> expected;
    ASSERT_EQ(1, fresh->Locate(asked, expected, nullptr));
    vtkNew<vtkIdTypeArray> cells;
    ASSERT_EQ(1, query->Locate(asked, cells, nullptr));
    for (vtkIdType i = 0; i < 2; ++i)
    {
      EXPECT_EQ(expected->GetValue(i), cells->GetValue(i));
      EXPECT_LT(cells->GetValue(i), source.cells());
    }
  }
}

TEST_F(FilterOnRanks, ContoursNeedAnArrayOfLevels)
{
  this->store(makeSource(latticeTriangles(4, 0.3)), "grid:2x2");
  vtkNew<vtkPartitionedMeshQuery> query;
  query->SetFileName(this->Path.c_str());
  vtkNew<vtkPolyData> lines;
  vtkObject::GlobalWarningDisplayOff();
  EXPECT_EQ(0, query->Contours("value", 0, nullptr, lines));
  vtkObject::GlobalWarningDisplayOn();
}

TEST_F(FilterOnRanks, TheFilterQueriesAllRanksTogether)
{
  const SourceMesh source = makeSource(latticeTriangles(10, 0.3));
  this->store(source, "grid:3x3");
  const ResidentMesh whole(inMemory(source));
  const std::vector<std::int64_t> cells = this->ownIds(source.cells());
  vtkNew<vtkPartitionedMeshQuery> query;
  query->SetFileName(this->Path.c_str());
  vtkNew<vtkIdTypeArray> asked;
  for (const std::int64_t cell : cells)
  {
    asked->InsertNextValue(cell);
  }
  vtkNew<vtkIdTypeArray> found;
  ASSERT_EQ(1, query->Neighbors(asked, found));
  const std::vector<std::int64_t> expected = neighborsOf(whole, cells);
  ASSERT_EQ(std::int64_t(expected.size()), found->GetNumberOfValues());
  EXPECT_TRUE(std::equal(expected.begin(), expected.end(), found->GetPointer(0)));
  vtkNew<vtkIdTypeArray> ofCells;
  vtkNew<vtkIdTypeArray> sizes;
  vtkNew<vtkIdTypeArray> ids;
  ASSERT_EQ(1, query->Components(ofCells, sizes, ids));
  ASSERT_EQ(1, sizes->GetNumberOfValues());
  EXPECT_EQ(std::int64_t(source.cells()), sizes->GetValue(0));
  EXPECT_EQ(ids->GetNumberOfValues(), ofCells->GetNumberOfValues());
  vtkNew<vtkPolyData> border;
  ASSERT_EQ(1, query->Boundary(border));
  EXPECT_EQ(this->Ranks.isFirst() ? 40 : 0, border->GetNumberOfPoints());
}

} // namespace
