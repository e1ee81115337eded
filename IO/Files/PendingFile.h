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

/// An output file under a temporary name in its own folder until commit() puts it in its place;
/// without commit() it goes away. So a failed or aborted run leaves nothing half-written, and what
/// was at the path before stays. What a killed process has left, the next one for the same path
/// removes.
class VTKTIPPIO_EXPORT PendingFile
{
public:
  /// Throws IOError if the file cannot be created or something other than an ordinary file is at
  /// the path. Before: what is at the path when the run begins, as before() of an earlier object
  /// tells; commit() replaces nothing else. None: what is there now.
  explicit PendingFile(
    const std::string& path, const std::optional<PathState>& before = std::nullopt);
  ~PendingFile();
  PendingFile(const PendingFile&) = delete;
  PendingFile& operator=(const PendingFile&) = delete;

  const PathState& before() const { return this->Before; }

  /// Write here.
  const OutputFile& file() const { return *this->File; }
  const std::string& temporaryPath() const { return this->Temporary; }

  /// Puts the file in its place when it is safe on the disk. Throws IOError, also if what is at the
  /// path has changed since the constructor; then the finished file stays beside it.
  void commit();

private:
  std::string Path;
  std::string Temporary;
  TemporaryPath Listed;
  PathState Before;
  std::optional<OutputFile> File; ///< locked as long as it is open
};

} // namespace tipp

#endif
