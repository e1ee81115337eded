// SPDX-License-Identifier: BSD-3-Clause
#include "Locate/CellLocator.h"

#include "Locate/BoxTree.h"
#include "Parallel/CountingSort.h"
#include "Parallel/ParallelFor.h"

#include <atomic>
#include <mutex>
#include <type_traits>
#include <utility>

namespace tipp
{
namespace
{

constexpr std::int64_t mostCells = 700000000; // 3 numbers per triangle must fit into 31 bits
constexpr std::int64_t cellsPerSeed = 32;

} // namespace

/// Fills a CellWalk, or leaves it without neighbours.
template <typename Access>
class CellWalk::Builder
{
public:
  Builder(const SimplexMesh& mesh, const Access& access, int threads, CellWalk& walk)
    : Mesh(mesh)
    , Cells(access)
    , Threads(threads)
    , Walk(walk)
    , Turns(std::size_t(mesh.Cells))
  {
  }

  void make()
  {
    this->findTurns();
    this->Walk.Neighbors.assign(std::size_t(3 * this->Mesh.Cells), None);
    if (!this->matchEdges() || !this->findBorder() || this->borderMeetsCells() ||
      !this->makeSeeds())
    {
      this->Walk.Neighbors = {};
      return;
    }
    this->Walk.IsConvex = this->isBorderConvex();
  }

private:
  /// An edge, kept in the list of its point of lower index.
  struct Edge
  {
    std::uint32_t Other; ///< the other point, and the highest bit if the edge ends at the lower one
    std::uint32_t Number; ///< 3 * triangle + the corner opposite to it
  };

  /// The first and the second point, counter-clockwise, of edge 3 * triangle + opposite corner.
  std::pair<std::int64_t, std::int64_t> endsOf(std::int64_t edge) const
  {
    const auto* const ids = this->Cells.ids(edge / 3);
    const std::int64_t after = ids[(edge + 1) % 3];
    const std::int64_t before = ids[(edge + 2) % 3];
    return this->isClockwise(edge / 3) ? std::make_pair(before, after)
                                       : std::make_pair(after, before);
  }

  Point2 at(std::int64_t point) const { return this->Cells.coordinates(point); }

  bool isUsed(std::int64_t cell) const { return this->Turns[std::size_t(cell)] != 0; }
  bool isClockwise(std::int64_t cell) const { return this->Turns[std::size_t(cell)] < 0; }

  /// Calls work(begin, end) for parts of `count`, on the threads.
  template <typename Work>
  void forParts(std::int64_t count, const Work& work) const
  {
    forChunks(count, 1 << 14, this->Threads, {},
      [&](std::int64_t begin, std::int64_t end, int) { work(begin, end); });
  }

  /// Computes the orientation of each triangle; 0 for those that are excluded.
  void findTurns()
  {
    this->forParts(this->Mesh.Cells,
      [&](std::int64_t begin, std::int64_t end)
      {
        for (std::int64_t cell = begin; cell < end; ++cell)
        {
          Point2 corners[3];
          this->Cells.corners(cell, corners);
          const bool isThere = (!this->Mesh.Hidden || !this->Mesh.Hidden[cell]) &&
            isFinite(corners[0]) && isFinite(corners[1]) && isFinite(corners[2]);
          const int turn = isThere ? orientation(corners[0], corners[1], corners[2]) : 0;
          this->Turns[std::size_t(cell)] = (signed char)(turn);
        }
      });
  }

  /// Calls work(lower point, edge) for the edges of triangles [begin, end).
  template <typename Work>
  void forEdges(std::int64_t begin, std::int64_t end, const Work& work) const
  {
    for (std::int64_t cell = begin; cell < end; ++cell)
    {
      for (std::int64_t edge = 3 * cell; edge < 3 * cell + 3 && this->isUsed(cell); ++edge)
      {
        const auto [first, second] = this->endsOf(edge);
        const auto number = std::uint32_t(edge);
        first < second ? work(std::size_t(first), Edge{ std::uint32_t(second), number })
                       : work(std::size_t(second), Edge{ std::uint32_t(first) | Turned, number });
      }
    }
  }

