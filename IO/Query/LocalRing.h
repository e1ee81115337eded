// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippLocalRing_h
#define tippLocalRing_h

#include "Arrays/IndexMap.h"
#include "Query/PartTopology.h"
#include "Query/ResidentMesh.h"

#include <cstdint>
#include <vector>

namespace tipp
{

/// Computes the ring of one seed within one piece.
class LocalRing
{
public:
  /// `shared` is not 0 at points where other parts of the mesh have cells, too. If it is null,
  /// these are the points that the piece does not own.
  LocalRing(const ResidentPiece& piece, const std::uint8_t* shared)
    : Shared(shared ? shared : piece.Part->Ghosts)
    , Topology(*piece.Topology)
  {
  }

  /// Visits the cells at the points `first`, at the points of these cells, and so on, k times.
  /// Returns false if this reaches a point of another piece. `first` and the results are local
  /// indices.
  bool grow(const std::vector<std::int64_t>& first, int k, bool wantsCells)
  {
    this->Points.clear();
    this->Cells.clear();
    this->KnownPoints.clear();
    this->KnownCells.clear();
    for (const std::int64_t point : first)
    {
      this->addPoint(point);
    }
    std::size_t begin = 0;
    for (int step = 0; step < k && begin < this->Points.size(); ++step)
    {
      const std::size_t end = this->Points.size();
      const bool wantsPoints = !wantsCells || step + 1 < k; // the last points are not visited
      for (; begin < end; ++begin)
      {
        const std::int64_t point = this->Points[begin];
        if (this->Shared && this->Shared[point] != 0)
        {
          return false;
        }
        this->visit(point, wantsCells, wantsPoints);
      }
    }
    return true;
  }

  std::vector<std::int64_t> Points; ///< in the order in which they were reached
  std::vector<std::int64_t> Cells;  ///< likewise; empty if not wanted

private:
  void visit(std::int64_t point, bool wantsCells, bool wantsPoints)
  {
    for (const std::int32_t cell : this->Topology.cellsAt(point))
    {
      if (wantsCells)
      {
        if (!this->KnownCells.insert(cell).IsNew)
        {
          continue;
        }
        this->Cells.push_back(cell);
      }
      for (int i = 0; wantsPoints && i < this->Topology.corners(); ++i)
      {
        this->addPoint(this->Topology.corner(cell, i));
      }
    }
  }

  void addPoint(std::int64_t point)
  {
    this->KnownPoints.insert(point).IsNew ? this->Points.push_back(point) : void();
  }

  const std::uint8_t* const Shared;
  const PartTopology& Topology;
  IndexMap KnownPoints;
  IndexMap KnownCells;
};

} // namespace tipp

#endif
