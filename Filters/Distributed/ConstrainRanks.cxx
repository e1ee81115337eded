// SPDX-License-Identifier: BSD-3-Clause
#include "Distributed/DistributedTriangulation.h"

#include "Arrays/SortUnique.h"
#include "Constraints/CrossedPart.h"
#include "Distributed/TriangleExchange.h"
#include "Parallel/ParallelFor.h"
#include "Ranks/Archive.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace tipp
{
namespace
{

/// One rank's triangles; its member functions are the steps.
template <typename Id>
class RankConstrainer
{
public:
  RankConstrainer(Communicator& ranks, const ConstraintSegments& segments, int threads,
    DistributedTriangulation& mine, Buffer<Id>& corners)
    : Ranks(ranks)
    , Segments(segments)
    , Threads(threadCount(threads))
    , Mine(mine)
    , Corners(corners)
    , First(mine.FirstIds[std::size_t(ranks.rank())])
    , Own(mine.Owned.size())
  {
  }

  void run()
  {
    this->loadPositions();
    CrossedPart crossed = this->takeCrossed();
    const std::vector<char> isShared = this->findShared();
    CrossedPart rest = splitIncomplete(crossed,
      [&](std::int64_t id)
      {
        return id >= this->First && id < this->First + std::int64_t(this->Own) &&
          !isShared[std::size_t(id - this->First)];
      });
    retriangulate(crossed, this->Threads);
    CrossedPart all;
    for (CrossedPart& part : this->Ranks.gather(rest))
    {
      append(std::move(part), all);
    }
    retriangulate(all, this->Threads); // on the first rank
    append(std::move(crossed), all);
    this->setTriangles(this->toOwners(all.Triangles));
    if (this->Segments.cuts())
    {
      this->loadPositions();
      this->Corners.truncate(
        3 * cutTriangles(this->view(), this->Segments, this->Corners.data(), this->triangles()));
    }
    this->countTriangles();
  }

private:
  std::size_t triangles() const { return this->Corners.size() / 3; }
  PointsView view() const { return PointsView(this->Positions); }

  /// The internal id of a corner.
  std::int64_t idOf(std::int64_t corner) const
  {
    return corner < std::int64_t(this->Own) ? this->First + corner
                                            : this->Mine.GhostIds[std::size_t(corner) - this->Own];
  }

  void loadPositions()
  {
    const auto& owned = this->Mine.Owned.Positions;
    const auto& ghosts = this->Mine.Ghosts.Positions;
    this->Positions.assign(owned.begin(), owned.end());
    this->Positions.insert(this->Positions.end(), ghosts.begin(), ghosts.end());
  }

  CrossedPart takeCrossed()
  {
    const auto ranges = std::int64_t(4) * this->Threads;
    const auto all = std::int64_t(this->triangles());
    const auto beginOf = [&](std::int64_t range) { return all * range / ranges; };
    std::vector<CrossedPart> parts(static_cast<std::size_t>(ranges));
    std::vector<std::size_t> kept(parts.size());
    forChunks(ranges, 1, this->Threads, {},
      [&](std::int64_t range, std::int64_t, int)
      {
        const std::int64_t begin = beginOf(range);
        kept[std::size_t(range)] =
          tipp::takeCrossed(this->view(), this->Segments, 0, this->Corners.data() + 3 * begin,
            std::size_t(beginOf(range + 1) - begin), parts[std::size_t(range)]);
      });
    CrossedPart crossed;
    std::size_t end = 0;
    for (std::size_t range = 0; range < parts.size(); ++range)
    {
      const Id* const from = this->Corners.data() + 3 * beginOf(std::int64_t(range));
      std::copy_n(from, 3 * kept[range], this->Corners.data() + 3 * end);
      end += kept[range];
      append(std::move(parts[range]), crossed);
    }
    this->Corners.truncate(3 * end);
    crossed.rename([this](std::int64_t corner) { return this->idOf(corner); });
    return crossed;
  }

  /// For each own point, whether other ranks have triangles at it.
  std::vector<char> findShared()
  {
    std::vector<std::vector<std::int64_t>> used(std::size_t(this->Ranks.size()));
    for (const std::int64_t id : this->Mine.GhostIds)
    {
      used[ownerOf(id, this->Mine.FirstIds)].push_back(id);
    }
    std::vector<char> isShared(this->Own, 0);
    for (const std::vector<std::int64_t>& ids : this->Ranks.allToAll(used))
    {
      for (const std::int64_t id : ids)
      {
        isShared.at(std::size_t(id - this->First)) = 1;
      }
    }
    return isShared;
  }

  /// Sends new triangles to the rank that owns their vertex of lowest id, to which every triangle
  /// belongs. Returns this rank's triangles, sorted.
  std::vector<IdTriangle> toOwners(const std::vector<CrossedPart::Corners>& triangles)
  {
    std::vector<std::vector<IdTriangle>> sent(std::size_t(this->Ranks.size()));
    for (const CrossedPart::Corners& triangle : triangles)
    {
      const std::int64_t low = *std::min_element(triangle.begin(), triangle.end());
      sent[ownerOf(low, this->Mine.FirstIds)].push_back(triangle);
    }
    std::vector<IdTriangle> own;
    for (const std::vector<IdTriangle>& part : this->Ranks.allToAll(sent))
    {
      own.insert(own.end(), part.begin(), part.end());
    }
    std::sort(own.begin(), own.end());
    return own;
  }

  bool isGhost(std::int64_t id) const
  {
    return id < this->First || id >= this->First + std::int64_t(this->Own);
  }

  /// Adds triangles, and fetches the points that they need.
  void setTriangles(const std::vector<IdTriangle>& added)
  {
    std::vector<std::int64_t> ghosts;
    const auto note = [&](std::int64_t id) { this->isGhost(id) ? ghosts.push_back(id) : void(); };
    std::for_each(this->Corners.begin(), this->Corners.end(),
      [&](Id corner) { note(this->idOf(std::int64_t(corner))); });
    for (const IdTriangle& triangle : added)
    {
      std::for_each(triangle.begin(), triangle.end(), note);
    }
    sortUnique(ghosts);
    const auto indexOf = [&](std::int64_t id)
    {
      return Id(this->isGhost(id) ? std::int64_t(this->Own) +
            (std::lower_bound(ghosts.begin(), ghosts.end(), id) - ghosts.begin())
                                  : id - this->First);
    };
    Buffer<Id> corners(this->Corners.size() + 3 * added.size());
    Id* to = std::transform(this->Corners.begin(), this->Corners.end(), corners.begin(),
      [&](Id corner) { return indexOf(this->idOf(std::int64_t(corner))); });
    for (const IdTriangle& triangle : added)
    {
      to = std::transform(triangle.begin(), triangle.end(), to, indexOf);
    }
    this->Corners = std::move(corners);
    this->Mine.Ghosts =
      fetchPoints(this->Ranks, ghosts, this->Mine.FirstIds, this->Mine.Owned, this->Mine.RowSize);
    this->Mine.GhostIds = std::move(ghosts);
  }

  void countTriangles()
  {
    const std::vector<std::int64_t> firsts =
      firstIndices(this->Ranks, std::int64_t(this->triangles()));
    this->Mine.FirstTriangle = firsts[std::size_t(this->Ranks.rank())];
    this->Mine.AllTriangles = firsts.back();
  }

  Communicator& Ranks;
  const ConstraintSegments& Segments;
  const int Threads;
  DistributedTriangulation& Mine;
  Buffer<Id>& Corners;
  const std::int64_t First; ///< internal id of the first own point
  const std::size_t Own;
  std::vector<Point2> Positions; ///< coordinates of own points, then of other ranks' points
};

} // namespace

void constrainRanks(Communicator& ranks, const ConstraintSegments& segments, int threads,
  DistributedTriangulation& mine)
{
  if (mine.Ids64.size() == 0)
  {
    RankConstrainer<std::int32_t>(ranks, segments, threads, mine, mine.Ids32).run();
  }
  else
  {
    RankConstrainer<std::int64_t>(ranks, segments, threads, mine, mine.Ids64).run();
  }
}

} // namespace tipp
