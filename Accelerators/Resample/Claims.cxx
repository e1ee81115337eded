// SPDX-License-Identifier: BSD-3-Clause
#include "Resample/Claims.h"

#include "Resample/CellKey.h"
#include "Resample/CellVisitor.h"
#include "Resample/Containment.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace tipp
{
namespace
{

constexpr std::int32_t unclaimed = -1;

struct Touch
{
  std::int64_t Sample;
  std::int32_t Cell;
};

/// What a thread keeps of the first walk. Cells that do not overlap write to different samples;
/// if some do overlap, more samples are claimed than there are, and another walk decides.
class FirstWalk
{
public:
  /// `names`: what the cells are called in the claims; null: as they are.
  explicit FirstWalk(std::int32_t* claims, const std::int32_t* names = nullptr)
    : Claims(claims)
    , Names(names)
  {
  }

  void visit(std::int64_t samples)
  {
    ++this->Statistics.VisitedCells;
    this->Statistics.Tests += samples;
  }

  void claim(std::int64_t first, int count, std::int32_t cell)
  {
    this->Claimed += count;
    const std::int32_t name = this->Names ? this->Names[cell] : cell;
    for (std::int64_t i = first; i < first + count; ++i)
    {
      // An ordinary store; but cells that overlap may be in two threads at once.
      __atomic_store_n(this->Claims + i, name, __ATOMIC_RELAXED);
    }
  }

  void touch(std::int64_t first, int count, std::int32_t cell)
  {
    for (std::int64_t i = first; i < first + count; ++i)
    {
      if (__atomic_load_n(this->Claims + i, __ATOMIC_RELAXED) == unclaimed)
      {
        this->Touches.push_back({ i, this->Names ? this->Names[cell] : cell });
      }
    }
  }

  void addExactTests(std::int64_t count) { this->Statistics.ExactTests += count; }

  void endChunk()
  {
    if (this->Touches.size() > this->MostTouches)
    {
      this->dropClaimed();
      this->MostTouches = std::max(this->MostTouches, 2 * this->Touches.size());
    }
  }

  /// Most samples that one cell touches another answers.
  void dropClaimed()
  {
    const auto claimed = [this](const Touch& touch)
    { return __atomic_load_n(this->Claims + touch.Sample, __ATOMIC_RELAXED) != unclaimed; };
    this->Touches.erase(
      std::remove_if(this->Touches.begin(), this->Touches.end(), claimed), this->Touches.end());
  }

  ClaimStatistics Statistics;
  std::int64_t Claimed = 0;
  std::vector<Touch> Touches;

private:
  std::int32_t* Claims;
  const std::int32_t* Names;
  std::size_t MostTouches = 1 << 16;
};

void lowerTo(CellKey* to, CellKey key)
{
  CellKey known = __atomic_load_n(to, __ATOMIC_RELAXED);
  while (key < known &&
    !__atomic_compare_exchange_n(to, &known, key, true, __ATOMIC_RELAXED, __ATOMIC_RELAXED))
  {
  }
}

/// Finds the lowest key at each sample, and then the first cell that has it.
template <typename Access>
class OverlapWalk
{
public:
  OverlapWalk(const Access& cells, CellKey* keys, std::int32_t* claims)
    : Cells(cells)
    , Keys(keys)
    , Claims(claims)
  {
  }

  void visit(std::int64_t) {}
  void touch(std::int64_t, int, std::int32_t) {}
  void addExactTests(std::int64_t) {}
  void endChunk() {}

  void claim(std::int64_t first, int count, std::int32_t cell)
  {
    if (cell != this->KnownCell)
    {
      this->KnownCell = cell;
      this->KnownKey = keyOf(this->Cells, cell);
    }
    for (std::int64_t i = first; i < first + count; ++i)
    {
      this->Claims ? this->settle(i, cell) : lowerTo(this->Keys + i, this->KnownKey);
    }
  }

  static CellKey keyOf(const Access& cells, std::int32_t cell)
  {
    Point3 corners[Access::Corners];
    for (int i = 0; i < Access::Corners; ++i)
    {
      corners[i] = cells.point(cells.ids(cell)[i]);
    }
    return cellKey(corners);
  }

private:
  void settle(std::int64_t sample, std::int32_t cell)
  {
    if (this->Keys[sample] != this->KnownKey)
    {
      return;
    }
    std::int32_t* to = this->Claims + sample;
    std::int32_t known = __atomic_load_n(to, __ATOMIC_RELAXED);
    while ((known == unclaimed || cell < known) &&
      !__atomic_compare_exchange_n(to, &known, cell, true, __ATOMIC_RELAXED, __ATOMIC_RELAXED))
    {
    }
  }

  Access Cells;
  CellKey* Keys;
  std::int32_t* Claims; ///< null in the walk for the keys
  std::int32_t KnownCell = unclaimed;
  CellKey KnownKey = noCellKey;
};

class Claimer
{
public:
  Claimer(const SimplexMesh& mesh, const Lattice& lattice, int threads, const Report& report)
    : Mesh(mesh)
    , Axes(mesh, lattice)
    , Threads(threads)
    , Progress(report)
  {
  }

  Claims run()
  {
    this->Result.Cells.reset(new std::int32_t[std::size_t(this->Axes.samples())]);
    this->fill(this->Result.Cells.get(), unclaimed);
    std::vector<FirstWalk> walks(std::size_t(this->Threads), FirstWalk(this->Result.Cells.get()));
    this->Result.Aborted = !visitCells(this->Mesh, this->Axes, walks, this->Progress);
    if (!this->Result.Aborted)
    {
      this->settle(walks);
    }
    return std::move(this->Result);
  }

  Claims finish(std::unique_ptr<std::int32_t[]> claims, std::int64_t claimed,
    const std::vector<std::int32_t>& open)
  {
    this->Result.Cells = std::move(claims);
    std::vector<std::int64_t> ids;
    withAccess(this->Mesh,
      [&](const auto& access)
      {
        for (const std::int32_t cell : open)
        {
          ids.insert(ids.end(), access.ids(cell), access.ids(cell) + access.Corners);
        }
      });
    SimplexMesh part = this->Mesh;
    part.Ids = ids.data();
    part.Wide = true;
    part.Cells = std::int64_t(open.size());
    part.Hidden = nullptr;
    std::vector<FirstWalk> walks(
      std::size_t(this->Threads), FirstWalk(this->Result.Cells.get(), open.data()));
    this->Result.Aborted = !visitCells(part, this->Axes, walks, this->Progress);
    walks.front().Claimed += claimed;
    if (!this->Result.Aborted)
    {
      this->settle(walks);
    }
    return std::move(this->Result);
  }

private:
  template <typename T>
  void fill(T* values, T value)
  {
    forChunks(this->Axes.samples(), 1 << 16, this->Threads, {},
      [&](std::int64_t begin, std::int64_t end, int)
      { std::fill(values + begin, values + end, value); });
  }

  std::int64_t countClaimed()
  {
    std::vector<std::int64_t> counts(std::size_t(this->Threads), 0);
    forChunks(this->Axes.samples(), 1 << 16, this->Threads, {},
      [&](std::int64_t begin, std::int64_t end, int thread)
      {
        const std::int32_t* cells = this->Result.Cells.get();
        std::int64_t count = 0;
        for (std::int64_t i = begin; i < end; ++i)
        {
          count += cells[i] != unclaimed;
        }
        counts[std::size_t(thread)] += count;
      });
    std::int64_t total = 0;
    for (const std::int64_t count : counts)
    {
      total += count;
    }
    return total;
  }

  void settle(std::vector<FirstWalk>& walks)
  {
    ClaimStatistics& statistics = this->Result.Statistics;
    std::int64_t claimed = 0;
    std::vector<Touch> touches;
    for (FirstWalk& walk : walks)
    {
      statistics.VisitedCells += walk.Statistics.VisitedCells;
      statistics.Tests += walk.Statistics.Tests;
      statistics.ExactTests += walk.Statistics.ExactTests;
      claimed += walk.Claimed;
      walk.dropClaimed();
      touches.insert(touches.end(), walk.Touches.begin(), walk.Touches.end());
    }
    statistics.OverlappingClaims = claimed - this->countClaimed();
    if (statistics.OverlappingClaims > 0)
    {
      this->settleOverlaps();
    }
    this->settleBorder(touches);
  }

  void settleOverlaps()
  {
    const std::size_t samples = std::size_t(this->Axes.samples());
    const std::unique_ptr<CellKey[]> keys(new CellKey[samples]);
    this->fill(keys.get(), noCellKey);
    std::int32_t* const claims = this->Result.Cells.get();
    withAccess(this->Mesh,
      [&](const auto& access)
      {
        using Access = std::decay_t<decltype(access)>;
        using Walk = OverlapWalk<Access>;
        using Visitor = CellVisitor<Access, Walk>;
        std::vector<Walk> forKeys(std::size_t(this->Threads), Walk(access, keys.get(), nullptr));
        if (!Visitor(this->Mesh, this->Axes, forKeys).run(this->Progress))
        {
          this->Result.Aborted = true;
          return;
        }
        this->fill(claims, unclaimed);
        std::vector<Walk> forCells(std::size_t(this->Threads), Walk(access, keys.get(), claims));
        this->Result.Aborted = !Visitor(this->Mesh, this->Axes, forCells).run(this->Progress);
      });
  }

  void settleBorder(std::vector<Touch>& touches)
  {
    withAccess(this->Mesh,
      [&](const auto& access)
      {
        using Access = std::decay_t<decltype(access)>;
        struct Candidate
        {
          std::int64_t Sample;
          CellKey Key;
          std::int32_t Cell;
        };
        std::vector<Candidate> candidates;
        for (const Touch& touch : touches)
        {
          const CellKey key = OverlapWalk<Access>::keyOf(access, touch.Cell);
          candidates.push_back(
            { touch.Sample, withRank(key, this->rank(access, touch)), touch.Cell });
        }
        std::sort(candidates.begin(), candidates.end(),
          [](const Candidate& a, const Candidate& b)
          { return std::tie(a.Sample, a.Key, a.Cell) < std::tie(b.Sample, b.Key, b.Cell); });
        for (const Candidate& candidate : candidates)
        {
          std::int32_t& claim = this->Result.Cells[std::size_t(candidate.Sample)];
          if (claim == unclaimed)
          {
            claim = candidate.Cell;
            this->Result.Border.push_back(
              { candidate.Sample, candidate.Cell, int(candidate.Key >> 60) });
          }
        }
      });
  }

  template <typename Access>
  int rank(const Access& access, const Touch& touch) const
  {
    typename CellGeometry<Access::Dimension>::Corners corners;
    access.corners(touch.Cell, corners);
    const std::int64_t row = touch.Sample / this->Axes.U.size();
    const double u = this->Axes.U[int(touch.Sample % this->Axes.U.size())];
    const double v = this->Axes.V[int(row % this->Axes.V.size())];
    if constexpr (Access::Dimension == 2)
    {
      return moveRank(corners, { u, v });
    }
    else
    {
      return moveRank(corners, { u, v, this->Axes.W[int(row / this->Axes.V.size())] });
    }
  }

  const SimplexMesh& Mesh;
  LatticeAxes Axes;
  int Threads;
  const Report& Progress;
  Claims Result;
};

} // namespace

Claims claimSamples(
  const SimplexMesh& mesh, const Lattice& lattice, int threads, const Report& report)
{
  return Claimer(mesh, lattice, threads, report).run();
}

Claims finishClaims(const SimplexMesh& mesh, const Lattice& lattice, int threads,
  std::unique_ptr<std::int32_t[]> claims, std::int64_t claimed,
  const std::vector<std::int32_t>& open, const Report& report)
{
  return Claimer(mesh, lattice, threads, report).finish(std::move(claims), claimed, open);
}

} // namespace tipp
