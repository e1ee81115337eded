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

/// Of a steady clock.
double seconds();

/// The fastest run, and what it found.
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

/// Two point arrays, of which one is linear.
void addArrays(vtkPointSet* mesh);

/// A triangulation of points of a distribution; "local" points are those of a jittered lattice, row
/// by row.
vtkSmartPointer<vtkPointSet> surface(const std::string& kind, vtkIdType count);

/// A jittered lattice cut into six tetrahedra a cube.
vtkSmartPointer<vtkPointSet> volume(vtkIdType count);

/// A surface's triangles, which are shared, as an unstructured grid.
vtkSmartPointer<vtkUnstructuredGrid> asGrid(vtkPointSet* surface);

/// The middle of a box: `side` of its length along each axis.
std::array<double, 6> middleOf(const double* bounds, double side);

/// The samples that a mask tells to be inside.
vtkIdType hitsOf(vtkDataSet* image);

/// A range of a mesh of random points read from a partitioned mesh and sampled, beside reading the
/// same mesh's .vtu and probing it. Arguments: FOLDER POINTS SAMPLES-PER-AXIS REPEAT FRACTION.
void benchmarkStored(const std::vector<std::string>& arguments);

/// The whole of a mesh of random points sampled for each number of partitions and of samples in
/// one, on one thread, on all, and on an OpenCL device if asked. Arguments: FOLDER POINTS REPEAT
/// SAMPLES-PER-AXIS-AT-MOST [opencl].
void benchmarkPartitions(const std::vector<std::string>& arguments);

} // namespace benchmark
} // namespace tipp

#endif
