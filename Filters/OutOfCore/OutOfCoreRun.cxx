// SPDX-License-Identifier: BSD-3-Clause
#include "OutOfCore/OutOfCoreRun.h"

#include "Constraints/OnDisk/UncoveredSegments.h"
#include "Files/IOError.h"
#include "Files/OutputFile.h"
#include "Files/TextFile.h"
#include "OutOfCore/PieceRun.h"
#include "Partitioned/FinishedPieces.h"
#include "Partitioned/PieceFile.h"
#include "Partitioned/PieceFormat.h"

#include <algorithm>

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

template <typename Archive>
void RunSetup::exchangeInput(Archive& archive)
{
  archive(
    this->Survey, this->InputBounds, this->Columns, this->Rows, this->Mesh.Arrays, this->Marks);
}

void RunSetup::save(SaveArchive& archive)
{
  this->exchangeInput(archive);
  this->Plan->save(archive);
  archive(std::uint8_t(this->Constraints != nullptr));
  if (this->Constraints)
  {
    this->Constraints->save(archive);
  }
  this->Spilled->save(archive);
}

void RunSetup::load(LoadArchive& archive, const std::string& points)
{
  this->exchangeInput(archive);
  this->Plan = std::make_unique<PiecePlan>(archive);
  if (archive.get<std::uint8_t>() != 0)
  {
    this->Constraints =
      std::make_unique<PieceSegments>(points, *this->Plan, this->Survey.Factor, archive);
  }
  this->Spilled =
    std::make_unique<SpilledPoints>(points, this->Rows.Words, this->Plan->pieces(), archive);
  this->describeMesh();
}

void describeColumns(const std::vector<std::string>& columns, std::size_t elevation,
  const OutOfCoreRunOptions& options, PointRowLayout& rows, PartitionedMesh& mesh)
{
  rows.Words = 3 + columns.size();
  rows.Z = elevation < columns.size() ? int(2 + elevation) : -1;
  for (std::size_t i = 0; i < columns.size(); ++i)
  {
    if (i != elevation)
    {
      mesh.Arrays.push_back({ columns[i], true, Scalar::Float64, 1, -1 });
      rows.Attributes.push_back(int(2 + i));
    }
  }
  if (options.MapDuplicates)
  {
    mesh.Arrays.push_back({ "RepresentativePointId", true, Scalar::Int64, 1, -1 });
    rows.Attributes.push_back(-1);
  }
  if (options.Neighbors)
  {
    mesh.Arrays.push_back(neighborIdsArray);
    mesh.Arrays.back().Components = mesh.CellSize;
  }
  const std::string name = mesh.Path.empty() ? "" : repeatedName(mesh.Arrays); // else not written
  if (!name.empty())
  {
    throw IOError("The input has two columns named " + name +
      ", or one named as the mesh names an array of its own; rename it, or leave it out.");
  }
}

void RunSetup::describeColumns(
  const std::vector<std::string>& columns, const OutOfCoreOptions& options)
{
  this->Columns = columns;
  const auto z = std::find_if(columns.begin(), columns.end(),
    [](const std::string& name) { return name == "z" || name == "Z"; });
  tipp::describeColumns(columns, std::size_t(z - columns.begin()), options, this->Rows, this->Mesh);
  if (options.MarkConstraints)
  {
    this->Marks = std::int64_t(this->Mesh.Arrays.size());
    this->Mesh.Arrays.push_back({ "ConstraintEdges", false, Scalar::UInt8, 3, -1 });
  }
}

Bounds boundsOf(const Box2& box, double factor)
{
  return { box.xmin / factor, box.xmax / factor, box.ymin / factor, box.ymax / factor, 0, 0 };
}

Bounds boundsOf(const Box3& box, double factor)
{
  return { box.Min[0] / factor, box.Max[0] / factor, box.Min[1] / factor, box.Max[1] / factor,
    box.Min[2] / factor, box.Max[2] / factor };
}

void RunSetup::beginTaking() const
{
  if (this->Consumer)
  {
    this->Consumer->begin(this->InputBounds, this->Columns, this->Results);
  }
}

std::uint64_t RunSetup::takenBytes() const
{
  return this->Consumer ? this->Consumer->fileBytes(this->InputBounds, this->Columns) : 0;
}

void RunSetup::setConstraints(
  const std::string& points, SegmentSource& segments, std::uint64_t memory, int threads)
{
  this->Constraints.reset();
  if (segments.count() > 0)
  {
    const UncoveredSegments uncovered(points + ".lines", segments, memory, threads);
    this->Constraints = std::make_unique<PieceSegments>(
      points, *this->Plan, this->Survey.Factor,
      [&uncovered](const VisitSegment& visit) { uncovered.forEach(visit); }, threads);
  }
  segments.end();
}

void RunSetup::requireMemory(const std::string& path, std::uint64_t limit) const
{
  constexpr std::uint64_t always = std::uint64_t(64) << 20;
  const PieceWork work = this->work();
  for (PartitionIndex piece = 0; piece < this->Plan->pieces(); ++piece)
  {
    const std::int64_t segments = this->Constraints ? this->Constraints->count(piece) : 0;
    const std::uint64_t bytes = LoadedPiece::bytesOf(work, piece);
    if (bytes > std::max(limit, always))
    {
      throw IOError(path,
        "would have a piece of " + std::to_string(this->Spilled->count(piece)) + " points" +
          (segments > 0 ? " and " + std::to_string(segments) + " segments" : "") +
          ", which needs " + std::to_string(bytes / 1000000 + 1) + " MB; allow more memory.");
    }
  }
}

std::string identityOf(const PointStream& input, const OutOfCoreOptions& options)
{
  return "TIPP out of core 15\n" + input.identity() + std::to_string(options.Columns) + "x" +
    std::to_string(options.Rows) + " " + std::to_string(options.PiecePoints) + " " +
    std::to_string(options.PartitionPoints) + (options.MapDuplicates ? " mapped" : "") +
    (options.Neighbors ? " linked" : "") + (options.MarkConstraints ? " marked" : "") +
    (options.CountOnly ? " counted" : "") +
    (options.MaximumEdge > 0 ? " edges " + exactText(options.MaximumEdge) : "") +
    (options.Duplicates != DuplicateRule::First
        ? " duplicates " + std::to_string(int(options.Duplicates))
        : "") +
    "\n" + (options.Consumer ? options.Consumer->identity() : "") + "\n" + options.Scratch;
}

} // namespace tipp
