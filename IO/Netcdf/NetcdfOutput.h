// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippNetcdfOutput_h
#define tippNetcdfOutput_h

#include "Arrays/Scalar.h"
#include "Files/PendingOutput.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tipp
{

/// A NetCDF-4 file that is written with the NetCDF library or, in a build without it, by
/// NetcdfHook. It appears when it is complete; without close() it is removed. All functions throw
/// IOError.
class NetcdfOutput
{
public:
  /// `before` as for PendingFile. `isClassic`: only the types of the classic formats, which all
  /// programs read. `advice`: what to do where a name is not valid, such as "rename it".
  NetcdfOutput(const std::string& path, const std::optional<PathState>& before, bool isClassic,
    std::string advice);
  ~NetcdfOutput();
  NetcdfOutput(const NetcdfOutput&) = delete;
  NetcdfOutput& operator=(const NetcdfOutput&) = delete;

  /// Throws if no file can be written, because a package is not installed. `path`: of a file to be
  /// written later.
  static void requireWriter(const std::string& path);

  /// The number of a variable that stands for the whole file.
  static const int global;
  /// Sets an attribute, unless the text is empty.
  void setText(int variable, const char* name, const std::string& text) const;
  void setInteger(int variable, const char* name, int value) const;
  int addDimension(const std::string& name, std::size_t size) const;
  int addUnlimited(const std::string& name) const;
  int addVariable(const std::string& name, Scalar type, const std::vector<int>& dimensions) const;
  /// Lets a variable be stored in compressed chunks.
  void compress(int variable, const std::vector<std::size_t>& chunk) const;
  /// The fill value of a variable of floating-point numbers becomes NaN.
  void fillWithNaN(int variable, Scalar type) const;
  /// All values of a variable are values, also the one that stands for missing ones elsewhere.
  void withoutFill(int variable) const;
  void endDefinitions() const;

  /// Writes a part of a variable, in its type.
  void write(int variable, const std::vector<std::size_t>& start,
    const std::vector<std::size_t>& count, const void* values) const;

  /// Completes the file.
  void close();

private:
  struct State;
  std::unique_ptr<State> Own;
};

} // namespace tipp

#endif
