// SPDX-License-Identifier: BSD-3-Clause
#include "AdcircWater.h"
#include "RangeResampleTesting.h"

#include "Vtk/ReadDataSet.h"

#include "vtkProbeFilter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace
{

constexpr double dry = -99999;

/// Where vtkProbeFilter finds a sample, so do we, with its value.
void expectAllThatVtkFinds(
  vtkRangeResampleFilter* filter, vtkDataSet* mesh, const char* name, double tolerance)
{
  vtkImageData* const ours = filter->GetOutput();
  vtkNew<vtkImageData> image;
  image->CopyStructure(ours);
  vtkNew<vtkProbeFilter> probe;
  probe->SetInputData(image);
  probe->SetSourceData(mesh);
  probe->ComputeToleranceOff();
  probe->SetTolerance(1e-13);
  probe->Update();
  vtkPointData* const theirs = probe->GetOutput()->GetPointData();
  vtkIdType found = 0;
  for (vtkIdType i = 0; i < ours->GetNumberOfPoints(); ++i)
  {
    if (theirs->GetArray("vtkValidPointMask")->GetTuple1(i) == 1)
    {
      ++found;
      ASSERT_TRUE(isValid(ours, i)) << i;
      ASSERT_NEAR(ours->GetPointData()->GetArray(name)->GetTuple1(i),
        theirs->GetArray(name)->GetTuple1(i), tolerance)
        << i;
    }
  }
  EXPECT_GT(found, ours->GetNumberOfPoints() / 20);
}

} // namespace

TEST(RangeResampleRealMeshes, TheEastCoastsWaterIsAsVtkProbeFilterHasIt)
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
  // The file's own dry nodes lie in cells too small for these samples.
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
  vtkNew<vtkDoubleArray> linear;
  linear->SetName("linear");
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    linear->InsertNextValue(linearField(mesh->GetPoint(i)));
  }
  mesh->GetPointData()->AddArray(linear);
  // On the faces, whose points are not quite in a plane, vtkProbeFilter's tolerance would tell.
  double b[6];
  mesh->GetBounds(b);
  for (int axis = 0; axis < 3; ++axis)
  {
    const double size = b[2 * axis + 1] - b[2 * axis];
    b[2 * axis] += 0.0137 * size;
    b[2 * axis + 1] -= 0.0171 * size;
  }
  vtkNew<vtkRangeResampleFilter> filter;
  filter->UseInputBoundsOff();
  filter->SetSamplingBounds(b);
  filter->SetSamplingDimensions(40, 40, 40);
  filter->SetInputData(mesh);
  filter->Update();
  const double scale = linear->GetMaxNorm();
  EXPECT_LT(linearError(filter->GetOutput(), 3), 1e-12 * scale);
  expectAllThatVtkFinds(filter, mesh, "linear", 1e-6 * scale);
}
