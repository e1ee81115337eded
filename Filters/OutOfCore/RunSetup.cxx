// SPDX-License-Identifier: BSD-3-Clause
#include "OutOfCore/RunSetup.h"

#include "Files/IOError.h"
#include "OutOfCore/LoadedPiece.h"

#include <algorithm>

namespace tipp
{

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
      std::make_unique<SpilledSegments>(points, *this->Plan, this->Survey.Factor, archive);
  }
  this->loadPoints(archive, points);
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

void RunSetup::setConstraints(const std::string& points, ConstrainedStream& segments, int threads)
{
  this->Constraints.reset();
  if (segments.count() > 0)
  {
    this->Constraints = std::make_unique<SpilledSegments>(
      points, *this->Plan, this->Survey.Factor,
      [&segments](const VisitSegment& visit) { segments.forEachUncovered(visit); }, threads);
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

} // namespace tipp
