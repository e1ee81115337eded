// SPDX-License-Identifier: BSD-3-Clause
#include "Distributed/DistributedTriangulation.h"

#include "Arrays/SortUnique.h"
#include "Constraints/Insertion/CrossedPart.h"
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
    this->Positions = this->Mine.positions();
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
    std::vector<IdTriangle> own = sendToOwners(this->Ranks, all.Triangles, this->Mine.FirstIds);
    std::sort(own.begin(), own.end());
    this->setTriangles(own);
    if (this->Segments.cuts())
    {
      this->Positions = this->Mine.positions();
      this->Corners.truncate(
        3 * cutTriangles(this->view(), this->Segments, this->Corners.data(), this->triangles()));
    }
    numberCells(this->Ranks, this->triangles(), this->Mine);
  }

private:
  std::size_t triangles() const { return this->Corners.size() / 3; }
  PointsView view() const { return PointsView(this->Positions); }

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
    crossed.rename(internalIds(this->Mine, this->Ranks.rank()));
    return crossed;
  }

  /// For each own point, whether other ranks have triangles at it.
  std::vector<char> findShared()
  {
    std::vector<char> isShared(this->Own, 0);
    for (const std::vector<std::int64_t>& ids : findUsedByOthers(this->Ranks, this->Mine))
    {
      for (const std::int64_t id : ids)
      {
        isShared.at(std::size_t(id - this->First)) = 1;
      }
    }
    return isShared;
  }

  /// Adds triangles, and fetches the points that they need.
  void setTriangles(const std::vector<IdTriangle>& added)
  {
    std::vector<std::int64_t> ghosts =
      ghostIds(added, this->First, this->First + std::int64_t(this->Own));
    for (const Id corner : this->Corners)
    {
      if (std::size_t(corner) >= this->Own)
      {
        ghosts.push_back(this->Mine.GhostIds[std::size_t(corner) - this->Own]);
      }
    }
    sortUnique(ghosts);
    const auto idOf = internalIds(this->Mine, this->Ranks.rank());
    const auto indexOf = localIndices(this->First, this->Own, ghosts);
    Buffer<Id> corners(this->Corners.size() + 3 * added.size());
    Id* to = std::transform(this->Corners.begin(), this->Corners.end(), corners.begin(),
      [&](Id corner) { return Id(indexOf(idOf(corner))); });
    for (const IdTriangle& triangle : added)
    {
      to = std::transform(
        triangle.begin(), triangle.end(), to, [&](std::int64_t id) { return Id(indexOf(id)); });
    }
    this->Corners = std::move(corners);
    this->Mine.Ghosts =
      fetchPoints(this->Ranks, ghosts, this->Mine.FirstIds, this->Mine.Owned, this->Mine.RowSize);
    this->Mine.GhostIds = std::move(ghosts);
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
