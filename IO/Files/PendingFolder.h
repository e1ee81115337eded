// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPendingFolder_h
#define tippPendingFolder_h

#include "Files/TemporaryPath.h"
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
  /// In a folder of its own whose name stays the same, ".NAME.part": that may be there already,
  /// from a run that did not end, and is then kept until keep(false); after keep() it stays. What
  /// is in it beside the output is never published. Throws IOError also if another process has it.
  static PendingFolder lasting(const std::string& path, const Replaceable* replaceable)
  {
    return { path, replaceable, true };
  }
  ~PendingFolder();
  PendingFolder(const PendingFolder&) = delete;
  PendingFolder& operator=(const PendingFolder&) = delete;

  /// Write in here.
  const std::string& temporaryPath() const { return this->Temporary; }
  /// The folder that goes away at the end: ".NAME.part", or the temporary one itself.
  const std::string& workPath() const { return this->Work; }
  bool isKept() const { return this->Kept; }
  void keep(bool kept = true)
  {
    this->Kept = kept;
    this->Listed.keep(kept);
  }

  /// Puts it in the path's place in one step and removes what was there. What is in it must be safe
  /// on the disk, if it is to be so afterwards. Throws IOError.
  void commit();

private:
  PendingFolder(const std::string& path, const Replaceable* replaceable, bool isLasting);
  void makeTemporary(const std::string& prefix);
  void openLasting(const std::string& folder, const std::string& name);
  void clearLeftovers(const std::string& prefix) const;
  void exchange() const;

  std::string Path;
  std::string Parent;
  std::string Temporary;
  std::string Work; ///< it, or the folder around it
  TemporaryPath Listed;
  bool Kept = false;
  int Lock = -1; ///< held as long as the process lives
};

} // namespace tipp

#endif
