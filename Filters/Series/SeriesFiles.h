// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSeriesFiles_h
#define tippSeriesFiles_h

#include "Files/PendingOutput.h"
#include "Series/SeriesOutput.h"
#include "vtkTIPPFiltersModule.h"

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace tipp
{

/// The files of a series, by the extension of `path`; they appear when all are complete:
/// - .nc: one file, see createNetcdfSeries();
/// - .npy: one file of float32, (steps, rows, columns) for a field that varies, else (rows,
///   columns), from the lowest y on; for one field;
/// - .tif: a GeoTIFF for each step, with a band for each field that varies, and one with a band for
///   each of the others;
/// - .pvd: ParaView's list of a .vti for each step, beside it, and one .vti of the other fields.
///
/// The files of the steps are called as `path` with the numbers of the steps in the source added,
/// such as maps_0012.tif, and the one of the other fields as `path`. A single step without other
/// fields is in a .tif called `path`.
class VTKTIPPFILTERS_EXPORT SeriesFiles
{
public:
  /// `numbers`: of the steps in the source. Throws IOError if the fields cannot be written so.
  SeriesFiles(std::string path, SeriesDescription description, std::vector<std::size_t> numbers);

  /// All files, in the order of the steps.
  std::vector<std::string> paths() const;

  /// Creates the output. `before`: the states of paths(). Throws IOError.
  std::unique_ptr<SeriesOutput> create(const std::vector<PathState>& before) const;

private:
  std::string Path;
  SeriesDescription Of;
  std::vector<std::size_t> Numbers;
};

} // namespace tipp

#endif
