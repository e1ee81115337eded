// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPendingFile_h
#define tippPendingFile_h

#include "Files/OutputFile.h"
#include "Files/OutputPath.h"
#include "Files/TemporaryPath.h"
#include "vtkTIPPIOModule.h"

#include <optional>
#include <string>

namespace tipp
{

/// An output file with a temporary name in its own folder, which commit() moves to its path;
/// without commit() the destructor removes it. So a failed or aborted run leaves no partial file,
/// and the previous file stays. What a killed process has left is removed by the next run for the
/// same path.
class VTKTIPPIO_EXPORT PendingFile
{
public:
  /// Throws IOError if the file cannot be created or something other than a regular file is at the
  /// path. `before` is the path's state when the run began, from before() of an earlier object;
  /// commit() replaces nothing else. nullopt: the present state.
  explicit PendingFile(
    const std::string& path, const std::optional<PathState>& before = std::nullopt);
  ~PendingFile();
  PendingFile(const PendingFile&) = delete;
  PendingFile& operator=(const PendingFile&) = delete;

  const PathState& before() const { return this->Before; }

  /// The temporary file to write to.
  const OutputFile& file() const { return *this->File; }
  const std::string& temporaryPath() const { return this->Temporary; }

  /// Moves the file to its path once it is on the disk. Throws IOError if that fails or if the path
  /// has changed since the constructor; then the finished file keeps its temporary name.
  void commit();

private:
  std::string Path;
  std::string Temporary;
  TemporaryPath Listed;
  PathState Before;
  std::optional<OutputFile> File; ///< locked while it is open
};

} // namespace tipp

#endif
