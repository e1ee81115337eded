// SPDX-License-Identifier: BSD-3-Clause
#include "OutOfCore/PiecePlan.h"

#include "Files/IOError.h"
#include "Triangulation/InitialMesh.h"
#include "Triangulation/Tiling.h"

#include <algorithm>
#include <limits>

namespace tipp
{
namespace
{

std::vector<Point2> placesOf(const std::vector<SampledPoint>& sample)
{
  std::vector<Point2> places;
  places.reserve(sample.size());
  for (const SampledPoint& p : sample)
  {
    places.push_back(p.Position);
  }
  return places;
}

int countFor(double points, std::int64_t each, std::size_t sampled)
{
  const double wanted = std::max(1.0, points / double(each));
  const double possible = std::max(1.0, double(sampled) / 8);
  constexpr double most = 1 << 22;
  return static_cast<int>(std::min({ wanted, possible, most }));
}

} // namespace

std::uint64_t MemoryPlan::pieceBytes(std::int64_t points, std::size_t rowWords)
{
  // Rows; points and then triangles; labels and then numbers; the rim's flags.
  return std::uint64_t(points) * (8 * rowWords + 24 + 4 + 1);
}

MemoryPlan::MemoryPlan(const OutOfCoreOptions& options, std::size_t words)
{
  // A taker copies coordinates and triangles of the piece that it is given.
  const std::size_t rowWords = words + (options.Taker ? 8 : 0);
  // Of the two phases each has its share; the rest is for kernels and boundaries.
  const std::uint64_t share = options.MemoryLimit / 5 * 2;
  // Two blocks of points, their labels and rows by piece.
  const std::size_t perPoint = 2 * 8 * (rowWords - 1) + 4 + 8 * rowWords;
  constexpr std::size_t mostPoints = std::size_t(1) << 22;
  this->BlockPoints = std::clamp<std::size_t>(std::size_t(share) / perPoint, 1 << 14, mostPoints);
  this->SamplePoints = std::clamp<std::size_t>(
    std::size_t(options.MemoryLimit / 512), std::size_t(1) << 14, std::size_t(1) << 20);
  this->LoadedBytes = share / pieceBytes(1, rowWords) * pieceBytes(1, words);
  // One that is written, two that are worked on and one that is loaded; never mind the threads, so
  // that the pieces are the same for any number of them.
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
                        : Tiling::balanced(survey.Bounds, placesOf(survey.Sample),
                            countFor(points, memory.PiecePoints, survey.Sample.size()));
  this->choosePartitions(survey, memory);
  this->Artificial = makeArtificialPoints(this->Partitions);
  constexpr std::uint64_t kernelBytes = 250; // a point
  const std::int64_t count = survey.Points - survey.Rejected;
  const bool fits = options.MemoryLimit / 2 >=
    MemoryPlan::pieceBytes(count, rowWords) + kernelBytes * std::uint64_t(count);
  if (this->Artificial.empty())
  {
    if (!fits)
    {
      throw IOError(
        "The coordinates reach too far to be enclosed by 64-bit numbers; scale them down.");
    }
    this->takeAlone(survey);
    return;
  }
  this->chooseInitialPoints(survey);
  this->HasLargeRim =
    !partitionsPay(triangulateVertices(this->Partitions, this->initialVertices(), threads));
  if (!isGrid && fits && this->HasLargeRim)
  {
    this->takeAlone(survey);
  }
  else if (this->HasLargeRim)
  {
    this->takeWholePieces(survey);
  }
}

/// Where nearly all vertices are sent on and on, the fewer partitions the better.
void PiecePlan::takeWholePieces(const InputSurvey& survey)
{
  for (PartitionIndex piece = 0; piece < this->pieces(); ++piece)
  {
    this->Inner[std::size_t(piece)] = Tiling::grid(this->Pieces.box(piece), 1, 1);
  }
  this->numberPartitions();
  this->Artificial = makeArtificialPoints(this->Partitions);
  this->Initial.clear();
  this->chooseInitialPoints(survey);
}

void PiecePlan::takeAlone(const InputSurvey& survey)
{
  this->IsAlone = true;
  this->HasLargeRim = false;
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

void PiecePlan::chooseInitialPoints(const InputSurvey& survey)
{
  std::vector<std::vector<InitialPoint>> sampled(std::size_t(this->Partitions.size()));
  for (const SampledPoint& p : survey.Sample)
  {
    const PartitionIndex partition = this->Partitions.locate(p.Position);
    sampled[std::size_t(partition)].push_back({ p.Id, p.Position, partition });
  }
  for (const std::vector<InitialPoint>& points : sampled)
  {
    std::vector<Point2> places;
    for (const InitialPoint& p : points)
    {
      places.push_back(p.Position);
    }
    for (const std::size_t i :
      tipp::chooseInitialPoints(places.data(), places.size(), InitialPointsOfPartition))
    {
      this->Initial.push_back(points[i]);
    }
  }
  std::sort(this->Initial.begin(), this->Initial.end(),
    [](const InitialPoint& a, const InitialPoint& b) { return a.Id < b.Id; });
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

} // namespace tipp
