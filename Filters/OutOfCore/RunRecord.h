// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRunRecord_h
#define tippRunRecord_h

#include "OutOfCore/ScratchFiles.h"

#include <cstdint>
#include <functional>
#include <string>

namespace tipp
{

/// The record of a run out of core in its work folder: how far the run is, and what another process
/// needs to resume it. All that a record names is on disk before the record is written.
class RunRecord
{
public:
  using Save = std::function<void(SaveArchive&)>;
  using Load = std::function<void(LoadArchive&)>;

  /// `path`: the mesh's; `identity`: equal for runs that make the same mesh from the same input.
  /// The folders must outlive this.
  RunRecord(const std::string& path, const std::string& identity, PendingFolder& pending,
    ScratchFolder& scratch)
    : Path(path)
    , Identity(identity)
    , Pending(pending)
    , Scratch(scratch)
  {
  }

  /// Reads the record of an earlier process, if there is one, and calls `begun` with what was given
  /// to saveBegun(), or `whole` with what was given to saveWhole() or saveCounted(). Verifies a
  /// complete mesh. Returns false if there is nothing to resume. Throws IOError if the record is
  /// damaged or of another run and, unless `resumes`, if the mesh is not complete; the work is kept
  /// then.
  bool resume(bool resumes, int threads, const Load& begun, const Load& whole);

  /// The points are spilled; from now on the work is kept.
  void saveBegun(const Save& save);
  /// The mesh is complete. From now on only the mesh in the work folder is needed, and a resumed
  /// run only has to move it to its path.
  void saveWhole(std::uint64_t fingerprint, const Save& save);
  /// The same for a run that makes no mesh.
  void saveCounted(const Save& save);

  bool isWhole() const { return this->Reached != Stage::Begun; }
  /// Moves a whole mesh to its path, unless it is there; the rest of the work is no longer kept.
  void putInPlace();

  /// Whether the work stays when this process ends.
  void keep(bool kept);
  bool isKept() const { return this->Pending.isKept(); }

private:
  enum class Stage : std::uint8_t
  {
    Begun,
    Whole,
    Counted
  };

  void write(Stage stage, const Save& save);
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
