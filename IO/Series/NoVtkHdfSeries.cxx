// SPDX-License-Identifier: BSD-3-Clause
// Replaces Series/VtkHdfSeries.cxx in a build without the NetCDF library.
#include "Files/IOError.h"
#include "Series/VtkHdfSeries.h"

#include <string>

namespace tipp
{
namespace
{

#ifdef TIPP_WITHOUT_VTK
constexpr const char* advice = "which the Python wheel does not read; convert it.";
#else
constexpr const char* advice =
  "which this build of TIPP does not read; install the NetCDF library (Debian's libnetcdf-dev) and "
  "build TIPP again.";
#endif

} // namespace

std::unique_ptr<MeshSeries> openVtkHdfSeries(const std::string& path, const SeriesOptions&)
{
  throw IOError(path, std::string("is a VTKHDF file, ") + advice);
}

bool isVtkHdfSeries(const std::string&)
{
  return false;
}

} // namespace tipp
