// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDemArguments_h
#define tippDemArguments_h

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

/// What `tipp dem` was asked for.
struct DemArguments
{
  std::vector<std::string> Inputs;
  std::string Output;
  PointOptions Points;
  DemRequest Request;
  std::vector<double> Bounds;
  std::string Like;
  std::string Crs;
  double NoData = -9999;
  std::string Type = "float32";
  std::string Compression = "deflate";
  bool CloudOptimized = false;
  std::string Breaklines; ///< a file; empty: none
  std::string Boundary;   ///< the same
  std::string Statistics;
  std::string Memory; ///< empty: not given
  bool Resume = false;
  std::string Scratch;

  /// For messages.
  std::string constraintFile() const
  {
    return this->Breaklines.empty() ? this->Boundary : this->Breaklines;
  }
};

struct DemReport
{
  DemFigures Figures;
  TerrainSettings Settings;
  std::int64_t Filled = 0; ///< pixels with a value
  double Hidden = 0;       ///< values that equal --nodata
  double ReadSeconds = 0;
  double MakeSeconds = 0;
  double WriteSeconds = 0;
  std::int64_t PeakMemory = 0; ///< of the process, or the largest of all ranks
  int Ranks = 1;
};

/// How a GeoTIFF stores values; the same on all ranks.
RasterDescription describeEncoding(const DemArguments& arguments);
/// All but the grid and the bands, for points in this reference system. Throws IOError for what
/// GDAL does not know.
RasterDescription describeRaster(const DemArguments& arguments, const std::string& pointCrs);
void describeGrid(const TerrainSettings& settings, RasterDescription& description);

/// Throws IOError if an output is an input or cannot be written: before the work.
void requireDemWritable(const DemArguments& arguments);

/// What is thrown where the points cannot be made a raster.
IOError demError(const DemArguments& arguments, const std::runtime_error& error);

/// Prints the summary, and writes the statistics if they are asked for.
void finishDem(const DemArguments& arguments, const DemReport& report);

/// `tipp dem` with a limit of memory, on the ranks of a controller or on this process alone (null).
/// Returns the exit code, the same on all ranks.
int runDemOutOfCore(
  const DemArguments& arguments, vtkMultiProcessController* controller, DemReport& report);

} // namespace tipp

#endif
