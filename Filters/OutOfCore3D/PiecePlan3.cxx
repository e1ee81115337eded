// SPDX-License-Identifier: BSD-3-Clause
#include "OutOfCore3D/PiecePlan3.h"

#include "Files/IOError.h"
#include "Kernel/DelaunayKernel3.h"
#include "OutOfCore/InputPasses.h"
#include "OutOfCore/SpilledPoints.h"
#include "Parallel/ParallelFor.h"
#include "Predicates/ExactPredicates3.h"
#include "Triangulation/StreamSampler.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tipp
{
namespace
{

/// The number of initial points per piece, besides those on the sides of its region.
constexpr std::size_t initialPointsOfPiece = 48;

/// Data about a piece that is collected while its points are spilled.
struct SpilledPiece3
{
  std::int64_t Count = 0;
  Box3 Region = Box3::empty(); ///< the bounding box of its points
  /// Indices in the piece of points on the region's six sides.
  std::array<std::int64_t, 6> Extreme = {};
  std::array<Point3, 6> ExtremePositions = {};
};

/// The points of a block; coordinates are multiplied by a factor.
class BlockView3
{
public:
  BlockView3(const PointBlock& block, std::size_t elevation, double factor)
    : XY(block.XY.data())
    , Z(block.Columns[elevation].data())
    , Count(block.size())
    , Factor(factor)
  {
  }

  std::size_t size() const { return this->Count; }
  Point3 operator[](std::size_t i) const
  {
    return { this->XY[2 * i] * this->Factor, this->XY[2 * i + 1] * this->Factor,
      this->Z[i] * this->Factor };
  }

private:
  const double* XY;
  const double* Z;
  std::size_t Count;
  double Factor;
};

/// Finds the dimension of the points that are added (see Tetrahedralization::Dimension).
class DimensionTest
{
public:
  int dimension() const { return this->Dimension; }

  void add(const Point3& p)
  {
    const auto& s = this->Simplex;
    const bool isIndependent = this->Dimension == -1 || (this->Dimension == 0 && !(p == s[0])) ||
      (this->Dimension == 1 && !areCollinear(s[0], s[1], p)) ||
      (this->Dimension == 2 && orientation3(s[0], s[1], s[2], p) != 0);
    if (isIndependent)
    {
      this->Simplex[std::size_t(++this->Dimension)] = p;
    }
  }

private:
  std::array<Point3, 4> Simplex = {};
  int Dimension = -1;
};

void requireDimension(int dimension)
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

} // namespace

std::uint64_t MemoryPlan3::bytesOf(std::int64_t points, std::int64_t others, std::size_t words)
{
  // Coordinates twice; seven tetrahedra per point, in the kernel and in the piece; ids and tables
  // of vertices.
  constexpr std::uint64_t vertex = 2 * 24 + 7 * (33 + 16) + 32;
  return std::uint64_t(points) * 8 * words + std::uint64_t(points + others) * vertex;
}

MemoryPlan3::MemoryPlan3(std::uint64_t limit, std::int64_t piecePoints, std::size_t words)
  : InputMemory(limit, words)
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

PiecePlan3::PiecePlan3(PointStream& points, const MemoryPlan3& memory, const Progress& progress)
{
  InputSurvey3& survey = this->Survey;
  survey.Elevation = findElevation(points.columns());
  if (survey.Elevation == points.columns().size())
  {
    throw IOError("The input has no column z, Z or elevation, the third coordinate.");
  }
  // All points are read here, so their number need not be known, which takes a pass of LAZ files.
  StreamSampler<Point3> sampler(memory.SamplePoints, -1);
  survey.Bounds = Box3::empty();
  DimensionTest dimension;
  forEachBlock(points, memory.BlockPoints,
    [&](PointBlock& block)
    {
      const BlockView3 view(block, survey.Elevation, 1);
      sampler.add(block.First, view);
      for (std::size_t i = 0; i < view.size(); ++i)
      {
        const Point3 p = view[i];
        if (!isFinite(p))
        {
          ++survey.Rejected;
          continue;
        }
        survey.Bounds.extend(p);
        if (dimension.dimension() < 3)
        {
          dimension.add(p);
        }
      }
      survey.Points += std::int64_t(view.size());
      progress(survey.Points);
    });
  survey.LeftOut = points.leftOut();
  survey.ThinnedOut = points.thinnedOut();
  survey.Dimension = dimension.dimension();
  requireDimension(survey.Dimension);
  this->Sample = sampler.take();
  this->findFactor(points, memory.BlockPoints, survey.Bounds.largest());
}

/// Sets the factor, if multiplying by it is exact for all points.
void PiecePlan3::findFactor(PointStream& points, std::size_t blockPoints, double largest)
{
  double factor = moderateFactor(largest);
  if (factor == 1)
  {
    return;
  }
  forEachBlock(points, blockPoints,
    [&](PointBlock& block)
    {
      const auto isExact = [factor](double x) { return isExactTimes(x, factor); };
      const std::vector<double>& z = block.Columns[this->Survey.Elevation];
      const bool areExact = std::all_of(block.XY.begin(), block.XY.end(), isExact) &&
        std::all_of(z.begin(), z.end(), isExact);
      factor = areExact ? factor : 1;
    });
  this->Survey.Factor = factor;
  this->Survey.Bounds = scaled(this->Survey.Bounds, factor);
  for (Sampled& p : this->Sample)
  {
    p.Position = { p.Position.x * factor, p.Position.y * factor, p.Position.z * factor };
  }
}

void PiecePlan3::divide(const MemoryPlan3& memory, std::size_t words)
{
  const std::int64_t count = this->Survey.finite();
  // One kernel has indices for this many points.
  constexpr std::int64_t mostAlone = std::int64_t(1) << 26;
  const bool fits = count < mostAlone && MemoryPlan3::bytesOf(count, 0, words) <= memory.PieceBytes;
  const double wanted = double(count) / double(memory.PiecePoints);
  const double possible = double(this->Sample.size()) / 8;
  constexpr double most = 1 << 14;
  this->Tiling = Tiling3(
    positionsOf(this->Sample), int(std::ceil(std::max(1.0, std::min({ wanted, possible, most })))));
  if (this->pieces() > 1 && !this->samplePays() && fits)
  {
    this->Tiling = Tiling3({}, 1);
  }
  this->Boxes = this->Tiling.boxes(this->Survey.Bounds);
  this->chooseInitialPoints();
}

/// Returns whether partitioning pays, judged by the sample.
bool PiecePlan3::samplePays() const
{
  const std::vector<Point3> sample = positionsOf(this->Sample);
  const PointBuckets3 buckets = bucketPoints({ sample.data(), sample.size() }, this->Tiling, 1);
  const std::vector<Vertex3> artificial = makeArtificialPoints(buckets);
  return !artificial.empty() && partitionsPay(InitialMesh3(buckets, artificial));
}

/// Keeps a few sampled points of each piece as its initial points.
void PiecePlan3::chooseInitialPoints()
{
  std::vector<std::vector<Sampled>> sampled(std::size_t(this->pieces()));
  for (const Sampled& p : this->Sample)
  {
    sampled[std::size_t(this->Tiling.locate(p.Position))].push_back(p);
  }
  std::vector<Sampled>().swap(this->Sample);
  for (const std::vector<Sampled>& all : sampled)
  {
    const std::size_t wanted = std::min(all.size(), initialPointsOfPiece);
    for (std::size_t i = 0; i < wanted; ++i)
    {
      this->Sample.push_back(all[(2 * i + 1) * all.size() / (2 * wanted)]);
    }
  }
  std::sort(this->Sample.begin(), this->Sample.end(),
    [](const Sampled& a, const Sampled& b) { return a.Id < b.Id; });
}

/// Finds the pieces of a block's points, and collects the counts, regions and initial points of
/// pieces.
struct PiecePlan3::Labels
{
  explicit Labels(PiecePlan3& plan)
    : Plan(plan)
    , Pieces(std::size_t(plan.pieces()))
  {
    plan.Initial.assign(this->Pieces.size(), {});
  }

  void label(const PointBlock& block, int threads)
  {
    const BlockView3 view(block, this->Plan.Survey.Elevation, this->Plan.Survey.Factor);
    this->PieceOf.resize(view.size());
    forIndices(
      std::int64_t(view.size()),
      [&](std::int64_t i)
      {
        const Point3 p = view[std::size_t(i)];
        this->PieceOf[std::size_t(i)] = isFinite(p) ? this->Plan.Tiling.locate(p) : -1;
      },
      threads);
    const std::vector<Sampled>& sample = this->Plan.Sample;
    for (std::size_t i = 0; i < view.size(); ++i)
    {
      const bool isSampled =
        this->Next < sample.size() && sample[this->Next].Id == block.First + std::int64_t(i);
      this->Next += isSampled ? 1 : 0;
      if (this->PieceOf[i] >= 0)
      {
        this->add(std::size_t(this->PieceOf[i]), view[i], isSampled);
      }
    }
    this->Points += std::int64_t(view.size());
  }

  void add(std::size_t piece, const Point3& p, bool isInitial)
  {
    SpilledPiece3& of = this->Pieces[piece];
    for (std::size_t k = 0; k < 3; ++k)
    {
      if (p[k] < of.Region.Min[k])
      {
        of.Extreme[2 * k] = of.Count;
        of.ExtremePositions[2 * k] = p;
      }
      if (p[k] > of.Region.Max[k])
      {
        of.Extreme[2 * k + 1] = of.Count;
        of.ExtremePositions[2 * k + 1] = p;
      }
    }
    of.Region.extend(p);
    if (isInitial)
    {
      this->Plan.Initial[piece].push_back({ of.Count, p });
    }
    ++of.Count;
  }

  PiecePlan3& Plan;
  std::vector<SpilledPiece3> Pieces;
  std::vector<PartitionIndex> PieceOf; ///< by point of the block: its piece; -1: rejected
  std::size_t Next = 0;                ///< index in the sample of the next sampled point
  std::int64_t Points = 0;
};

void PiecePlan3::spill(PointStream& points, const std::string& file, const MemoryPlan3& memory,
  int threads, const Progress& progress)
{
  const std::size_t words = 3 + points.columns().size();
  Spill spill(file, 0, std::size_t(this->pieces()), 8 * words);
  spill.protect();
  Labels labels(*this);
  forEachBlock(points, memory.BlockPoints,
    [&](PointBlock& block)
    {
      labels.label(block, threads);
      spill.add(
        block.size(), threads, [&](std::size_t i) { return labels.PieceOf[i]; },
        [&](std::size_t i, char* to) { writeRow(block, i, to); });
      progress(labels.Points);
    });
  this->Spilled = std::make_unique<SpilledPoints>(file, words, std::vector{ spill.close() });
  if (labels.Points != this->Survey.Points ||
    this->Spilled->starts().back() != this->Survey.finite() || labels.Next != this->Sample.size())
  {
    throwChanged();
  }
  for (PartitionIndex piece = 0; piece < this->pieces(); ++piece)
  {
    const SpilledPiece3& of = labels.Pieces[std::size_t(piece)];
    std::vector<InitialPoint3>& initial = this->Initial[std::size_t(piece)];
    for (std::size_t i = 0; of.Count > 0 && i < of.Extreme.size(); ++i)
    {
      initial.push_back({ of.Extreme[i], of.ExtremePositions[i] });
    }
    for (InitialPoint3& p : initial)
    {
      p.Index += this->Spilled->first(piece);
    }
    this->Regions.push_back(of.Region);
  }
  std::vector<Sampled>().swap(this->Sample);
  this->enclose();
}

/// Sets the artificial points around all regions. Throws IOError if doubles cannot enclose them.
void PiecePlan3::enclose()
{
  this->Artificial =
    this->pieces() > 1 ? makeArtificialPoints(this->initialBuckets()) : std::vector<Vertex3>();
  if (this->pieces() > 1 && this->Artificial.empty())
  {
    throw IOError(
      "The coordinates reach too far to be enclosed by 64-bit numbers; scale them down.");
  }
}

/// Saves or loads the survey by members, because its bytes include padding.
template <typename Archive, typename Survey>
void exchangeSurvey(Archive& archive, Survey& survey)
{
  archive(survey.Points, survey.Rejected, survey.LeftOut, survey.ThinnedOut, survey.Bounds,
    survey.Factor, survey.Dimension, survey.Elevation);
}

void PiecePlan3::save(SaveArchive& archive) const
{
  exchangeSurvey(archive, this->Survey);
  archive(this->Tiling, this->Boxes, this->Regions, this->Initial);
  this->Spilled->save(archive);
}

PiecePlan3::PiecePlan3(LoadArchive& archive, std::size_t words, const std::string& file)
{
  exchangeSurvey(archive, this->Survey);
  archive(this->Tiling, this->Boxes, this->Regions, this->Initial);
  const auto pieces = std::size_t(this->pieces());
  if (pieces == 0 || this->Boxes.size() != pieces || this->Regions.size() != pieces ||
    this->Initial.size() != pieces)
  {
    throw IOError(file, "has points of other pieces; start again.");
  }
  this->Spilled = std::make_unique<SpilledPoints>(file, words, this->pieces(), archive);
  this->enclose();
}

/// Returns the initial points only, with consecutive ids.
PointBuckets3 PiecePlan3::initialBuckets() const
{
  PointBuckets3 buckets;
  buckets.Regions = this->Regions;
  for (const std::vector<InitialPoint3>& initial : this->Initial)
  {
    buckets.Begins.push_back(buckets.Points.size());
    for (const InitialPoint3& p : initial)
    {
      buckets.Ids.push_back(std::int32_t(buckets.Points.size()));
      buckets.Points.push_back(p.Position);
    }
  }
  buckets.Begins.push_back(buckets.Points.size());
  return buckets;
}

InitialMesh3 PiecePlan3::initialMesh() const
{
  InitialMesh3 mesh(this->initialBuckets(), this->Artificial);
  std::vector<std::int64_t> indices;
  for (const std::vector<InitialPoint3>& initial : this->Initial)
  {
    for (const InitialPoint3& p : initial)
    {
      indices.push_back(p.Index);
    }
  }
  for (Vertex3& v : mesh.Vertices)
  {
    v.Id = v.isArtificial() ? v.Id : indices[std::size_t(v.Id)];
  }
  return mesh;
}

} // namespace tipp
