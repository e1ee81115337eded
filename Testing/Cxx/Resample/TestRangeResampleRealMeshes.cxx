// SPDX-License-Identifier: BSD-3-Clause
#include "AdcircWater.h"
#include "BesideProbeFilter.h"
#include "RangeResampleTesting.h"

#include "Vtk/DataSets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace
{

constexpr double dry = -99999;

} // namespace

TEST(RangeResampleRealMeshes, TheEastCoastsWaterEqualsVtkProbeFilter)
{
  TIPP_REQUIRE_REAL_DATA(path, "adcirc/ec95d/ec95d.grd");
  TIPP_REQUIRE_REAL_DATA(maximum, "adcirc/ec95d/maxele.63");
  const auto grid = gridOfAdcirc(path);
  const auto values = readMaximum(maximum, grid->GetNumberOfPoints());
  ASSERT_EQ(values->GetNumberOfValues(), grid->GetNumberOfPoints());
  grid->GetPointData()->AddArray(values);
  vtkNew<vtkRangeResampleFilter> filter;
  filter->SetSamplingDimensions(300, 300, 1);
  filter->SetInputData(grid);
  filter->Update();
  expectAllThatVtkFinds(filter, grid, "maxele", 1e-6);
  EXPECT_LT(linearError(filter->GetOutput(), 2), 1e-12 * 1000);
}

TEST(RangeResampleRealMeshes, TheEastCoastsDryNodesAreLeftOutOnRequest)
{
  TIPP_REQUIRE_REAL_DATA(path, "adcirc/ec95d/ec95d.grd");
  TIPP_REQUIRE_REAL_DATA(maximum, "adcirc/ec95d/maxele.63");
  const auto grid = gridOfAdcirc(path);
  const auto values = readMaximum(maximum, grid->GetNumberOfPoints());
  // The dry nodes in the file are in cells that are too small for these samples. So other nodes are
  // made dry.
  for (vtkIdType i = 0; i < values->GetNumberOfValues(); i += 100)
  {
    values->SetValue(i, dry);
  }
  double highest = dry;
  double lowest = HUGE_VAL;
  for (vtkIdType i = 0; i < values->GetNumberOfValues(); ++i)
  {
    const double value = values->GetValue(i);
    highest = std::max(highest, value);
    lowest = value == dry ? lowest : std::min(lowest, value);
  }
  grid->GetPointData()->AddArray(values);
  vtkNew<vtkRangeResampleFilter> filter;
  filter->SetSamplingDimensions(500, 500, 1);
  filter->SetInputData(grid);
  filter->Update();
  const vtkIdType all = countValid(filter->GetOutput());
  filter->UseNoDataValueOn();
  filter->SetNullValue((lowest + highest) / 2);
  filter->Update();
  EXPECT_LT(countValid(filter->GetOutput()), all);
  EXPECT_GT(countValid(filter->GetOutput()), all / 2);
  double range[2];
  filter->GetOutput()->GetPointData()->GetArray("maxele")->GetRange(range);
  EXPECT_GE(range[0], lowest);
  EXPECT_LE(range[1], highest);
}

TEST(RangeResampleRealMeshes, TheBracketsTetrahedraAreSampledLinearlyWhereVtkFindsThem)
{
  TIPP_REQUIRE_REAL_DATA(path, "tets/bracket_appended_compressed.vtu");
  const vtkSmartPointer<vtkDataSet> mesh = tipp::readDataSet(path);
  expectLinearWhereVtkFindsIt(mesh);
}
