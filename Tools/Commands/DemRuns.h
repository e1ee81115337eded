// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDemRuns_h
#define tippDemRuns_h

#include "Commands/PointArguments.h"
#include "Dem/MakeDem.h"
#include "Files/IOError.h"
#include "Points/ReadPoints.h"
#include "Raster/RasterFile.h"

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

class vtkMultiProcessController;

namespace tipp
{

/// The options of `tipp dem`.
struct DemArguments : RunArguments
{
  DemRequest Request;
  std::vector<double> Bounds;
  std::string Like;
  std::string Crs;
  double NoData = -9999;
  std::string Type = "float32";
  std::string Compression = "deflate";
  bool CloudOptimized = false;
  std::string Breaklines; ///< path of a file; empty: none
  std::string Boundary;   ///< path of a file; empty: none

  /// Returns the file of constraints that messages name.
  std::string constraintFile() const
  {
    return this->Breaklines.empty() ? this->Boundary : this->Breaklines;
  }
};

/// The figures of a run of `tipp dem`.
struct DemReport
{
  OutOfCoreStatistics Figures;
  TerrainSettings Settings;
  std::int64_t Filled = 0; ///< pixels with a value
  double Hidden = 0;       ///< number of values that equal --nodata
  double ReadSeconds = 0;
  double MakeSeconds = 0;
  double WriteSeconds = 0;
  std::int64_t PeakMemory = 0; ///< in bytes, of the process; with ranks, the largest of all
  int Ranks = 1;
};

/// Returns how a GeoTIFF stores values; the same on all ranks.
RasterDescription describeEncoding(const DemArguments& arguments);
/// Returns the description of the raster without its grid and bands. `pointCrs`: the reference
/// system of the points. Throws IOError if GDAL does not know the reference system.
RasterDescription describeRaster(const DemArguments& arguments, const std::string& pointCrs);
/// Adds the grid and the bands to a description.
void describeGrid(const TerrainSettings& settings, RasterDescription& description);

/// Throws IOError if an output is also an input, or cannot be written. Call it before the
/// computation.
void requireDemWritable(const DemArguments& arguments);

/// Returns the error to throw if no raster can be made from the points.
IOError demError(const DemArguments& arguments, const std::runtime_error& error);

/// Prints the summary, and writes the statistics if they are requested.
void finishDem(const DemArguments& arguments, const DemReport& report);

/// Runs `tipp dem` with a memory limit, on the ranks of a controller or in this process alone
/// (null). Returns the exit code, which is the same on all ranks.
int runDemOutOfCore(
  const DemArguments& arguments, vtkMultiProcessController* controller, DemReport& report);

} // namespace tipp

#endif