  /// Finds the two triangles of each edge; false if an edge has more.
  bool matchEdges()
  {
    const std::int64_t points = this->Mesh.PointCount;
    const GroupedItems<Edge, std::uint32_t> edges(std::size_t(points), this->Threads,
      [&](const auto& visit)
      {
        this->forParts(this->Mesh.Cells,
          [&](std::int64_t begin, std::int64_t end) { this->forEdges(begin, end, visit); });
      });
    std::atomic<bool> isManifold{ true };
    this->forParts(points,
      [&](std::int64_t begin, std::int64_t end)
      {
        for (std::int64_t point = begin; point < end; ++point)
        {
          if (!this->matchAt(edges.begin(std::size_t(point)), edges.end(std::size_t(point))))
          {
            isManifold.store(false);
          }
        }
      });
    return isManifold;
  }

  /// Matches the edges of one point's list.
  bool matchAt(const Edge* begin, const Edge* end)
  {
    for (const Edge* edge = begin; edge < end; ++edge)
    {
      for (const Edge* other = begin; other < edge; ++other)
      {
        if (other->Other == edge->Other)
        {
          return false; // two triangles on one side
        }
        if ((other->Other ^ edge->Other) == Turned)
        {
          this->Walk.Neighbors[edge->Number] = this->coded(*other);
          this->Walk.Neighbors[other->Number] = this->coded(*edge);
        }
      }
    }
    return true;
  }

  std::uint32_t coded(const Edge& edge) const
  {
    return edge.Number | (this->isClockwise(edge.Number / 3) ? Turned : 0);
  }

  /// Finds the edges of a single triangle. Returns false if most edges are such.
  bool findBorder()
  {
    std::mutex mutex;
    this->forParts(this->Mesh.Cells,
      [&](std::int64_t begin, std::int64_t end)
      {
        std::vector<std::int64_t> own;
        for (std::int64_t edge = 3 * begin; edge < 3 * end; ++edge)
        {
          if (this->Walk.Neighbors[std::size_t(edge)] == None && this->isUsed(edge / 3))
          {
            own.push_back(edge);
          }
        }
        const std::lock_guard<std::mutex> lock(mutex);
        this->Border.insert(this->Border.end(), own.begin(), own.end());
      });
    return std::int64_t(this->Border.size()) <= this->Mesh.Cells / 2 + 64;
  }

  /// Whether the border is a single loop without right turns.
  bool isBorderConvex() const
  {
    std::vector<std::pair<std::int64_t, std::int64_t>>
      next; // first point of an edge, and its second
    for (const std::int64_t edge : this->Border)
    {
      next.push_back(this->endsOf(edge));
    }
    std::sort(next.begin(), next.end());
    const auto after = [&next](std::int64_t point)
    {
      return std::lower_bound(next.begin(), next.end(), std::make_pair(point, std::int64_t(0)))
        ->second;
    };
    std::int64_t a = next.front().first;
    std::int64_t b = next.front().second;
    for (std::size_t i = 0; i < next.size(); ++i)
    {
      const std::int64_t c = after(b);
      if (orientation(this->at(a), this->at(b), this->at(c)) < 0 ||
        (c == next.front().second) != (i + 1 == next.size()))
      {
        return false;
      }
      a = b;
      b = c;
    }
    return true;
  }

  /// Whether a triangle meets a border edge of another triangle at more than common corners.
  bool borderMeetsCells() const
  {
    const std::vector<std::int64_t>& border = this->Border;
    const BoxTree<2> tree(std::int64_t(border.size()), this->Threads,
      [&](std::int64_t i)
      {
        const auto [first, second] = this->endsOf(border[std::size_t(i)]);
        return Box2::of(this->at(first), this->at(second));
      });
    std::atomic<bool> doMeet{ false };
    this->forParts(this->Mesh.Cells,
      [&](std::int64_t begin, std::int64_t end)
      {
        for (std::int64_t cell = begin; cell < end && !doMeet; ++cell)
        {
          if (this->isUsed(cell))
          {
            const auto* const ids = this->Cells.ids(cell);
            Box2 box = Box2::of(this->at(ids[0]), this->at(ids[1]));
            box.extend(this->at(ids[2]));
            tree.search(box,
              [&](std::int32_t i)
              {
                if (this->meets(cell, border[std::size_t(i)]))
                {
                  doMeet.store(true);
                }
              });
          }
        }
      });
    return doMeet;
  }

