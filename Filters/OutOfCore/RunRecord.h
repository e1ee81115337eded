// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRunRecord_h
#define tippRunRecord_h

#include "Files/PendingOutput.h"
#include "OutOfCore/ScratchFiles.h"
#include "Ranks/Archive.h"

#include <cstdint>
#include <functional>
#include <string>

namespace tipp
{

/// The record of a run out of core, a file in its work folder: how far the run is, and the data
/// that another process needs to resume it. A record is written after the files that it refers to
/// are on disk.
class RunRecord
{
public:
  using Save = std::function<void(SaveArchive&)>;
  using Load = std::function<void(LoadArchive&)>;

  /// `path`: of the mesh. `identity`: a text that is equal for runs that make the same mesh from
  /// the same input. Both folders must outlive this object.
  RunRecord(const std::string& path, const std::string& identity, PendingFolder& pending,
    ScratchFolder& scratch)
    : Path(path)
    , Identity(identity)
    , Pending(pending)
    , Scratch(scratch)
  {
  }

  /// Reads the record of an earlier process, if there is one. Calls `begun` with the data
  /// saved at Stage::Begun, or `whole` with the data saved at a later stage. Verifies the mesh if
  /// it is complete. Returns false if there is nothing to resume. Throws IOError if the record is
  /// damaged or belongs to another run, or if the mesh is incomplete and `resumes` is false; the
  /// work folder is kept in these cases.
  bool resume(bool resumes, int threads, const Load& begun, const Load& whole);

  enum class Stage : std::uint8_t
  {
    Begun,  ///< the points are spilled
    Whole,  ///< the mesh is complete; a resumed run only has to move it from the work folder
    Counted ///< all triangles or tetrahedra are counted, for a run that makes no mesh
  };
  /// Records that the run has reached a stage. From now on the work folder is kept. `fingerprint`:
  /// of a complete mesh. Throws IOError.
  void save(Stage stage, const Save& save, std::uint64_t fingerprint = 0);

  /// Returns whether the mesh is complete, or all is counted.
  bool isWhole() const { return this->Reached != Stage::Begun; }
  /// Moves a complete mesh to its path, unless it is already there. The rest of the work folder is
  /// no longer kept.
  void putInPlace();

  /// Sets whether the work folder is kept when this process ends.
  void keep(bool kept) { this->Scratch.keep(kept); }
  bool isKept() const { return this->Scratch.isKept(); }

private:
  bool hasMeshToPublish() const { return this->Reached == Stage::Whole && !this->IsInPlace; }
  void requireOurs(bool isOurs, bool resumes) const;
  void verifyWhole(int threads) const;

  const std::string Path;
  const std::string Identity;
  PendingFolder& Pending;
  ScratchFolder& Scratch;
  Stage Reached = Stage::Begun;
  std::uint64_t Fingerprint = 0; ///< of the complete mesh, if there is one
  bool IsInPlace = false;        ///< the mesh is already at Path
};

} // namespace tipp

#endif
