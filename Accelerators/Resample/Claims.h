// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippClaims_h
#define tippClaims_h

#include "Arrays/Random.h"
#include "Parallel/ParallelFor.h"
#include "Predicates/Geometry.h"
#include "Resample/Lattice.h"
#include "Resample/SimplexMesh.h"
#include "vtkTIPPAcceleratorsModule.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <memory>
#include <utility>
#include <vector>

namespace tipp
{

/// The key that decides which cell claims a sample: the lowest among the cells that contain it. Its
/// highest four bits are the cell's moveRank() at the sample; the others are a hash of the corners'
/// coordinates, so that the choice among overlapping cells does not depend on the order of cells,
/// ids or pieces. Equal keys mean copies of one cell.
using CellKey = std::uint64_t;

constexpr CellKey noCellKey = ~CellKey(0);

/// The key of a cell with rank 0; its corners may come in any order.
template <int Corners>
CellKey cellKey(const Point3 (&corners)[Corners])
{
  Point3 sorted[Corners];
  std::copy(corners, corners + Corners, sorted);
  for (int i = 0; i < Corners; ++i)
  {
    for (int j = i + 1; j < Corners; ++j)
    {
      if (lexicographicLess(sorted[j], sorted[i]))
      {
        std::swap(sorted[i], sorted[j]);
      }
    }
  }
  std::uint64_t hash = 0;
  for (const Point3& corner : sorted)
  {
    for (const double coordinate : { corner.x, corner.y, corner.z })
    {
      const double value = coordinate + 0.0; // -0 becomes 0
      std::uint64_t bits;
      std::memcpy(&bits, &value, sizeof bits);
      hash = mixBits(hash + bits);
    }
  }
  return hash >> 4;
}

/// The key of a cell of a SimplexAccess.
template <typename Access>
CellKey keyOf(const Access& cells, std::int64_t cell)
{
  Point3 corners[Access::Corners];
  for (int i = 0; i < Access::Corners; ++i)
  {
    corners[i] = cells.point(cells.ids(cell)[i]);
  }
  return cellKey(corners);
}

inline CellKey withRank(CellKey key, int rank)
{
  return (key << 4 >> 4) | (CellKey(rank) << 60);
}

/// moveRank() of a cell that contains a sample is the lowest rank of a symbolic move that takes the
/// sample into the cell's interior. Rank 0 is the move by (e, e^2, e^3) with infinitesimal e. Rank
/// m is that move mirrored along x if bit 0 of m is set, along y if bit 1, and along z if bit 2.
/// `closedOnly` means that no move does. Among the cells at a sample, the one of lowest rank claims
/// it.
constexpr int closedOnly = 8;

/// The rank of a triangle at a sample that is outside of it, but within Lattice::Slack.
constexpr int nearOnly = 9;

/// Exact. The corners are in any order; the triangle has an area. nearOnly if the sample is
/// outside.
int moveRank(const Point2 (&corners)[3], Point2 sample);
/// Exact. The corners are in any order; the tetrahedron has a volume and contains the sample.
int moveRank(const Point3 (&corners)[4], Point3 sample);

/// A sample that lies on the border of cells without being inside any, with the key of the cell
/// that claims it.
struct BorderSample
{
  std::int64_t Sample; ///< index of the sample
  CellKey Key;
};

/// A sample outside of all triangles, but within Lattice::Slack of one, which claims it.
struct NearSample
{
  std::int64_t Sample; ///< index of the sample
  std::int32_t Cell;   ///< index of the triangle
  CellKey Key;         ///< of the triangle, with the rank nearOnly
  double Distance;     ///< from the triangle's nearest edge
  Point2 Ends[2];      ///< of this edge
  std::int64_t Ids[2]; ///< the indices of its ends
  double Weight;       ///< of its second end at the point that is nearest to the sample
};

/// A box of a lattice's samples, and its position in the lattice. It makes the cost of a part of a
/// mesh depend on the part's own box instead of the whole image.
///
/// Triangles are sampled in the plane of the two axes `mesh.Axes` of the lattice.
class VTKTIPPACCELERATORS_EXPORT SampleWindow
{
public:
  /// The window of all samples.
  SampleWindow(const SimplexMesh& mesh, const Lattice& lattice);
  /// The window of the samples in the mesh's bounding box, decided exactly.
  static SampleWindow around(const SimplexMesh& mesh, const Lattice& lattice, int threads);

  /// The lattice of the window. Its coordinates are bitwise equal to the whole lattice's.
  const Lattice& lattice() const { return this->Part; }
  std::int64_t samples() const { return this->Width * this->Height * this->Layers; }

