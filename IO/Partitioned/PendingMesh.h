// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPendingMesh_h
#define tippPendingMesh_h

#include "vtkTIPPIOModule.h"

#include <string>

namespace tipp
{

/// The folder of a partitioned mesh under a hidden, temporary name beside its path until commit().
/// Without commit() it goes away; what a killed process has left, the next one for the same path
/// clears away.
class VTKTIPPIO_EXPORT PendingMesh
{
public:
  /// Throws IOError if the path's own folder is missing or closed to us, or if there is something
  /// at the path other than a partitioned mesh or an empty folder.
  explicit PendingMesh(const std::string& path);
  /// With a name that stays the same, ".NAME.part": it may be there already, from a run that did
  /// not end, and after keep() it stays where there was no commit(). Throws IOError also if another
  /// process has it.
  static PendingMesh lasting(const std::string& path) { return { path, true }; }
  ~PendingMesh();
  PendingMesh(const PendingMesh&) = delete;
  PendingMesh& operator=(const PendingMesh&) = delete;

  const std::string& temporaryPath() const { return this->Temporary; }
  void keep(bool kept = true) { this->Kept = kept; }

  /// Puts it in the path's place in one step and removes the mesh that was there. Everything in it
  /// must be safe on the disk. Throws IOError.
  void commit();

private:
  PendingMesh(const std::string& path, bool lasting);
  void openLasting(const std::string& path, const std::string& name);
  void clearLeftovers(const std::string& prefix) const;
  void exchange() const;

  std::string Path;
  std::string Parent;
  std::string Temporary;
  bool Kept = false;
  int Lock = -1; ///< held as long as the process lives
};

} // namespace tipp

#endif
