// SPDX-License-Identifier: BSD-3-Clause
#include "OutOfCore/RunRecord.h"

#include "Files/IOError.h"
#include "Files/OutputFile.h"
#include "Partitioned/FinishedPieces.h"

namespace tipp
{

bool RunRecord::resume(bool resumes, int threads, const Load& begun, const Load& whole)
{
  if (!this->Scratch.hasRun())
  {
    return false;
  }
  this->keep(true);
  const Bytes bytes = readCheckedFile(this->Scratch.plan());
  LoadArchive archive(bytes);
  std::string identity;
  archive(identity);
  const bool isOurs = identity == this->Identity;
  archive(this->Reached, this->Fingerprint);
  if (!this->isWhole())
  {
    this->requireOurs(isOurs && resumes, resumes);
    begun(archive);
    return true;
  }
  this->IsInPlace = this->Reached == Stage::Whole && holdsMesh(this->Path, this->Fingerprint);
  // The other run's mesh is already published, so its remains are useless.
  if (this->IsInPlace && !isOurs)
  {
    this->keep(false);
    this->Reached = Stage::Begun;
    this->IsInPlace = false;
    return false;
  }
  this->requireOurs(isOurs, resumes);
  whole(archive);
  if (this->hasMeshToPublish())
  {
    this->verifyWhole(threads);
  }
  return true;
}

void RunRecord::requireOurs(bool isOurs, bool resumes) const
{
  if (!isOurs)
  {
    throw IOError(this->Path,
      resumes
        ? "was started with another or since changed input, with other options, or by another "
          "version of TIPP; give those, or remove " +
          this->Pending.workPath() + " to start again."
        : "was started by another run, whose files are in " + this->Pending.workPath() +
          "; resume that run, or remove the folder to start again.");
  }
}

/// Verifies the mesh: the process that made it has ended, and its files may have changed since.
void RunRecord::verifyWhole(int threads) const
{
  try
  {
    verifyMesh(this->Pending.temporaryPath(), this->Fingerprint, threads);
  }
  catch (const IOError& error)
  {
    throw IOError(error.path(),
      "is damaged or missing; remove " + this->Pending.workPath() + " and start again.");
  }
}

void RunRecord::save(Stage stage, const Save& save, std::uint64_t fingerprint)
{
  this->Reached = stage;
  this->Fingerprint = fingerprint;
  writeCheckedFile(this->Scratch.plan(),
    [&](SaveArchive& archive)
    {
      archive(this->Identity, this->Reached, this->Fingerprint);
      save(archive);
    });
  if (this->isWhole())
  {
    syncToDisk(this->Scratch.plan());
    syncToDisk(this->Pending.workPath());
  }
  this->keep(true);
}

void RunRecord::putInPlace()
{
  if (this->hasMeshToPublish())
  {
    this->Pending.commit();
  }
  this->keep(false);
}

} // namespace tipp
