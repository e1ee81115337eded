// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippLocalRing_h
#define tippLocalRing_h

#include "Query/PartTopology.h"
#include "Query/ResidentMesh.h"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace tipp
{

/// A set of indices, for many small sets in turn: a hash table with linear probing, which stays in
/// the cache and need not be erased.
class IndexSet
{
public:
  void clear()
  {
    ++this->Current;
    this->Count = 0;
  }

  /// Returns whether the index is new.
  bool insert(std::int64_t index)
  {
    2 * this->Count >= this->Entries.size() ? this->enlarge() : void();
    return this->insertInto(index);
  }

private:
  struct Entry
  {
    std::int64_t Index;
    std::int64_t Set; ///< the entry is free if this is not Current
  };

  bool insertInto(std::int64_t index)
  {
    const std::size_t mask = this->Entries.size() - 1;
    constexpr std::uint64_t multiplier = 0x9E3779B97F4A7C15; // 2^64 over the golden ratio
    std::size_t at = std::size_t((std::uint64_t(index) * multiplier) >> 32) & mask;
    for (; this->Entries[at].Set == this->Current; at = (at + 1) & mask)
    {
      if (this->Entries[at].Index == index)
      {
        return false;
      }
    }
    this->Entries[at] = { index, this->Current };
    ++this->Count;
    return true;
  }

  void enlarge()
  {
    const std::vector<Entry> old =
      std::exchange(this->Entries, std::vector<Entry>(2 * this->Entries.size(), { 0, 0 }));
    this->Count = 0;
    for (const Entry& entry : old)
    {
      entry.Set == this->Current ? void(this->insertInto(entry.Index)) : void();
    }
  }

  std::int64_t Current = 1;
  std::size_t Count = 0;
  std::vector<Entry> Entries = std::vector<Entry>(64, { 0, 0 }); ///< a power of two
};

/// Computes the ring of one seed within one piece.
class LocalRing
{
public:
  /// `shared` is that of ringsWithin(). If null, the points are used that the piece does not own.
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
        if (!this->KnownCells.insert(cell))
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
    this->KnownPoints.insert(point) ? this->Points.push_back(point) : void();
  }

  const std::uint8_t* const Shared;
  const PartTopology& Topology;
  IndexSet KnownPoints;
  IndexSet KnownCells;
};

} // namespace tipp

#endif
