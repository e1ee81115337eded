// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTemporaryPath_h
#define tippTemporaryPath_h

#include "vtkTIPPIOModule.h"

#include <functional>
#include <string>

namespace tipp
{

/// Lists a temporary file or folder while it lives, so that whoever ends the process without
/// unwinding, as on a signal, can remove it. It removes nothing itself.
class VTKTIPPIO_EXPORT TemporaryPath
{
public:
  TemporaryPath() = default;
  ~TemporaryPath() { this->unlist(); }
  TemporaryPath(const TemporaryPath&) = delete;
  TemporaryPath& operator=(const TemporaryPath&) = delete;

  void list(const std::string& path);
  /// Messages name what is in the folder `temporary` as what it becomes, in `final`.
  void showAs(const std::string& temporary, const std::string& final);
  void unlist();
  /// A path that is kept stays when the process ends: a later run goes on with it.
  void keep(bool kept);

private:
  std::string Path;
  std::string Shown; ///< the folder that messages name otherwise
};

/// What a user knows a path as: that of the finished output, for one in a listed folder.
VTKTIPPIO_EXPORT std::string shownPath(const std::string& path);

/// Moves an output to `path` by `move`, which endTemporaryPaths() does not cut short.
VTKTIPPIO_EXPORT void commitOutput(const std::string& path, const std::function<void()>& move);

struct EndedPaths
{
  bool HasOutput = false; ///< an output outside of the listed paths was committed
  bool HasKept = false;   ///< a listed path was kept
};

/// Removes all listed paths but those that are kept. Afterwards no output can be committed and no
/// path listed or unlisted: threads that try wait for ever. To be called just before the process
/// ends.
VTKTIPPIO_EXPORT EndedPaths endTemporaryPaths();

} // namespace tipp

#endif
