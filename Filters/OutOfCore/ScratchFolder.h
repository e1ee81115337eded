// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippScratchFolder_h
#define tippScratchFolder_h

#include <cstdint>
#include <string>

namespace tipp
{

/// Where a run keeps what it needs until its mesh is whole: the spilled points, the plan and the
/// state to go on from.
class ScratchFolder
{
public:
  /// `meshFolder`: of the mesh in the making. The points are there, too, if `other` is empty; else
  /// a folder of the mesh's name is made there. Throws IOError.
  ScratchFolder(const std::string& meshFolder, const std::string& other);
  /// Removes everything but after keep().
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  std::string points() const { return this->Folder + "/.points"; }
  std::string plan() const { return this->Mesh + "/.plan"; }
  std::string state() const { return this->Mesh + "/.state"; }

  bool hasPlan() const;
  /// Makes an empty folder of pieces, and room for a new run.
  void clear();
  void keep() { this->Kept = true; }
  /// Whether so many bytes more fit on the disks of the mesh and of this; throws IOError with the
  /// numbers. `path`: the mesh's, for the error.
  void requireSpace(const std::string& path, std::uint64_t mesh, std::uint64_t scratch) const;
  void remove();

private:
  std::string Mesh;
  std::string Folder;
  bool Kept = false;
};

} // namespace tipp

#endif
