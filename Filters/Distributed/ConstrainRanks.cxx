// SPDX-License-Identifier: BSD-3-Clause
#include "Distributed/ConstrainRanks.h"

#include "Arrays/Concatenated.h"
#include "Constraints/Insertion/CrossedPart.h"
#include "Parallel/ParallelFor.h"
#include "Ranks/Archive.h"

#include <algorithm>
#include <tuple>
#include <utility>

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
    addCells(this->Ranks, own, this->Corners, this->Mine);
    if (this->Segments.cuts())
    {
      this->Positions = this->Mine.positions();
      this->Corners.truncate(
        3 * cutTriangles(this->view(), this->Segments, this->Corners.data(), this->triangles()));
      addCells(this->Ranks, std::vector<IdTriangle>(), this->Corners, this->Mine);
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

  Communicator& Ranks;
  const ConstraintSegments& Segments;
  const int Threads;
  DistributedTriangulation& Mine;
  Buffer<Id>& Corners;
  const std::int64_t First; ///< internal id of the first own point
  const std::size_t Own;
  std::vector<Point2> Positions; ///< coordinates of own points, then of other ranks' points
};

/// An edge of a triangle on a segment. It is also a question to the rank that owns the edge's lower
/// end: does the sender keep the edge?
struct Question
{
  std::int64_t Order;  ///< index of the segment in the given order
  std::int64_t Low;    ///< internal ids
  std::int64_t High;   ///< internal ids
  std::int64_t IsLeft; ///< 1: the triangle is on the left of the segment

  auto key() const { return std::tie(this->Order, this->Low, this->High); }
};

/// An edge of one of a rank's triangles, in the direction of the segment that it lies on.
struct Side : Question
{
  bool IsAscending; ///< the segment, in lexicographic order
  Point2 Begin;
  std::array<std::int64_t, 2> Ends; ///< local indices
};

class LineFinder
{
public:
  LineFinder(Communicator& ranks, const NamedSegments& named, const DistributedTriangulation& mine)
    : Ranks(ranks)
    , Named(named)
    , Mine(mine)
    , Positions(mine.positions())
  {
  }

  ConstraintLines find()
  {
    this->addSides(this->Mine.Ids32);
    this->addSides(this->Mine.Ids64);
    this->keepOneSide();
    this->leaveToOthers();
    return this->lines();
  }

private:
  template <typename Id>
  void addSides(const Buffer<Id>& corners)
  {
    if (corners.size() == 0)
    {
      return;
    }
    const PointsView view(this->Positions);
    const auto idOf = internalIds(this->Mine, this->Ranks.rank());
    for (const ScannedTriangles::Edge& edge :
      edgesOnSegments(view, this->Named.Segments, corners.data(), corners.size() / 3))
    {
      const Id* const ids = corners.data() + 3 * edge.Triangle;
      std::array<std::int64_t, 2> ends{ ids[edge.From], ids[(edge.From + 1) % 3] };
      const SegmentTree::Item& segment = this->Named.Segments.at(edge.Segment);
      const bool isAscending = lexicographicLess(segment.A, segment.B);
      const bool isLeft = isAscending ==
        lexicographicLess(
          this->Positions[std::size_t(ends[0])], this->Positions[std::size_t(ends[1])]);
      if (!isLeft)
      {
        std::swap(ends[0], ends[1]);
      }
      const auto [low, high] = std::minmax({ idOf(ends[0]), idOf(ends[1]) });
      this->Sides.push_back(
        { { this->Named.Order[std::size_t(edge.Segment)], low, high, isLeft ? 1 : 0 }, isAscending,
          this->Positions[std::size_t(ends[0])], ends });
    }
  }

  void keepOneSide()
  {
    std::sort(this->Sides.begin(), this->Sides.end(),
      [](const Side& a, const Side& b)
      { return std::make_pair(a.key(), -a.IsLeft) < std::make_pair(b.key(), -b.IsLeft); });
    this->Sides.erase(std::unique(this->Sides.begin(), this->Sides.end(),
                        [](const Side& a, const Side& b) { return a.key() == b.key(); }),
      this->Sides.end());
  }

  /// Removes the sides of edges that another rank keeps, since it has the triangle on the left.
  void leaveToOthers()
  {
    std::vector<std::vector<Question>> asked(std::size_t(this->Ranks.size()));
    for (const Side& side : this->Sides)
    {
      asked[ownerOf(side.Low, this->Mine.FirstIds)].push_back(side);
    }
    const std::vector<std::vector<Question>> questions = this->Ranks.allToAll(asked);
    std::vector<Question> left = concatenated(questions);
    left.erase(std::remove_if(left.begin(), left.end(),
                 [](const Question& question) { return question.IsLeft == 0; }),
      left.end());
    const auto isLess = [](const Question& a, const Question& b) { return a.key() < b.key(); };
    std::sort(left.begin(), left.end(), isLess);
    std::vector<std::vector<char>> answers; // by rank, in the order of its questions
    for (const std::vector<Question>& part : questions)
    {
      answers.emplace_back();
      for (const Question& question : part)
      {
        answers.back().push_back(char(
          question.IsLeft != 0 || !std::binary_search(left.begin(), left.end(), question, isLess)));
      }
    }
    const std::vector<std::vector<char>> isMine = this->Ranks.allToAll(answers);
    std::vector<std::size_t> next(isMine.size(), 0);
    const auto others = std::remove_if(this->Sides.begin(), this->Sides.end(),
      [&](const Side& side)
      {
        const std::size_t owner = ownerOf(side.Low, this->Mine.FirstIds);
        return !isMine[owner].at(next[owner]++);
      });
    this->Sides.erase(others, this->Sides.end());
  }

  ConstraintLines lines()
  {
    const auto isBefore = [](const Side& a, const Side& b) // along each segment
    {
      if (a.Order != b.Order)
      {
        return a.Order < b.Order;
      }
      return a.IsAscending ? lexicographicLess(a.Begin, b.Begin)
                           : lexicographicLess(b.Begin, a.Begin);
    };
    std::sort(this->Sides.begin(), this->Sides.end(), isBefore);
    ConstraintLines result;
    for (const Side& side : this->Sides)
    {
      result.Ends.push_back(side.Ends);
      result.Cells.push_back(this->Named.Cells.at(std::size_t(side.Order)));
    }
    result.First =
      firstIndices(this->Ranks, std::int64_t(this->Sides.size()))[std::size_t(this->Ranks.rank())];
    return result;
  }

  Communicator& Ranks;
  const NamedSegments& Named;
  const DistributedTriangulation& Mine;
  const std::vector<Point2> Positions;
  std::vector<Side> Sides;
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

ConstraintLines findConstraintLines(
  Communicator& ranks, const NamedSegments& segments, const DistributedTriangulation& mine)
{
  return LineFinder(ranks, segments, mine).find();
}

} // namespace tipp
