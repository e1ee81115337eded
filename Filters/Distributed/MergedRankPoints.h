// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippMergedRankPoints_h
#define tippMergedRankPoints_h

#include "Arrays/Concatenated.h"
#include "Distributed/CellExchange.h"
#include "Distributed/PointExchange.h"
#include "Ranks/Communicator.h"
#include "Triangulation/MergeClose.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <vector>

namespace tipp
{

/// A rank's points without those that are merged into others within a distance, on any rank.
///
/// By ascending global id, each point within the distance of a point kept before it is merged into
/// the first such point, as triangulateMerged() does in memory. Only points with another one nearby
/// matter: the first rank collects and merges these. They are found by a hash grid, whose cells are
/// shared out among the ranks.
template <int D>
class MergedRankPoints
{
public:
  /// `distance` is positive, in the points' unit of length, and the same on all ranks. `input` must
  /// outlive this object. Collective.
  MergedRankPoints(Communicator& ranks, const RankPointsOf<D>& input, double distance)
    : Left(input)
  {
    const std::vector<std::int64_t> firsts = firstIndices(ranks, std::int64_t(input.Points.size()));
    this->Left.FirstId = firsts[std::size_t(ranks.rank())];
    const std::vector<Merged> merged = this->merge(ranks, distance);
    auto next = merged.begin();
    for (std::size_t i = 0; i < input.Points.size(); ++i)
    {
      const PointId id = this->Left.globalId(i);
      if (next != merged.end() && next->Index == std::int64_t(i))
      {
        this->Duplicates.push_back({ id, next->Representative });
        ++next;
        continue;
      }
      this->Kept.push_back(i);
      this->Ids.push_back(id);
      this->Positions.push_back(input.Points[i]);
    }
    std::sort(this->Duplicates.begin(), this->Duplicates.end());
    this->Left.Points = PointsViewOf<D>(this->Positions);
    this->Left.GlobalIds = this->Ids.data();
    this->Left.PackRow = [this, &input](std::size_t i, char* to)
    { input.PackRow(this->Kept[i], to); };
  }
  MergedRankPoints(const MergedRankPoints&) = delete;
  void operator=(const MergedRankPoints&) = delete;

  /// The points that are left. Valid while this object exists.
  const RankPointsOf<D>& points() const { return this->Left; }

  /// Adds the merged points to the result for the points that are left. Collective.
  template <typename Mesh>
  void addTo(Communicator& ranks, Mesh& mine) const
  {
    mine.Duplicates.insert(mine.Duplicates.end(), this->Duplicates.begin(), this->Duplicates.end());
    std::sort(mine.Duplicates.begin(), mine.Duplicates.end());
    const auto counts = ranks.allGather(std::int64_t(this->Duplicates.size()));
    for (std::size_t rank = 0; rank < counts.size(); ++rank)
    {
      mine.AllPoints += counts[rank];
      mine.AllDuplicates += counts[rank];
      mine.Statistics.Ranks.at(rank).InputPoints += counts[rank];
    }
  }

private:
  /// A point that may be near another one.
  struct Candidate
  {
    Point<D> Position;
    PointId Id;
    std::int64_t Index; ///< among its rank's points
    std::int64_t Rank;

    auto key() const { return std::tie(this->Id, this->Rank, this->Index); }
  };

  struct Merged
  {
    std::int64_t Index; ///< among its rank's points
    PointId Representative;
  };

  /// Returns this rank's merged points, by ascending index.
  std::vector<Merged> merge(Communicator& ranks, double distance) const
  {
    std::vector<Candidate> all =
      concatenated(ranks.gather(this->findCandidates(ranks, distance))); // on the first rank
    std::sort(all.begin(), all.end(),
      [](const Candidate& a, const Candidate& b) { return a.key() < b.key(); });
    const MergedPoints points =
      mergeClose<D>(all.size(), [&all](std::size_t i) { return all[i].Position; }, distance, {});
    std::vector<std::vector<Merged>> byRank(std::size_t(ranks.size()));
    for (const Duplicate& duplicate : points.Duplicates)
    {
      const Candidate& point = all[std::size_t(duplicate.Point)];
      byRank[std::size_t(point.Rank)].push_back(
        { point.Index, all[std::size_t(duplicate.Representative)].Id });
    }
    std::vector<Merged> own = ranks.allToAll(byRank).front();
    std::sort(
      own.begin(), own.end(), [](const Merged& a, const Merged& b) { return a.Index < b.Index; });
    return own;
  }

