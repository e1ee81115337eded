// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippResampleArguments_h
#define tippResampleArguments_h

#include "Files/Formats.h"

#include <optional>
#include <string>
#include <vector>

namespace tipp
{

/// The options of 'tipp resample'.
struct ResampleArguments
{
  std::string Input;
  std::string Output;
  Opener OutputIs = Opener::None; ///< the format of Output
  std::vector<double> Bounds;     ///< six; empty: the mesh's bounds
  bool BoundsHaveZ = true;        ///< whether the user gave all six
  std::vector<int> Dimensions;    ///< number of samples; empty: given by Delta
  /// Distance of samples; empty: given by Dimensions.
  std::vector<double> Delta;
  double Resolution = 0;           ///< distance of samples along x and y; 0: not given
  std::vector<std::string> Arrays; ///< empty: all
  std::string Step;                ///< the time steps to sample, see parseSteps(); empty: not given
  std::string Device = "auto";
  int Threads = 0;
  std::optional<double> Null;
  std::optional<double> NoData;
  std::string Crs;
  std::string Method = "linear";
  std::vector<std::string> Values; ///< more files with values at the mesh's nodes or cells
  std::vector<std::string> Reduce; ///< reductions over the time steps
  bool WithSteps = false;          ///< whether the steps are written beside their reductions
  std::string Waterline;           ///< the array with the depth of the ground; empty: none
  bool Wrap = false;               ///< whether longitudes are unwrapped at 180 degrees
  bool CoveredShare = false;       ///< whether to add the share of each pixel that is covered
  std::string Memory = "1G"; ///< of the part of a partitioned mesh that is in memory at a time
};

/// Resamples a mesh without time steps, or one of them. Returns the exit code. Throws IOError.
int runResample(const ResampleArguments& arguments);

/// Whether the time steps of the input are resampled one by one, with runSeries().
bool isSeriesRun(const ResampleArguments& arguments);

/// Resamples time steps of a mesh of triangles. Returns the exit code. Throws IOError.
int runSeries(const ResampleArguments& arguments);

} // namespace tipp

#endif
