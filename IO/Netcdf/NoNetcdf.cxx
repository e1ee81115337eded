// SPDX-License-Identifier: BSD-3-Clause
#include "Series/SeriesOutput.h"

#include "Files/IOError.h"

namespace tipp
{

std::unique_ptr<SeriesOutput> createNetcdfSeries(
  const std::string& path, const SeriesDescription&, const PathState&)
{
  throw IOError(path,
    "cannot be written: this build has no NetCDF; install the NetCDF library (Debian's "
    "libnetcdf-dev) and build again, or write .tif, .npy or .pvd.");
}

} // namespace tipp
