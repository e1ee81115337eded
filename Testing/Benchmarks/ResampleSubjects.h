// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippResampleSubjects_h
#define tippResampleSubjects_h

#include "vtkDataSet.h"
#include "vtkPointSet.h"
#include "vtkSmartPointer.h"
#include "vtkUnstructuredGrid.h"

#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace tipp
{
namespace benchmark
{

/// The time of a steady clock.
double seconds();

/// The time of the fastest run, and the number of samples it found.
struct Best
{
  double Seconds = HUGE_VAL;
  vtkIdType Hits = 0;

  void take(double time, vtkIdType hits)
  {
    this->Seconds = std::min(this->Seconds, time);
    this->Hits = hits;
  }
};

/// Adds two point arrays, one of which is a linear field.
void addArrays(vtkPointSet* mesh);

/// A triangulation of points of a distribution. "local" is a jittered lattice whose points are
/// ordered row by row.
vtkSmartPointer<vtkPointSet> surface(const std::string& kind, vtkIdType count);

/// A jittered lattice whose cubes are cut into six tetrahedra each.
vtkSmartPointer<vtkPointSet> volume(vtkIdType count);

/// A surface as an unstructured grid, which shares the surface's triangles.
vtkSmartPointer<vtkUnstructuredGrid> asGrid(vtkPointSet* surface);

/// The middle of a box, with `side` times its length along each axis.
std::array<double, 6> middleOf(const double* bounds, double side);

/// The number of samples that the mask marks as valid.
vtkIdType hitsOf(vtkDataSet* image);

/// Compares reading and sampling a range of a partitioned mesh of random points with reading and
/// probing the .vtu of the same mesh. Arguments: FOLDER POINTS SAMPLES-PER-AXIS REPEAT FRACTION.
void benchmarkStored(const std::vector<std::string>& arguments);

/// Samples a whole mesh of random points, for several numbers of partitions and of samples per
/// partition, on one thread, on all threads, and with `opencl` on an OpenCL device. Arguments:
/// FOLDER POINTS REPEAT SAMPLES-PER-AXIS-AT-MOST [opencl].
void benchmarkPartitions(const std::vector<std::string>& arguments);

} // namespace benchmark
} // namespace tipp

#endif
