// SPDX-License-Identifier: BSD-3-Clause
#include "OutOfCore/RunSetup.h"

#include "Files/IOError.h"
#include "Files/TextFile.h"
#include "OutOfCore/ScratchFiles.h"
#include "Partitioned/NeighborIds.h"

#include <algorithm>
#include <cstdio>

namespace tipp
{
namespace
{

const StoredArray constraintEdgesArray{ "ConstraintEdges", false, Scalar::UInt8, 3, -1 };

constexpr const char* representativeName = "RepresentativePointId";

} // namespace

template <typename Archive>
void RunSetup::exchangeInput(Archive& archive)
{
  archive(this->Survey.Points, this->Survey.Rejected, this->Survey.WithoutElevation,
    this->Survey.Bounds, this->Survey.Factor, this->Survey.Collinear, this->Columns, this->Rows,
    this->Mesh.Arrays, this->Marks);
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
  this->Spilled = std::make_unique<SpilledPoints>(points, *this->Plan, this->Rows, archive);
  this->describeMesh();
}

void RunSetup::describeColumns(
  const std::vector<std::string>& columns, const OutOfCoreOptions& options)
{
  this->Columns = columns;
  this->Rows.Words = 3 + columns.size();
  for (std::size_t i = 0; i < columns.size(); ++i)
  {
    const bool isZ = this->Rows.Z < 0 && (columns[i] == "z" || columns[i] == "Z");
    if (isZ)
    {
      this->Rows.Z = int(2 + i);
      continue;
    }
    this->Mesh.Arrays.push_back({ columns[i], true, Scalar::Float64, 1, -1 });
    this->Rows.Attributes.push_back(int(2 + i));
  }
  if (options.MapDuplicates)
  {
    this->Mesh.Arrays.push_back({ representativeName, true, Scalar::Int64, 1, -1 });
    this->Rows.Attributes.push_back(-1);
  }
  if (options.Neighbors)
  {
    this->Mesh.Arrays.push_back(neighborIdsArray);
  }
  if (options.MarkConstraints)
  {
    this->Marks = std::int64_t(this->Mesh.Arrays.size());
    this->Mesh.Arrays.push_back(constraintEdgesArray);
  }
}

void RunSetup::describeMesh()
{
  PartitionedMesh& mesh = this->Mesh;
  mesh.Points = this->Survey.Points;
  mesh.Tiling = "delaunay:" + std::to_string(this->Plan->pieces());
  mesh.Domain = this->boundsOf(this->Survey.Bounds);
  mesh.Pieces.resize(std::size_t(this->Plan->pieces()));
  for (PartitionIndex piece = 0; piece < this->Plan->pieces(); ++piece)
  {
    mesh.Pieces[this->Plan->number(piece)].Box = this->boundsOf(this->Plan->Pieces.box(piece));
  }
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
  for (PartitionIndex piece = 0; piece < this->Plan->pieces(); ++piece)
  {
    const std::int64_t segments = this->Constraints ? this->Constraints->count(piece) : 0;
    const std::uint64_t bytes =
      MemoryPlan::pieceBytes(this->Spilled->count(piece), this->Rows.Words) +
      (this->Constraints ? this->Constraints->bytesOf(piece) : 0);
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
  return "TIPP out of core 13\n" + input.identity() + std::to_string(options.Columns) + "x" +
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
