// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippResampleInput_h
#define tippResampleInput_h

#include "Ranks/Communicator.h"
#include "Vtk/VtkMessages.h"

#include <string>
#include <vector>

class vtkRangeResampleFilter;

namespace tipp
{

/// What 'tipp resample' is asked for.
struct ResampleArguments
{
  std::string Input;
  std::string Output;
  std::vector<double> Bounds;  ///< empty: those of the mesh
  std::vector<int> Dimensions; ///< empty: by Delta
  std::vector<double> Delta;
  std::vector<std::string> Arrays; ///< empty: all
  std::string Device = "auto";
  int Threads = 0;
  double Null = 0;
  bool HasNull = false;
  double NoData = 0;
  bool HasNoData = false;
  std::string Crs;
  std::string Memory = "1G"; ///< for the part of a partitioned mesh that is read at a time
};

/// Makes the mesh the input of a filter that has its range and lattice, and selects the arrays to
/// sample. A partitioned mesh is read while the filter works, in batches of pieces, so that it may
/// be larger than memory; `reading` then keeps the reader's errors. Any other mesh is read here.
/// Collective. Throws IOError on all ranks.
void connectMesh(const ResampleArguments& arguments, Communicator& ranks,
  vtkRangeResampleFilter* filter, ErrorKeeper* reading);

} // namespace tipp

#endif