  bool meets(std::int64_t cell, std::int64_t edge) const
  {
    if (cell == edge / 3)
    {
      return false;
    }
    const auto [first, second] = this->endsOf(edge);
    const Point2 u = this->at(first);
    const Point2 v = this->at(second);
    std::int64_t ids[3]; // counter-clockwise
    Point2 corners[3];
    for (int i = 0; i < 3; ++i)
    {
      ids[i] = this->Cells.ids(cell)[this->isClockwise(cell) ? 2 - i : i];
      corners[i] = this->at(ids[i]);
    }
    for (int i = 0; i < 3; ++i)
    {
      if (ids[i] == first || ids[i] == second)
      {
        // It does if the edge's other end lies in its angle at that corner. Two common corners
        // would be an edge with two triangles.
        const Point2 other = ids[i] == first ? v : u;
        return orientation(corners[i], corners[(i + 1) % 3], other) >= 0 &&
          orientation(corners[i], corners[(i + 2) % 3], other) <= 0;
      }
    }
    // By separating axes.
    int left = 0;
    int right = 0;
    for (int i = 0; i < 3; ++i)
    {
      const Point2 a = corners[i];
      const Point2 b = corners[(i + 1) % 3];
      if (orientation(a, b, u) < 0 && orientation(a, b, v) < 0)
      {
        return false;
      }
      const int side = orientation(u, v, a);
      left += side > 0 ? 1 : 0;
      right += side < 0 ? 1 : 0;
    }
    return left < 3 && right < 3;
  }

  /// Selects the triangles that walks start from. Returns false if there is none.
  bool makeSeeds()
  {
    std::vector<std::int32_t> cells;
    for (std::int64_t first = 0; first < this->Mesh.Cells; first += cellsPerSeed)
    {
      const std::int64_t end = std::min(first + cellsPerSeed, this->Mesh.Cells);
      std::int64_t cell = first;
      while (cell < end && !this->isUsed(cell))
      {
        ++cell;
      }
      if (cell < end)
      {
        cells.push_back(std::int32_t(cell));
      }
    }
    const auto boxOfSeed = [&](std::int64_t i)
    { return Box2::of(this->at(this->Cells.ids(cells[std::size_t(i)])[0])); };
    const auto count = std::int64_t(cells.size());
    const Box2 bounds = boundsOf<2>(count, this->Threads, boxOfSeed);
    for (const std::int32_t i : mortonOrder(count, this->Threads, bounds, boxOfSeed))
    {
      const std::int32_t cell = cells[std::size_t(i)];
      this->Walk.Seeds.push_back(std::uint32_t(cell) | (this->isClockwise(cell) ? Turned : 0));
      this->Walk.SeedCodes.push_back(mortonCode(boxOfSeed(i), bounds));
    }
    this->Walk.Bounds = bounds;
    return count > 0;
  }

  const SimplexMesh& Mesh;
  const Access& Cells;
  const int Threads;
  CellWalk& Walk;
  std::vector<signed char> Turns;
  std::vector<std::int64_t>
    Border; ///< border edges, as 3 * triangle + the corner opposite to the edge
};

CellWalk::CellWalk(const SimplexMesh& mesh, int threads)
{
  if (mesh.Dimension != 2 || mesh.Cells > mostCells || mesh.PointCount > mostCells)
  {
    return;
  }
  withAccess(mesh,
    [&](const auto& access)
    {
      using Access = std::decay_t<decltype(access)>;
      if constexpr (Access::Dimension == 2)
      {
        Builder<Access>(mesh, access, threads, *this).make();
      }
    });
}

void CellWalk::jump(Point2 point, Position& at) const
{
  const std::uint64_t code = mortonCode(Box2::of(point), this->Bounds);
  const auto after = std::lower_bound(this->SeedCodes.begin(), this->SeedCodes.end(), code);
  const auto i = std::size_t(after - this->SeedCodes.begin());
  const std::uint32_t seed = this->Seeds[std::min(i, this->Seeds.size() - 1)];
  at.Cell = seed & ~Turned;
  at.IsClockwise = (seed & Turned) != 0;
}

} // namespace tipp
