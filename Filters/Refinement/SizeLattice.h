// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSizeLattice_h
#define tippSizeLattice_h

#include "Parallel/ParallelFor.h"
#include "Parallel/Poll.h"
#include "Predicates/Geometry.h"
#include "Resample/Lattice.h"
#include "vtkTIPPFiltersModule.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// Whether the coordinates of the plane are lengths, or degrees of longitude and latitude.
enum class PlaneKind
{
  Projected, ///< lengths have the unit of the coordinates
  Geographic ///< x and y are degrees; lengths are metres
};

/// The nodes at which a size function is stored: a regular lattice that covers a box, and the
/// lengths of its steps. Nodes are numbered row by row from the south, in each row from the west.
///
/// In the geographic plane, lengths are those on a sphere of the Earth's mean radius: a degree of
/// latitude has 111,195 m, one of longitude that times the cosine of the latitude. The cosine
/// counts as at least 0.01 (89.4 degrees), so that lengths stay above 0 at the poles. Longitudes do
/// not wrap around.
class VTKTIPPFILTERS_EXPORT SizeLattice
{
public:
  static constexpr double MetresPerDegree = 111195;

  /// Covers `box` with nodes that are `spacing` apart (as lengths), or a little less; farther if
  /// there were more than `mostNodes`, which must be from 16 to 2^31 - 1. Each axis has at least
  /// two nodes. In the geographic plane, the east-west steps have that length at the middle
  /// latitude. Throws std::invalid_argument if the box is empty or too large, or has latitudes
  /// beyond 90 degrees.
  SizeLattice(const Box2& box, double spacing, std::int64_t mostNodes, PlaneKind kind);

  int columns() const { return int(this->Nodes.size(0)); }
  int rows() const { return int(this->Nodes.size(1)); }
  std::size_t nodes() const { return std::size_t(this->columns()) * std::size_t(this->rows()); }
  std::size_t index(int column, int row) const
  {
    return std::size_t(row) * std::size_t(this->columns()) + std::size_t(column);
  }
  Point2 at(int column, int row) const { return { this->X[column], this->Y[row] }; }
  /// The nodes as samples for resample().
  const Lattice& samples() const { return this->Nodes; }

  /// @name Lengths
  ///@{
  /// The length of a unit of x at a row, of a unit of x at the middle of the box, and of a unit of
  /// y; 1 in a projected plane.
  double unitX(int row) const { return this->UnitX[std::size_t(row)]; }
  double middleUnitX() const { return this->MiddleUnitX; }
  double unitY() const { return this->UnitY; }
  /// The length of a step along a row, and of one between rows.
  double stepX(int row) const { return this->Nodes.Delta[0] * this->unitX(row); }
  double stepY() const { return this->Nodes.Delta[1] * this->UnitY; }
  ///@}

private:
  double UnitY;
  double MiddleUnitX;
  Lattice Nodes;
  LatticeAxis X;
  LatticeAxis Y;
  std::vector<double> UnitX; ///< by row
};

/// Calls body(row) for each row of the lattice, on `threads` threads. Throws WorkAborted if
/// `report` stops it.
template <typename Body>
void forRows(const SizeLattice& lattice, int threads, const Report& report, const Body& body)
{
  constexpr std::int64_t nodesPerChunk = 4096;
  const std::int64_t chunk = std::max<std::int64_t>(nodesPerChunk / lattice.columns(), 1);
  const bool isComplete = forChunks(lattice.rows(), chunk, threadCount(threads), report,
    [&body](std::int64_t begin, std::int64_t end, int)
    {
      for (std::int64_t row = begin; row < end; ++row)
      {
        body(int(row));
      }
    });
  if (!isComplete)
  {
    throw WorkAborted();
  }
}

} // namespace tipp

#endif
