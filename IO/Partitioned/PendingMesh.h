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
  ~PendingMesh();
  PendingMesh(const PendingMesh&) = delete;
  PendingMesh& operator=(const PendingMesh&) = delete;

  const std::string& temporaryPath() const { return this->Temporary; }

  /// Puts it in the path's place in one step and removes the mesh that was there. Everything in it
  /// must be safe on the disk. Throws IOError.
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
