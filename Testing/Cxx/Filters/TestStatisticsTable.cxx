// SPDX-License-Identifier: BSD-3-Clause
#include "Pipeline/FilterPipeline.h"
#include "Statistics/RunStatistics.h"

#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkStringArray.h"
#include "vtkTable.h"
#include "vtkVariant.h"

#include <gtest/gtest.h>

namespace
{

using namespace tipp;

class StatisticsTableTest : public testing::Test
{
public:
  StatisticsTableTest()
  {
    TriangulationStatistics& statistics = this->Run.Statistics;
    statistics.Stages = { { 3, 40 }, { 1, 20 } };
    statistics.Phases = { { "bucketing", 0.25 }, { "workers", 1.5 } };
    statistics.Partitions = 4;
    statistics.InitialPoints = 32;
    statistics.WorkerVertices = 1017;
    statistics.Threads = 2;
    this->Run.Duplicates = { { 7, 3 } };
    this->Run.Rejected = { 5, 6 };
    fillStatisticsTable(statisticsOf(this->Run, 1000, 1990), this->Table);
  }

  double total(const char* name) const
  {
    vtkDataArray* array = this->Table->GetFieldData()->GetArray(name);
    return array && array->GetNumberOfTuples() == 1 ? array->GetTuple1(0) : -1;
  }

  Triangulation Run;
  vtkNew<vtkTable> Table;
};

TEST_F(StatisticsTableTest, HasARowForEachStage)
{
  ASSERT_EQ(2, this->Table->GetNumberOfRows());
  ASSERT_EQ(3, this->Table->GetNumberOfColumns());
  EXPECT_EQ(1, this->Table->GetValueByName(1, "Stage").ToInt());
  EXPECT_EQ(3, this->Table->GetValueByName(0, "ActivePartitions").ToInt());
  EXPECT_EQ(20, this->Table->GetValueByName(1, "MeshTriangles").ToInt());
}

TEST_F(StatisticsTableTest, TotalsAreFieldData)
{
  EXPECT_EQ(1000, this->total("Points"));
  EXPECT_EQ(1990, this->total("Triangles"));
  EXPECT_EQ(1, this->total("DuplicatePoints"));
  EXPECT_EQ(2, this->total("RejectedPoints"));
  EXPECT_EQ(4, this->total("Partitions"));
  EXPECT_EQ(32, this->total("InitialPoints"));
  EXPECT_EQ(1017, this->total("WorkerVertices"));
  EXPECT_EQ(2, this->total("Threads"));
}

TEST_F(StatisticsTableTest, PhasesAreNamesAndSeconds)
{
  auto* names =
    vtkStringArray::SafeDownCast(this->Table->GetFieldData()->GetAbstractArray("PhaseName"));
  vtkDataArray* seconds = this->Table->GetFieldData()->GetArray("PhaseSeconds");
  ASSERT_NE(nullptr, names);
  ASSERT_NE(nullptr, seconds);
  ASSERT_EQ(2, names->GetNumberOfValues());
  EXPECT_EQ("workers", names->GetValue(1));
  EXPECT_EQ(1.5, seconds->GetTuple1(1));
}

TEST_F(StatisticsTableTest, ARunWithoutStagesHasColumnsAndNoRows)
{
  vtkNew<vtkTable> table;
  fillStatisticsTable(statisticsOf(Triangulation(), 0, 0), table);
  EXPECT_EQ(3, table->GetNumberOfColumns());
  EXPECT_EQ(0, table->GetNumberOfRows());
}

} // namespace