  /// Returns this rank's points that are in or near a grid cell which another point is in or near.
  /// Two points within the distance are both in or near the cells that contain them.
  std::vector<Candidate> findCandidates(Communicator& ranks, double distance) const
  {
    const PointsViewOf<D>& points = this->Left.Points;
    std::vector<double> largest{ -largestCoordinate<D>(
      points.size(), [&points](std::size_t i) { return points[i]; }) };
    ranks.minimum(largest);
    const MergeGrid<D> grid(distance, -largest.front());
    const auto size = std::uint64_t(ranks.size());
    std::vector<std::vector<std::uint64_t>> cells(size); // by the rank that counts their points
    const auto visitCells = [&](const auto& visit)
    {
      points.forEach(0, points.size(),
        [&](std::size_t i, const Point<D>& p)
        {
          if (isFinite(p))
          {
            grid.visitNear(p, [&](std::uint64_t cell) { visit(i, p, cell); });
          }
        });
    };
    visitCells([&](std::size_t, const Point<D>&, std::uint64_t cell)
      { cells[cell % size].push_back(cell); });
    const std::vector<std::vector<char>> areShared = findShared(ranks, cells);
    std::vector<std::size_t> next(size, 0);
    std::vector<Candidate> candidates;
    visitCells(
      [&](std::size_t i, const Point<D>& p, std::uint64_t cell)
      {
        const bool isShared = areShared[cell % size].at(next[cell % size]++) != 0;
        if (isShared && (candidates.empty() || candidates.back().Index != std::int64_t(i)))
        {
          candidates.push_back({ p, this->Left.globalId(i), std::int64_t(i), ranks.rank() });
        }
      });
    return candidates;
  }

  /// Returns for each of the cells of this rank's points whether several points name it.
  static std::vector<std::vector<char>> findShared(
    Communicator& ranks, const std::vector<std::vector<std::uint64_t>>& cells)
  {
    const std::vector<std::vector<std::uint64_t>> named = ranks.allToAll(cells);
    std::vector<std::uint64_t> sorted = concatenated(named);
    std::sort(sorted.begin(), sorted.end());
    std::vector<std::uint64_t> shared;
    for (std::size_t i = 1; i < sorted.size(); ++i)
    {
      if (sorted[i] == sorted[i - 1])
      {
        shared.push_back(sorted[i]);
      }
    }
    std::vector<std::vector<char>> answers;
    for (const std::vector<std::uint64_t>& part : named)
    {
      answers.emplace_back(part.size());
      std::transform(part.begin(), part.end(), answers.back().begin(),
        [&](std::uint64_t cell)
        { return char(std::binary_search(shared.begin(), shared.end(), cell)); });
    }
    return ranks.allToAll(answers);
  }

  RankPointsOf<D> Left;
  std::vector<std::size_t> Kept; ///< indices in the input
  std::vector<PointId> Ids;      ///< global ids of the points that are left
  std::vector<Point<D>> Positions;
  std::vector<Duplicate> Duplicates; ///< global ids
};

/// Returns the result of triangulate(points) for the points that are left when those within
/// `distance` are merged, with the merged points. `distance`: as above; 0: none are merged.
/// Collective.
template <int D, typename Triangulate>
auto triangulateMerged(Communicator& ranks, const RankPointsOf<D>& points, double distance,
  const Triangulate& triangulate)
{
  if (!(distance > 0))
  {
    return triangulate(points);
  }
  const MergedRankPoints<D> merged(ranks, points, distance);
  auto mine = triangulate(merged.points());
  merged.addTo(ranks, mine);
  return mine;
}

} // namespace tipp

#endif
