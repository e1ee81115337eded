// SPDX-License-Identifier: BSD-3-Clause
#include "Files/Formats.h"
#include "Files/IOError.h"
#include "Series/NetcdfSeries.h"
#include "Series/SeriesOutput.h"
#include "Series/VtkHdfSeries.h"
#include "Series/WriteUgrid.h"

namespace tipp
{

std::unique_ptr<MeshSeries> openNetcdfSeries(const std::string& path, const SeriesOptions&)
{
  throw IOError(path,
    "is a NetCDF file, which this build of TIPP does not read; install the NetCDF library "
    "(Debian's libnetcdf-dev) and build TIPP again.");
}

std::unique_ptr<MeshSeries> openVtkHdfSeries(const std::string& path, const SeriesOptions&)
{
  throw IOError(path,
    "is a VTKHDF file, which this build of TIPP does not read; install the NetCDF library "
    "(Debian's libnetcdf-dev) and build TIPP again.");
}

bool isVtkHdfSeries(const std::string&)
{
  return false;
}

std::unique_ptr<SeriesOutput> createNetcdfSeries(
  const std::string& path, const SeriesDescription&, const PathState&)
{
  throw IOError(path,
    "cannot be written: this build has no NetCDF; install the NetCDF library (Debian's "
    "libnetcdf-dev) and build again, or write .tif, .npy or .pvd.");
}

void requireNetcdfFor(const std::string& output)
{
  if (isOpenedBy(output, Opener::Netcdf))
  {
    throw IOError(output,
      "cannot be written: this build has no NetCDF; install the NetCDF library (Debian's "
      "libnetcdf-dev) and build again, or write another format.");
  }
}

bool writeUgrid(const std::string& path, const UgridContent&, const std::optional<PathState>&,
  const std::function<bool()>&)
{
  requireNetcdfFor(path);
  return false;
}

} // namespace tipp
