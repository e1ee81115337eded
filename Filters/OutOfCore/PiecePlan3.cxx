// SPDX-License-Identifier: BSD-3-Clause
#include "OutOfCore/PiecePlan3.h"

#include "Files/IOError.h"
#include "Ranks/Archive.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace tipp
{
namespace
{

void requireTetrahedra(int dimension)
{
  constexpr const char* reasons[] = { "There is no point with finite coordinates in the input",
    "All finite points coincide", "All finite points are on one line",
    "All finite points are in one plane" };
  if (dimension < 3)
  {
    throw IOError(std::string(reasons[dimension + 1]) + ": there are no tetrahedra to write" +
      (dimension == 2 ? "; an output named .vtu or .npy gets their triangles." : "."));
  }
}

/// Returns whether partitioning pays, judged by a sample.
bool samplePays(const Tiling3& pieces, const std::vector<Point3>& sample)
{
  const PointBuckets3 buckets = bucketPoints(PointsView3(sample), pieces, 1);
  const std::vector<Vertex3> artificial = makeArtificialPoints(buckets);
  return !artificial.empty() && partitionsPay(makeInitialMesh(pieces, buckets, artificial));
}

} // namespace

std::uint64_t MemoryPlan3::bytesOf(std::int64_t points, std::int64_t others, std::size_t words)
{
  // Coordinates twice; seven tetrahedra per point, in the kernel and in the piece; ids and tables
  // of vertices.
  constexpr std::uint64_t vertex = 2 * 24 + 7 * (33 + 16) + 32;
  return std::uint64_t(points) * 8 * words + std::uint64_t(points + others) * vertex;
}

MemoryPlan3::MemoryPlan3(std::uint64_t limit, std::int64_t piecePoints, std::size_t words)
  : InputMemory(limit, words + 1) // 24 bytes for a copy of the coordinates
{
  this->PieceBytes = limit / 5 * 4;
  // Four pieces fit into memory together. The number does not depend on the threads, so that the
  // pieces do not, either. Larger pieces than the maximum would gain little.
  constexpr std::uint64_t together = 4;
  constexpr std::int64_t unit = 1024;
  const std::uint64_t most = this->PieceBytes / together / bytesOf(unit, unit / 3, words) * unit;
  this->PiecePoints = piecePoints > 0
    ? piecePoints
    : std::clamp<std::int64_t>(std::int64_t(most), 4096, std::int64_t(1) << 18);
}

void ExtremePoints::add(std::int64_t index, const Point3& p)
{
  for (std::size_t k = 0; k < 3; ++k)
  {
    if (p[k] < this->Region.Min[k])
    {
      this->Indices[2 * k] = index;
      this->Positions[2 * k] = p;
    }
    if (p[k] > this->Region.Max[k])
    {
      this->Indices[2 * k + 1] = index;
      this->Positions[2 * k + 1] = p;
    }
  }
  this->Region.extend(p);
}

void ExtremePoints::add(const ExtremePoints& part, std::int64_t before)
{
  for (std::size_t side = 0; side < 6; ++side)
  {
    const std::size_t k = side / 2;
    const bool isBeyond = side % 2 == 0 ? part.Region.Min[k] < this->Region.Min[k]
                                        : part.Region.Max[k] > this->Region.Max[k];
    if (isBeyond)
    {
      this->Indices[side] = before + part.Indices[side];
      this->Positions[side] = part.Positions[side];
    }
  }
  this->Region.extend(part.Region);
}

PiecePlan3::PiecePlan3(const InputSurvey3& survey, const MemoryPlan3& memory, std::size_t words)
{
  requireTetrahedra(survey.dimension());
  const std::vector<Point3> sample = positionsOf(survey.Sample);
  const std::int64_t count = survey.finite();
  // One kernel has indices for this many points.
  constexpr std::int64_t mostAlone = std::int64_t(1) << 26;
  const bool fits = count < mostAlone && MemoryPlan3::bytesOf(count, 0, words) <= memory.PieceBytes;
  const double wanted = double(count) / double(memory.PiecePoints);
  const double possible = double(sample.size()) / 8;
  constexpr double most = 1 << 14;
  this->Pieces =
    Tiling3(sample, int(std::ceil(std::max(1.0, std::min({ wanted, possible, most })))));
  if (fits && this->pieces() > 1 && !samplePays(this->Pieces, sample))
  {
    this->Pieces = Tiling3({}, 1);
  }
  this->Boxes = this->Pieces.boxes(survey.Bounds);
  this->chooseInitialPoints(survey);
}

/// Takes a few sampled points of each piece.
void PiecePlan3::chooseInitialPoints(const InputSurvey3& survey)
{
  constexpr std::size_t most = 48; // of a piece
  for (const std::vector<InitialPointOf<3>>& all : groupByPartition<3>(survey.Sample, this->Pieces))
  {
    const std::size_t wanted = std::min(all.size(), most);
    for (std::size_t i = 0; i < wanted; ++i)
    {
      this->Initial.push_back(all[(2 * i + 1) * all.size() / (2 * wanted)]);
    }
  }
  sortById(this->Initial);
}

void PiecePlan3::encloseExtremes(const std::vector<std::int64_t>& starts)
{
  for (std::size_t piece = 0; piece < this->Extremes.size(); ++piece)
  {
    for (std::int64_t& index : this->Extremes[piece].Indices)
    {
      index += starts[piece];
    }
  }
  this->enclose();
}

void PiecePlan3::enclose()
{
  this->Regions.clear();
  for (const ExtremePoints& extreme : this->Extremes)
  {
    this->Regions.push_back(extreme.Region);
  }
  std::vector<std::int64_t> indices;
  this->Artificial = this->pieces() > 1 ? makeArtificialPoints(this->initialBuckets(indices))
                                        : std::vector<Vertex3>();
  if (this->pieces() > 1 && this->Artificial.empty())
  {
    throw IOError(
      "The coordinates reach too far to be enclosed by 64-bit numbers; scale them down.");
  }
}

void PiecePlan3::save(SaveArchive& archive) const
{
  archive(this->Pieces, this->Boxes, this->Initial, this->Extremes);
}

PiecePlan3::PiecePlan3(LoadArchive& archive)
{
  archive(this->Pieces, this->Boxes, this->Initial, this->Extremes);
  const auto pieces = std::size_t(this->pieces());
  const bool isSpilled = !this->Extremes.empty();
  if (pieces == 0 || this->Boxes.size() != pieces ||
    (isSpilled && this->Extremes.size() != pieces) ||
    !std::all_of(this->Initial.begin(), this->Initial.end(),
      [this](const InitialPointOf<3>& p)
      { return p.Partition >= 0 && p.Partition < this->pieces(); }))
  {
    throw std::runtime_error("The plan of a run is damaged: it belongs to other pieces.");
  }
  if (isSpilled)
  {
    this->enclose();
  }
}

/// Returns the initial points only, with consecutive ids. Sets `indices` to their indices among all
/// spilled points.
PointBuckets3 PiecePlan3::initialBuckets(std::vector<std::int64_t>& indices) const
{
  std::vector<std::vector<const InitialPointOf<3>*>> sampled(std::size_t(this->pieces()));
  for (const InitialPointOf<3>& p : this->Initial)
  {
    sampled[std::size_t(p.Partition)].push_back(&p);
  }
  PointBuckets3 buckets;
  buckets.Regions = this->Regions;
  const auto add = [&](std::int64_t index, const Point3& p)
  {
    buckets.Ids.push_back(std::int32_t(indices.size()));
    buckets.Points.push_back(p);
    indices.push_back(index);
  };
  for (std::size_t piece = 0; piece < sampled.size(); ++piece)
  {
    buckets.Begins.push_back(indices.size());
    for (const InitialPointOf<3>* const p : sampled[piece])
    {
      add(p->InPieces, p->Position);
    }
    const ExtremePoints& extreme = this->Extremes[piece];
    for (std::size_t side = 0; !extreme.Region.isEmpty() && side < 6; ++side)
    {
      add(extreme.Indices[side], extreme.Positions[side]);
    }
  }
  buckets.Begins.push_back(indices.size());
  return buckets;
}

BoundaryCells<3> PiecePlan3::initialMesh() const
{
  std::vector<std::int64_t> indices;
  const PointBuckets3 initial = this->initialBuckets(indices);
  BoundaryCells<3> mesh = makeInitialMesh(this->Pieces, initial, this->Artificial);
  for (Vertex3& v : mesh.Vertices)
  {
    v.Id = v.isArtificial() ? v.Id : indices[std::size_t(v.Id)];
  }
  return mesh;
}

} // namespace tipp