  /// The index, among all samples, of the first sample of row `row` of the window.
  std::int64_t indexOf(std::int64_t row) const
  {
    return this->First +
      ((row / this->Height) * this->AllHeight + row % this->Height) * this->AllWidth;
  }

  /// Calls work(first, last, shift) for runs [first, last) of the window's samples [begin, end),
  /// such that sample i of the window is sample i + shift of the whole lattice.
  template <typename Work>
  void forRuns(std::int64_t begin, std::int64_t end, const Work& work) const
  {
    if (this->Whole)
    {
      work(begin, end, std::int64_t(0));
      return;
    }
    while (begin < end)
    {
      const std::int64_t row = begin / this->Width;
      const std::int64_t last = std::min(end, (row + 1) * this->Width);
      work(begin, last, this->indexOf(row) - row * this->Width);
      begin = last;
    }
  }

private:
  void measure(const SimplexMesh& mesh);

  Lattice Part;
  std::int64_t Width = 0;
  std::int64_t Height = 0;
  std::int64_t Layers = 0;
  std::int64_t AllWidth;
  std::int64_t AllHeight;
  std::int64_t First = 0; ///< index, among all samples, of the window's first sample
  bool Whole = true;
};

/// A sample on the mesh's border that its cell does not contain after the move by (e, e^2, e^3).
struct BorderClaim
{
  std::int64_t Sample; ///< index of the sample
  std::int32_t Cell;   ///< index of the cell
};

/// A sample on the border of a cell that does not claim it.
struct Touch
{
  std::int64_t Sample; ///< index of the sample
  std::int32_t Cell;   ///< index of the cell

  bool operator<(const Touch& other) const
  {
    return this->Sample != other.Sample ? this->Sample < other.Sample : this->Cell < other.Cell;
  }
};

/// Statistics of the cells that the CPU's threads have visited; if an OpenCL device claims samples,
/// these are only the cells that it leaves undecided.
struct ClaimStatistics
{
  std::int64_t VisitedCells = 0;      ///< cells whose boxes contain samples
  std::int64_t Tests = 0;             ///< samples in these boxes
  std::int64_t ExactTests = 0;        ///< exact predicate evaluations
  std::int64_t OverlappingClaims = 0; ///< samples that a cell lost to an overlapping one
};

/// The cell that claims each sample of a lattice.
struct Claims
{
  /// cell index per sample, the first axis fastest; -1: none
  std::unique_ptr<std::int32_t[]> Cells;
  std::vector<BorderClaim> Border; ///< sorted by sample; with the samples of Near
  std::vector<NearSample> Near;    ///< sorted by sample
  ClaimStatistics Statistics;
  bool Aborted = false; ///< whether the report stopped the work; the claims are incomplete
};

/// Returns the cell of lowest CellKey at each sample: the one that contains it after a move by (e,
/// e^2, e^3) for all sufficiently small e, or on the border after the mirrored moves, or as a
/// closed set, or within Lattice::Slack. Exact for finite coordinates; a cell without area or
/// volume or with a coordinate that is not finite claims nothing. Of cells with the same corners
/// the first claims.
///
/// Triangles are sampled in the plane of the two axes `mesh.Axes`; the third one is ignored. The
/// number of cells must be below 2^31. The result does not depend on the number of threads.
VTKTIPPACCELERATORS_EXPORT Claims claimSamples(
  const SimplexMesh& mesh, const Lattice& lattice, int threads, const Report& report = {});

/// What a device has done of the work of claimSamples() or sampleDirectly().
struct SampledCells
{
  /// Number of samples that cells claim, without those of open cells. A sample counts for each of
  /// the cells that claim it.
  std::int64_t Claimed = 0;
  std::vector<std::int32_t> Open; ///< cells that are not processed, or only in part
  bool Aborted = false;
};

/// Completes the work of a device by processing the open cells. `cells` is as Claims::Cells; it may
/// have some claims of open cells, too.
Claims finishClaims(const SimplexMesh& mesh, const Lattice& lattice, int threads,
  std::unique_ptr<std::int32_t[]> cells, const SampledCells& sampled, const Report& report);

/// Decides which of the touching cells claims each sample; no other cell claims it. Returns the
/// claims by ascending sample.
VTKTIPPACCELERATORS_EXPORT std::vector<BorderClaim> borderClaims(
  const SimplexMesh& mesh, const LatticeAxes& axes, std::vector<Touch> touches, int threads);

/// Sets a sample's key to that of its claim where the claim's key is lower, and removes the other
/// claims. So several parts of a mesh can be merged in any order. `claims` is indexed by
/// the window's samples, `keys` by those of the whole lattice.
VTKTIPPACCELERATORS_EXPORT void mergeClaims(
  const SimplexMesh& mesh, Claims& claims, const SampleWindow& window, int threads, CellKey* keys);

} // namespace tipp

#endif
