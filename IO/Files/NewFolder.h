// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippNewFolder_h
#define tippNewFolder_h

#include "vtkTIPPIOModule.h"

#include <string>

namespace tipp
{

/// An output folder under a temporary name beside its own until commit() renames it; without
/// commit() it goes away with all that is in it. So a failed run leaves nothing half-written.
class VTKTIPPIO_EXPORT NewFolder
{
public:
  /// Throws IOError if there is something at the path already (an empty folder apart), or the
  /// folder around it is missing or closed to us.
  explicit NewFolder(const std::string& path);
  ~NewFolder();
  NewFolder(const NewFolder&) = delete;
  NewFolder& operator=(const NewFolder&) = delete;

  /// Write in here.
  const std::string& temporaryPath() const { return this->Temporary; }

  /// Renames the temporary folder to the path; throws IOError.
  void commit();

private:
  std::string Path;
  std::string Temporary;
};

} // namespace tipp

#endif
