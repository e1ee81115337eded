// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPendingFolder_h
#define tippPendingFolder_h

#include "vtkTIPPIOModule.h"

#include <functional>
#include <string>

namespace tipp
{

/// What a folder that is there already must be to be replaced.
struct Replaceable
{
  const char* Name; ///< as "partitioned mesh"
  std::function<bool(const std::string& path)> Is;
};

/// An output folder under a hidden, temporary name beside its path until commit(). Without commit()
/// it goes away; what a killed process has left, the next one for the same path clears away.
class VTKTIPPIO_EXPORT PendingFolder
{
public:
  /// Throws IOError if the path's own folder is missing or closed to us, or if there is something
  /// at the path other than an empty folder or, where it is given, what may be replaced.
  explicit PendingFolder(const std::string& path, const Replaceable* replaceable = nullptr);
  ~PendingFolder();
  PendingFolder(const PendingFolder&) = delete;
  PendingFolder& operator=(const PendingFolder&) = delete;

  /// Write in here.
  const std::string& temporaryPath() const { return this->Temporary; }

  /// Puts it in the path's place in one step and removes what was there. What is in it must be safe
  /// on the disk, if it is to be so afterwards. Throws IOError.
  void commit();

private:
  void clearLeftovers(const std::string& prefix) const;
  void exchange() const;

  std::string Path;
  std::string Parent;
  std::string Temporary;
  int Lock = -1; ///< held as long as the process lives
};

} // namespace tipp

#endif
