// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippNetcdfFile_h
#define tippNetcdfFile_h

#include "Files/HelperProcess.h"
#include "Netcdf/NetcdfContent.h"
#include "Netcdf/NetcdfLibrary.h"
#include "vtkTIPPIOModule.h"

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tipp
{

/// A NetCDF file open for reading. The library runs in a HelperProcess, so that a damaged file
/// gives an error and nothing else, and decompression takes time beside the caller's work. All
/// functions throw IOError. Threads may not use the object concurrently.
class VTKTIPPIO_EXPORT NetcdfFile
{
public:
  /// `group`: a group whose variables are read, with those of the groups in it, whose names are
  /// before theirs, with slashes; empty: the variables that are in no group.
  explicit NetcdfFile(const std::string& path, const std::string& group = "");

  const std::string& path() const { return this->Path; }
  const NetcdfContent& content() const { return this->Content; }

  /// Reads a part of a variable as numbers: with scale_factor and add_offset applied; NaN for
  /// _FillValue, missing_value, NetCDF's own fill value, and outside of valid_min, valid_max and
  /// valid_range.
  void read(const NetcdfVariable& variable, const std::vector<std::int64_t>& start,
    const std::vector<std::int64_t>& count, std::vector<double>& values);
  /// Reads a whole variable.
  std::vector<double> read(const NetcdfVariable& variable);

  /// In the result of readIntegers(): there is no value.
  static constexpr std::int64_t Missing = std::numeric_limits<std::int64_t>::min();
  /// Reads a whole variable as integers, which numbers with a decimal point may be.
  std::vector<std::int64_t> readIntegers(const NetcdfVariable& variable);
  /// Reads a part of a variable so.
  std::vector<std::int64_t> readIntegers(const NetcdfVariable& variable,
    const std::vector<std::int64_t>& start, const std::vector<std::int64_t>& count);

  /// Reads a part of a variable as the bytes of its values in the type of the variable.
  void readStored(const NetcdfVariable& variable, const std::vector<std::int64_t>& start,
    const std::vector<std::int64_t>& count, std::vector<char>& bytes);

  /// Reads a whole array of characters.
  std::string readText(const NetcdfVariable& variable);

  /// Begins to read a part, which the next call of read() should ask for.
  void prefetch(const NetcdfVariable& variable, const std::vector<std::int64_t>& start,
    const std::vector<std::int64_t>& count);

  /// Frees the memory that the library keeps for chunks, until the next call.
  void rest();

private:
  /// The values of a part, in their type, until the next call.
  const char* fetch(const NetcdfVariable& variable, const NetcdfPart& part, std::size_t bytes);
  /// Return the number of values in a part. Throw IOError if the memory cannot hold them or, in the
  /// second case, if they are no numbers.
  ///@{
  std::size_t checkPart(const NetcdfVariable& variable, const NetcdfPart& part) const;
  std::size_t requireNumbers(const NetcdfVariable& variable, const NetcdfPart& part) const;
  ///@}
  std::string receive(const std::string& what);
  void start();

  std::string Path;
  std::string Group;
  NetcdfContent Content; ///< stays where it is
  bool HasContent = false;
  std::unique_ptr<HelperProcess> Helper;
  std::optional<NetcdfPart> Pending; ///< asked for and not received
};

} // namespace tipp

#endif
