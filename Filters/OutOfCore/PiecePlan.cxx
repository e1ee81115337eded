// SPDX-License-Identifier: BSD-3-Clause
#include "OutOfCore/PiecePlan.h"

#include "Files/IOError.h"
#include "Triangulation/InitialMesh.h"

#include <algorithm>

namespace tipp
{
namespace
{

int countFor(double points, std::int64_t each, std::size_t sampled)
{
  const double wanted = std::max(1.0, points / double(each));
  const double possible = std::max(1.0, double(sampled) / 8);
  constexpr double most = 1 << 22;
  return static_cast<int>(std::min({ wanted, possible, most }));
}

/// Returns the regions of all partitions. A region is the partition's box, because its points have
/// not been read yet.
Regions regionsOf(const PiecePlan& plan, const SpilledPoints& points)
{
  std::vector<Box2> boxes;
  std::vector<char> used;
  for (PartitionIndex p = 0; p < plan.Partitions.size(); ++p)
  {
    boxes.push_back(plan.Partitions.box(p));
    used.push_back(points.count(plan.PieceOf[std::size_t(p)]) > 0);
  }
  return { plan.Partitions, std::move(boxes), std::move(used) };
}

/// Returns the conflicts between pieces; an empty list if all partitions conflict.
std::vector<ConflictGraph::Pair> conflictsOfPieces(
  const PartitionOrder& partitions, const std::vector<std::int32_t>& pieceOf)
{
  const ConflictGraph& conflicts = partitions.conflicts();
  std::vector<ConflictGraph::Pair> pairs;
  for (PartitionIndex p = 0; std::size_t(p) < conflicts.size(); ++p)
  {
    const std::int32_t piece = pieceOf[std::size_t(p)];
    for (const PartitionIndex q : conflicts.neighbours(p))
    {
      if (pieceOf[std::size_t(q)] != piece)
      {
        pairs.emplace_back(piece, pieceOf[std::size_t(q)]);
      }
    }
  }
  return pairs;
}

/// Returns the 64-bit words of memory per spilled row of `words` words. A consumer copies
/// coordinates, columns and triangles of each piece. Constraints need memory for the triangles that
/// they cross.
std::size_t wordsInMemory(const OutOfCoreOptions& options, std::size_t words, bool hasConstraints)
{
  return words + (options.Consumer ? 4 + words : 0) + (hasConstraints ? 1 : 0);
}

} // namespace

std::uint64_t MemoryPlan::pieceBytes(std::int64_t points, std::size_t rowWords)
{
  // Rows; points, whose memory triangles take later; labels, later numbers; interface flags.
  return std::uint64_t(points) * (8 * rowWords + 24 + 4 + 1);
}

InputMemory::InputMemory(std::uint64_t limit, std::size_t rowWords)
{
  // Two blocks of points, their labels, and their rows sorted by piece.
  const std::size_t perPoint = 2 * 8 * (rowWords - 1) + 4 + 8 * rowWords;
  constexpr std::size_t mostPoints = std::size_t(1) << 22;
  this->BlockPoints =
    std::clamp<std::size_t>(std::size_t(limit / 5 * 2) / perPoint, 1 << 14, mostPoints);
  this->SamplePoints =
    std::clamp<std::size_t>(std::size_t(limit / 512), std::size_t(1) << 14, std::size_t(1) << 20);
}

MemoryPlan::MemoryPlan(const OutOfCoreOptions& options, std::size_t words, bool hasConstraints)
  : InputMemory(options.MemoryLimit, wordsInMemory(options, words, hasConstraints))
{
  const std::size_t rowWords = wordsInMemory(options, words, hasConstraints);
  // The two phases, spilling and triangulating, get the same share. The rest is for kernels and
  // boundary vertices.
  const std::uint64_t share = options.MemoryLimit / 5 * 2;
  this->LoadedBytes = share / pieceBytes(1, rowWords) * pieceBytes(1, words);
  // One piece being written, two being triangulated and one being loaded. The number does not
  // depend on the threads, so that the pieces do not, either.
  constexpr std::uint64_t together = 4;
  const std::uint64_t most = share / together / pieceBytes(1, rowWords);
  this->PiecePoints = options.PiecePoints > 0
    ? options.PiecePoints
    : std::clamp<std::int64_t>(std::int64_t(most), 4096, std::int64_t(1) << 20);
  this->PartitionPoints = options.PartitionPoints > 0
    ? options.PartitionPoints
    : std::min(BestPointsInPartition, this->PiecePoints);
}

PiecePlan::PiecePlan(const InputSurvey& survey, const OutOfCoreOptions& options,
  const MemoryPlan& memory, std::size_t rowWords, int threads)
{
  const double points = double(survey.Points - survey.Rejected);
  const bool isGrid = options.Columns > 0 && options.Rows > 0;
  this->Pieces = isGrid ? Tiling::grid(survey.Bounds, options.Columns, options.Rows)
                        : Tiling::balanced(survey.Bounds, positionsOf(survey.Sample),
                            countFor(points, memory.PiecePoints, survey.Sample.size()));
  this->choosePartitions(survey, memory);
  this->Artificial = makeArtificialPoints(this->Partitions);
  constexpr std::uint64_t kernelBytes = 250; // per point
  const std::int64_t count = survey.Points - survey.Rejected;
  const bool fits = options.MemoryLimit / 2 >=
    MemoryPlan::pieceBytes(count, rowWords) + kernelBytes * std::uint64_t(count);
  if (this->Artificial.empty())
  {
    if (!fits)
    {
      throw IOError("The coordinates are too large for 64-bit numbers; scale them down.");
    }
    this->takeAlone(survey);
    return;
  }
  const auto pays = [&](int pointsPerPartition)
  {
    this->chooseInitialPoints(survey, pointsPerPartition);
    return partitionsPay(triangulateVertices<2>(this->Partitions, this->initialVertices(), threads),
      MostMetPartitions);
  };
  // With more points the circumdisks shrink, but not those of points on a curve.
  this->HasLargeInterface = !pays(InitialPointsOfPartition) && !pays(4 * InitialPointsOfPartition);
  if (!isGrid && fits && this->HasLargeInterface)
  {
    this->takeAlone(survey);
  }
  else if (this->HasLargeInterface)
  {
    this->takeWholePieces(survey);
  }
}

/// Makes each piece a single partition: nearly all vertices are sent from partition to partition,
/// so fewer partitions are faster.
void PiecePlan::takeWholePieces(const InputSurvey& survey)
{
  for (PartitionIndex piece = 0; piece < this->pieces(); ++piece)
  {
    this->Inner[std::size_t(piece)] = Tiling::grid(this->Pieces.box(piece), 1, 1);
  }
  this->numberPartitions();
  this->Artificial = makeArtificialPoints(this->Partitions);
  this->chooseInitialPoints(survey, InitialPointsOfPartition);
}

void PiecePlan::takeAlone(const InputSurvey& survey)
{
  this->IsAlone = true;
  this->HasLargeInterface = false;
  this->Pieces = Tiling::grid(survey.Bounds, 1, 1);
  this->Inner = { this->Pieces };
  this->numberPartitions();
  this->Artificial = {};
  this->Initial = {};
}

void PiecePlan::choosePartitions(const InputSurvey& survey, const MemoryPlan& memory)
{
  std::vector<std::vector<Point2>> samples(std::size_t(this->pieces()));
  for (const SampledPoint& p : survey.Sample)
  {
    samples[std::size_t(this->Pieces.locate(p.Position))].push_back(p.Position);
  }
  const double each = double(survey.Points - survey.Rejected) / double(survey.Sample.size());
  for (PartitionIndex piece = 0; piece < this->pieces(); ++piece)
  {
    std::vector<Point2>& sample = samples[std::size_t(piece)];
    const int count = countFor(double(sample.size()) * each, memory.PartitionPoints, sample.size());
    this->Inner.push_back(Tiling::balanced(this->Pieces.box(piece), std::move(sample), count));
  }
  this->numberPartitions();
}

void PiecePlan::numberPartitions()
{
  this->FirstPartition = { 0 };
  this->PieceOf = {};
  for (PartitionIndex piece = 0; piece < this->pieces(); ++piece)
  {
    const PartitionIndex count = this->Inner[std::size_t(piece)].size();
    this->FirstPartition.push_back(this->FirstPartition.back() + count);
    this->PieceOf.insert(this->PieceOf.end(), std::size_t(count), piece);
  }
  this->Partitions = this->Pieces.refined(this->Inner);
}

void PiecePlan::chooseInitialPoints(const InputSurvey& survey, int pointsPerPartition)
{
  this->Initial.clear();
  for (const std::vector<InitialPoint>& points :
    groupByPartition<2>(survey.Sample, this->Partitions))
  {
    const std::vector<Point2> positions = positionsOf(points);
    for (const std::size_t i : tipp::chooseInitialPoints(
           positions.data(), positions.size(), std::size_t(pointsPerPartition)))
    {
      this->Initial.push_back(points[i]);
    }
  }
  sortById(this->Initial);
}

std::vector<BoundaryVertex> PiecePlan::initialVertices() const
{
  std::vector<BoundaryVertex> vertices;
  for (const InitialPoint& p : this->Initial)
  {
    vertices.push_back({ p.Position, p.InPieces, p.Partition });
  }
  vertices.insert(vertices.end(), this->Artificial.begin(), this->Artificial.end());
  return vertices;
}

void PiecePlan::save(SaveArchive& archive) const
{
  archive(this->IsAlone, this->Pieces, this->Inner, this->Initial);
}

PiecePlan::PiecePlan(LoadArchive& archive)
{
  archive(this->IsAlone, this->Pieces, this->Inner, this->Initial);
  if (this->Inner.size() != std::size_t(this->Pieces.size()))
  {
    throw std::runtime_error(
      "The plan of a run is damaged: it does not have one tiling per piece.");
  }
  this->numberPartitions();
  if (!this->IsAlone)
  {
    this->Artificial = makeArtificialPoints(this->Partitions);
  }
}

PieceOrder::PieceOrder(const PiecePlan& plan, const SpilledPoints& points, int threads)
  : Boxes(regionsOf(plan, points))
  , InitialMesh(triangulateVertices<2>(this->Boxes, plan.initialVertices(), threads))
  , Partitions(this->Boxes.areUsed(), this->InitialMesh)
{
  for (PartitionIndex piece = plan.pieces() - 1; piece >= 0; --piece)
  {
    if (points.count(piece) > 0)
    {
      this->Sequence.push_back(piece);
    }
  }
  this->orderPieces(plan);
}

void PieceOrder::orderPieces(const PiecePlan& plan)
{
  ConflictGraph conflicts(std::size_t(plan.pieces()));
  conflicts.add(conflictsOfPieces(this->Partitions, plan.PieceOf));
  const std::vector<std::uint32_t> colours = conflicts.colours();
  std::stable_sort(this->Sequence.begin(), this->Sequence.end(),
    [&](PartitionIndex a, PartitionIndex b)
    { return colours[std::size_t(a)] < colours[std::size_t(b)]; });
  std::vector<std::int32_t> positions(std::size_t(plan.pieces()), 0);
  for (std::size_t i = 0; i < this->Sequence.size(); ++i)
  {
    positions[std::size_t(this->Sequence[i])] = std::int32_t(i);
  }
  std::vector<std::int32_t> windows;
  for (const std::int32_t piece : plan.PieceOf)
  {
    windows.push_back(positions[std::size_t(piece)]);
  }
  this->Partitions.setWindows(windows);
}

} // namespace tipp
