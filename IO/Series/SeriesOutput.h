// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSeriesOutput_h
#define tippSeriesOutput_h

#include "Files/PendingOutput.h"
#include "Resample/Lattice.h"
#include "vtkTIPPIOModule.h"

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace tipp
{

/// A field on a regular grid.
struct SeriesField
{
  std::string Name;
  std::string LongName;          ///< may be empty
  std::string Units;             ///< may be empty
  bool Varies = false;           ///< has samples of its own for each time step
  std::string StandardName = {}; ///< of CF; may be empty
};

/// Fields on a regular grid in the plane, and the time steps of those that vary.
struct SeriesDescription
{
  Lattice Grid; ///< of one layer; the samples are pixels' centres
  std::vector<SeriesField> Fields;
  std::vector<double> Times; ///< ascending
  std::string TimeUnits;     ///< such as "seconds since 2008-09-01"; may be empty
  std::string Calendar;      ///< in the manner of CF; empty: the standard one
  std::string Crs;           ///< any text that GDAL understands; may be empty
  std::string Source;        ///< what the samples come from, such as the name of a file
  bool IsOneStep = false; ///< one step that was asked for by its number: .npy has no axis of time
  double NoData = -9999;  ///< value of a GeoTIFF's pixels without data
  int Threads = 1;        ///< threads that compress, where that is possible
};

/// Writes fields on a grid step by step. What it writes appears only when it is complete; without
/// close() it is removed.
class VTKTIPPIO_EXPORT SeriesOutput
{
public:
  virtual ~SeriesOutput() = default;

  /// Writes the samples of a field, the first axis fastest, NaN where there is no value. Each field
  /// that varies is written once per step, steps in ascending order; another field once, with
  /// `step` 0, after the steps. Throws IOError.
  virtual void write(std::size_t field, std::size_t step, const float* samples) = 0;

  /// Completes the output. Throws IOError.
  virtual void close() = 0;
};

/// Creates a NetCDF-4 file in the manner of CF 1.8: variables of (time, y, x) in chunks that are
/// compressed, with the reference system as GDAL and rioxarray read it. `before` as for
/// PendingFile. Throws IOError, also in a build without NetCDF.
VTKTIPPIO_EXPORT std::unique_ptr<SeriesOutput> createNetcdfSeries(
  const std::string& path, const SeriesDescription& description, const PathState& before);

} // namespace tipp

#endif
