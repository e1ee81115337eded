// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippScratchFolder_h
#define tippScratchFolder_h

#include "Files/PendingOutput.h"

#include <cstdint>
#include <string>
#include <vector>

namespace tipp
{

/// The folders of a run's temporary files until its mesh is published: the spilled points, the
/// plan, and the results of pieces.
class ScratchFolder
{
public:
  /// All files are beside the unfinished mesh if `other` is empty; else the points and the results
  /// are in a new folder in `other`. Throws IOError.
  ScratchFolder(const PendingFolder& mesh, const std::string& other);
  /// Removes everything but after keep().
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::string& folder() const { return this->Folder; }
  std::string points() const { return this->Folder + "/.points"; }
  std::string plan() const { return this->Work + "/.plan"; }
  /// How the paths of pieces' results begin.
  std::string results() const { return this->Folder + "/.piece"; }

  /// Whether there is a run to resume. Results without a plan are of one whose plan was lost.
  bool hasRun() const;
  /// Makes room for a new run, and its empty folder of pieces.
  void clear();
  void keep(bool kept = true)
  {
    this->Kept = kept;
    this->Listed.keep(kept);
  }
  /// Whether so many bytes more fit on the disks of the mesh and of this; throws IOError with the
  /// numbers. `path`: the mesh's, for the error.
  void requireSpace(const std::string& path, std::uint64_t mesh, std::uint64_t scratch) const;
  /// All but the plan, which the mesh's PendingFolder takes away with itself.
  void remove();

private:
  std::vector<std::string> files(const std::string& begin) const;
  void removeFiles(const std::string& begin) const;

  std::string Mesh;
  std::string Work;
  std::string Folder;
  TemporaryPath Listed; ///< Folder, if it is not Work
  bool Kept = false;
};

} // namespace tipp

#endif
