// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippNetcdfHook_h
#define tippNetcdfHook_h

#include "Netcdf/NetcdfContent.h"
#include "Netcdf/NetcdfLibrary.h"

#include <functional>
#include <string>

namespace tipp
{

/// What reads NetCDF files in a build without the NetCDF library: NetcdfLibrary calls it, in a
/// HelperProcess, for one file in each. Functions throw std::runtime_error with what went wrong.
struct NetcdfHook
{
  /// Returns one sentence on what to install, or an empty text if files can be read. Called in the
  /// process itself.
  std::function<std::string()> missing;
  std::function<NetcdfContent(const std::string& path)> open;
  /// Reads values of the open file in their own type.
  std::function<void(const NetcdfPart& part, void* to)> read;
};

/// The hook of the process; at the start it has no functions.
NetcdfHook& netcdfHook();

} // namespace tipp

#endif
