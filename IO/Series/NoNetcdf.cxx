// SPDX-License-Identifier: BSD-3-Clause
#include "Files/Formats.h"
#include "Files/IOError.h"
#include "Series/NetcdfSeries.h"
#include "Series/SeriesOutput.h"
#include "Series/WriteUgrid.h"

#include <string>

namespace tipp
{
namespace
{

constexpr const char* advice =
  "; install the NetCDF library (Debian's libnetcdf-dev) and build again, or write ";

} // namespace

std::unique_ptr<MeshSeries> openNetcdfSeries(const std::string& path, const SeriesOptions&)
{
  throw IOError(path,
    "is a NetCDF file, which this build of TIPP does not read; install the NetCDF library "
    "(Debian's libnetcdf-dev) and build TIPP again.");
}

std::unique_ptr<SeriesOutput> createNetcdfSeries(
  const std::string& path, const SeriesDescription&, const PathState&)
{
  throw IOError(path,
    std::string("cannot be written: this build writes no NetCDF") + advice + ".tif, .npy or .pvd.");
}

void requireNetcdfFor(const std::string& output)
{
  if (isOpenedBy(output, Opener::Netcdf))
  {
    throw IOError(output,
      std::string("cannot be written: this build writes no NetCDF") + advice + "another format.");
  }
}

bool writeUgrid(const std::string& path, const UgridContent&, const std::optional<PathState>&,
  const std::function<bool()>&)
{
  requireNetcdfFor(path);
  return false;
}

} // namespace tipp
