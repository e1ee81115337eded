// SPDX-License-Identifier: BSD-3-Clause
#include "OutOfCore/RunSetup.h"

#include "Files/IOError.h"
#include "Files/TextFile.h"
#include "OutOfCore/PieceRun.h"
#include "Partitioned/NeighborIds.h"

#include <algorithm>

namespace tipp
{
template <typename Archive>
void RunSetup::exchangeInput(Archive& archive)
{
  archive(this->Survey, this->Columns, this->Rows, this->Mesh.Arrays, this->Marks);
}

void RunSetup::save(SaveArchive& archive)
{
  this->exchangeInput(archive);
  this->Plan->save(archive);
  archive(std::uint8_t(this->Constraints != nullptr));
  this->Constraints ? this->Constraints->save(archive) : void();
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

void RunSetup::describeMesh()
{
  this->Mesh.Domain = this->boundsOf(this->Survey.Bounds);
  describePieces(
    *this->Plan, this->Survey.Points,
    [this](PartitionIndex piece) { return this->boundsOf(this->Plan->Pieces.box(piece)); },
    this->Mesh);
}

Box2 RunSetup::inputBounds() const
{
  const Bounds bounds = this->boundsOf(this->Survey.Bounds);
  return { bounds[0], bounds[2], bounds[1], bounds[3] };
}

void RunSetup::beginTaking() const
{
  if (this->Consumer)
  {
    this->Consumer->begin(this->inputBounds(), this->Columns, this->Results);
  }
}

std::uint64_t RunSetup::takenBytes() const
{
  return this->Consumer ? this->Consumer->fileBytes(this->inputBounds(), this->Columns) : 0;
}

Bounds RunSetup::boundsOf(const Box2& box) const
{
  const double factor = this->Survey.Factor;
  return { box.xmin / factor, box.xmax / factor, box.ymin / factor, box.ymax / factor, 0, 0 };
}

void RunSetup::setConstraints(const std::string& points, SegmentSource& segments, int threads)
{
  const auto forEach = [&segments](const VisitSegment& visit) { segments.forEach(visit); };
  this->Constraints = segments.count() == 0
    ? nullptr
    : std::make_unique<PieceSegments>(points, *this->Plan, this->Survey.Factor, forEach, threads);
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
  return "TIPP out of core 14\n" + input.identity() + std::to_string(options.Columns) + "x" +
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
