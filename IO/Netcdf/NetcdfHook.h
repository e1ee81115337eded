// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippNetcdfHook_h
#define tippNetcdfHook_h

#include "Netcdf/NetcdfContent.h"
#include "Netcdf/NetcdfLibrary.h"

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace tipp
{

/// How the values of a variable are stored, and what stands for missing ones.
struct NetcdfStorage
{
  enum class Fill
  {
    Usual,
    NaN,
    None
  };

  std::vector<std::size_t> Chunk; ///< of compressed values; empty: they are not compressed
  Fill Missing = Fill::Usual;
};

/// A NetCDF-4 file to be written, without its values.
struct NetcdfDefinitions
{
  bool IsClassic = false; ///< only the types of the classic formats
  NetcdfContent Content;  ///< a dimension of size 0 is unlimited; numbers of attributes are ints
  std::vector<NetcdfStorage> Storage; ///< of each variable
};

/// A NetCDF file that is being written. Without close() it is incomplete. Functions throw
/// std::runtime_error.
class NetcdfSink
{
public:
  NetcdfSink() = default;
  virtual ~NetcdfSink();
  NetcdfSink(const NetcdfSink&) = delete;
  NetcdfSink& operator=(const NetcdfSink&) = delete;

  /// Writes values in the type of their variable.
  virtual void write(const NetcdfPart& part, const void* values, std::size_t bytes) = 0;
  virtual void close() = 0;
};

/// What reads and writes NetCDF files in a build without the NetCDF library. NetcdfLibrary calls it
/// to read, in a HelperProcess, for one file in each; NetcdfOutput to write, in the process itself.
/// Functions throw std::runtime_error with what went wrong.
struct NetcdfHook
{
  /// Returns one sentence on what to install, or an empty text if files can be read or, with
  /// `isToWrite`, written. Called in the process itself.
  std::function<std::string(bool isToWrite)> missing;
  std::function<NetcdfContent(const std::string& path)> open;
  /// Reads values of the open file in their own type.
  std::function<void(const NetcdfPart& part, void* to)> read;
  /// Creates a file, or replaces what is in it.
  std::function<std::unique_ptr<NetcdfSink>(
    const std::string& path, const NetcdfDefinitions& definitions)>
    create;
};

/// The hook of the process; at the start it has no functions.
NetcdfHook& netcdfHook();

} // namespace tipp

#endif
