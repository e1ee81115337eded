// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippBesideProbeFilter_h
#define tippBesideProbeFilter_h

#include "RangeResampleTesting.h"

#include "vtkProbeFilter.h"

#include <gtest/gtest.h>

/// Every sample that vtkProbeFilter finds must be valid in the filter's image, with the same value.
inline void expectAllThatVtkFinds(
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

/// Samples a linear field on a mesh of solid cells. The values must be those of the field, and
/// every sample that vtkProbeFilter finds must be valid.
inline void expectLinearWhereVtkFindsIt(vtkDataSet* mesh)
{
  vtkNew<vtkDoubleArray> linear;
  linear->SetName("linear");
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    linear->InsertNextValue(linearField(mesh->GetPoint(i)));
  }
  mesh->GetPointData()->AddArray(linear);
  // The range leaves out the outer faces. These are not exactly planar, and vtkProbeFilter finds
  // samples within its tolerance there.
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

#endif
