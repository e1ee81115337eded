// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRangeResampleTesting_h
#define tippRangeResampleTesting_h

#include "ResampleScenes.h"
#include "vtkRangeResampleFilter.h"

#include "vtkCellArray.h"
#include "vtkCellType.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkSmartPointer.h"
#include "vtkTable.h"
#include "vtkUnstructuredGrid.h"

#include <cstring>

inline double linearField(const double* p)
{
  return 3 + 2 * p[0] - 5 * p[1] + 7 * p[2];
}

/// Each `step`-th cell of the scene from `begin` on, with the point array "linear".
inline vtkSmartPointer<vtkUnstructuredGrid> gridOf(const Scene& scene, int begin = 0, int step = 1)
{
  const auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> linear;
  linear->SetName("linear");
  for (std::size_t i = 0; i < scene.Points.size(); i += 3)
  {
    points->InsertNextPoint(scene.Points.data() + i);
    linear->InsertNextValue(linearField(scene.Points.data() + i));
  }
  grid->SetPoints(points);
  grid->GetPointData()->AddArray(linear);
  const int corners = scene.Dimension + 1;
  for (int cell = begin; cell < scene.cells(); cell += step)
  {
    vtkIdType ids[4];
    for (int i = 0; i < corners; ++i)
    {
      ids[i] = scene.Ids[std::size_t(corners * cell + i)];
    }
    grid->InsertNextCell(corners == 3 ? VTK_TRIANGLE : VTK_TETRA, corners, ids);
  }
  return grid;
}

/// A filter for an image of the unit square or cube with n samples along each axis.
inline vtkSmartPointer<vtkRangeResampleFilter> unitFilter(int dimension, int n)
{
  const auto filter = vtkSmartPointer<vtkRangeResampleFilter>::New();
  filter->UseInputBoundsOff();
  filter->SetSamplingBounds(0, 1, 0, 1, 0, dimension == 3 ? 1 : 0);
  filter->SetSamplingDimensions(n, n, dimension == 3 ? n : 1);
  return filter;
}

inline bool isValid(vtkImageData* image, vtkIdType sample)
{
  return image->GetPointData()->GetArray("vtkValidPointMask")->GetTuple1(sample) == 1;
}

inline vtkIdType countValid(vtkImageData* image)
{
  vtkIdType count = 0;
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    count += isValid(image, i);
  }
  return count;
}

/// The largest error of the array "linear" among the valid samples.
inline double linearError(vtkImageData* image, int dimension)
{
  vtkDataArray* const samples = image->GetPointData()->GetArray("linear");
  double largest = 0;
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    double p[3];
    image->GetPoint(i, p);
    p[2] = dimension == 3 ? p[2] : 0;
    const double error = std::fabs(samples->GetTuple1(i) - linearField(p));
    largest = isValid(image, i) && !(error <= largest) ? error : largest;
  }
  return largest;
}

inline bool sameArrays(vtkImageData* a, vtkImageData* b)
{
  bool same = a->GetPointData()->GetNumberOfArrays() == b->GetPointData()->GetNumberOfArrays();
  for (int i = 0; same && i < a->GetPointData()->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* const one = a->GetPointData()->GetArray(i);
    vtkDataArray* const two = b->GetPointData()->GetArray(one->GetName());
    same = two && one->GetNumberOfValues() == two->GetNumberOfValues() &&
      std::memcmp(one->GetVoidPointer(0), two->GetVoidPointer(0),
        std::size_t(one->GetNumberOfValues() * one->GetDataTypeSize())) == 0;
  }
  return same;
}

inline double statistic(vtkRangeResampleFilter* filter, const char* name)
{
  return filter->GetStatistics()->GetFieldData()->GetArray(name)->GetTuple1(0);
}

#endif
