// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPendingFile_h
#define tippPendingFile_h

#include "Files/TemporaryPath.h"
#include "vtkTIPPIOModule.h"

#include <string>

namespace tipp
{

/// An output file under a temporary name in its own folder until commit() renames it; without
/// commit() it goes away. So a failed or aborted run leaves nothing half-written, and what was at
/// the path before stays. What a killed process has left, the next one for the same path removes.
class VTKTIPPIO_EXPORT PendingFile
{
public:
  /// Throws IOError if the path's folder is missing or closed to us or the path is not an ordinary
  /// file.
  explicit PendingFile(const std::string& path);
  ~PendingFile();
  PendingFile(const PendingFile&) = delete;
  PendingFile& operator=(const PendingFile&) = delete;

  /// Write here.
  const std::string& temporaryPath() const { return this->Temporary; }

  /// Renames the temporary file to the path; throws IOError.
  void commit();

private:
  std::string Path;
  std::string Temporary;
  TemporaryPath Listed;
  int Lock = -1; ///< held as long as the process lives
};

} // namespace tipp

#endif
