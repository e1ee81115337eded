// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippResampleInput_h
#define tippResampleInput_h

#include "Files/Formats.h"
#include "Ranks/Communicator.h"
#include "Vtk/DataSets.h"

#include <optional>
#include <string>
#include <vector>

class vtkRangeResampleFilter;

namespace tipp
{

/// The options of 'tipp resample'.
struct ResampleArguments
{
  std::string Input;
  std::string Output;
  Opener OutputIs = Opener::None; ///< the format of Output
  std::vector<double> Bounds;     ///< empty: those of the mesh
  std::vector<int> Dimensions;    ///< number of samples; empty: given by Delta
  /// Distance of samples; empty: given by Dimensions.
  std::vector<double> Delta;
  std::vector<std::string> Arrays; ///< empty: all
  int Step = 0;                    ///< the time step to sample of arrays that vary in time
  std::string Device = "auto";
  int Threads = 0;
  std::optional<double> Null;
  std::optional<double> NoData;
  std::string Crs;
  std::string Memory = "1G"; ///< of the part of a partitioned mesh that is in memory at a time
};

/// Connects the mesh to a filter, sets the filter's range and numbers of samples, and selects the
/// arrays to sample. A partitioned mesh is read while the filter runs, in batches of pieces, so it
/// may be larger than memory; `reading` then collects the reader's errors. Any other mesh is read
/// here. Returns the time to sample, if the mesh has times. Collective. Throws IOError on all
/// ranks.
std::optional<double> connectMesh(const ResampleArguments& arguments, Communicator& ranks,
  vtkRangeResampleFilter* filter, ErrorKeeper* reading);

} // namespace tipp

#endif
