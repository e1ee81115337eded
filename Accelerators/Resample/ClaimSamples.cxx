// SPDX-License-Identifier: BSD-3-Clause
#include "Resample/ClaimSamples.h"

#include "Parallel/Sort.h"
#include "Resample/CellVisitor.h"
#include "Resample/NearBorder.h"
#include "Resample/SamplingAccess.h"

#include <algorithm>
#include <functional>
#include <utility>

namespace tipp
{
namespace
{

/// The cell of lowest key among those that touch a sample.
template <typename Access>
std::int32_t lowestCell(
  const Access& cells, const LatticeAxes& axes, const Touch* begin, const Touch* end)
{
  std::pair<CellKey, std::int32_t> lowest(noCellKey, begin->Cell);
  // Most samples are touched by one cell only.
  for (const Touch* touch = begin; end - begin > 1 && touch < end; ++touch)
  {
    const int rank = borderRank(cells, axes, touch->Sample, touch->Cell);
    lowest = std::min(lowest, { withRank(keyOf(cells, touch->Cell), rank), touch->Cell });
  }
  return lowest.second;
}

} // namespace

std::vector<BorderClaim> borderClaims(
  const SimplexMesh& mesh, const LatticeAxes& axes, std::vector<Touch> touches, int threads)
{
  sortInParts(touches.begin(), touches.end(), threads);
  std::vector<BorderClaim> claims;
  std::vector<std::size_t> begins;
  for (std::size_t i = 0; i < touches.size(); ++i)
  {
    if (i == 0 || touches[i].Sample != touches[i - 1].Sample)
    {
      claims.push_back({ touches[i].Sample, touches[i].Cell });
      begins.push_back(i);
    }
  }
  begins.push_back(touches.size());
  withSamplingAccess(mesh,
    [&](const auto& access)
    {
      forChunks(std::int64_t(claims.size()), 1 << 8, threads, {},
        [&](std::int64_t begin, std::int64_t end, int)
        {
          for (auto i = std::size_t(begin); i < std::size_t(end); ++i)
          {
            claims[i].Cell =
              lowestCell(access, axes, touches.data() + begins[i], touches.data() + begins[i + 1]);
          }
        });
    });
  return claims;
}

namespace
{

constexpr std::int32_t unclaimed = -1;

/// A thread's sink in the first walk. Cells that do not overlap write to different samples. If some
/// overlap, the number of claims exceeds the number of claimed samples, and another walk decides.
class FirstWalk : public TouchingWalk<FirstWalk>
{
public:
  /// `names` maps a cell's index to the number to store; null: store the index itself.
  FirstWalk(std::int32_t* claims, const std::int32_t* names)
    : Claims(claims)
    , Names(names)
  {
  }

  void claim(const SampleRow& row, int begin, int count, std::int32_t cell)
  {
    this->Claimed += std::max(count, 0);
    const std::int32_t name = this->Names ? this->Names[cell] : cell;
    std::int32_t* const claims = this->Claims + row.First + begin;
    for (int i = 0; i < count; ++i)
    {
      // Relaxed atomic, compiled to an ordinary store: overlapping cells may be processed by two
      // threads.
      __atomic_store_n(claims + i, name, __ATOMIC_RELAXED);
    }
  }

  void touch(const SampleRow& row, int begin, int count, std::int32_t cell)
  {
    TouchingWalk::touch(row, begin, count, this->Names ? this->Names[cell] : cell);
  }

  bool isClaimed(std::int64_t sample) const
  {
    return __atomic_load_n(this->Claims + sample, __ATOMIC_RELAXED) != unclaimed;
  }

private:
  std::int32_t* Claims;
  const std::int32_t* Names;
};

/// Lowers *to to `value` atomically.
template <typename T>
void lowerTo(T* to, T value)
{
  T known = __atomic_load_n(to, __ATOMIC_RELAXED);
  while (value < known &&
    !__atomic_compare_exchange_n(to, &known, value, true, __ATOMIC_RELAXED, __ATOMIC_RELAXED))
  {
  }
}

/// For overlapping cells: calls settle(sample, cell, key) for each sample that each claims.
template <typename Access>
class OverlapWalk
{
public:
  using Settle = std::function<void(std::int64_t sample, std::int32_t cell, CellKey key)>;

  OverlapWalk(const Access& cells, Settle settle)
    : Cells(cells)
    , SettleSample(std::move(settle))
  {
  }

  void visit(std::int64_t) {}
  void touch(const SampleRow&, int, int, std::int32_t) {}
  void addExactTests(std::int64_t) {}
  void endChunk() {}

  void claim(const SampleRow& row, int begin, int count, std::int32_t cell)
  {
    if (count > 0 && cell != this->KnownCell)
    {
      this->KnownCell = cell;
      this->KnownKey = keyOf(this->Cells, cell);
    }
    for (std::int64_t i = row.First + begin; i < row.First + begin + count; ++i)
    {
      this->SettleSample(i, cell, this->KnownKey);
    }
  }

private:
  Access Cells;
  Settle SettleSample;
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
    this->walk(this->Mesh, nullptr, 0);
    return std::move(this->Result);
  }

  Claims finish(std::unique_ptr<std::int32_t[]> cells, const SampledCells& sampled)
  {
    this->Result.Cells = std::move(cells);
    this->walk(PartMesh(this->Mesh, sampled.Open).mesh(), sampled.Open.data(), sampled.Claimed);
    return std::move(this->Result);
  }

private:
  template <typename T>
  void fill(T* values, T value)
  {
    fillInChunks(values, this->Axes.samples(), value, this->Threads);
  }

  /// Claims samples for all cells of `mesh`. `names`, if not null, has the index in the whole mesh
  /// of each cell; see FirstWalk. `claimed` samples have been claimed before.
  void walk(const SimplexMesh& mesh, const std::int32_t* names, std::int64_t claimed)
  {
    std::vector<FirstWalk> walks(
      std::size_t(this->Threads), FirstWalk(this->Result.Cells.get(), names));
    GroupBoxes boxes;
    this->Result.Aborted = !visitCells(mesh, this->Axes, walks, this->Progress, boxes);
    if (!names)
    {
      this->Boxes = std::move(boxes);
    }
    if (!this->Result.Aborted)
    {
      this->settle(walks, claimed);
    }
  }

  void settle(std::vector<FirstWalk>& walks, std::int64_t claimed)
  {
    ClaimStatistics& statistics = this->Result.Statistics;
    std::vector<Touch> touches = joinWalks(walks, statistics, claimed);
    const std::int32_t* const cells = this->Result.Cells.get();
    statistics.OverlappingClaims = claimed -
      sumOfChunks(this->Axes.samples(), 1 << 16, this->Threads,
        [&](std::int64_t begin, std::int64_t end)
        { return end - begin - std::count(cells + begin, cells + end, unclaimed); });
    if (statistics.OverlappingClaims > 0)
    {
      this->settleOverlaps();
    }
    this->Result.Border = borderClaims(this->Mesh, this->Axes, std::move(touches), this->Threads);
    for (const BorderClaim& claim : this->Result.Border)
    {
      this->Result.Cells[std::size_t(claim.Sample)] = claim.Cell;
    }
    this->addNearSamples();
  }

  void addNearSamples()
  {
    std::vector<BorderClaim>& border = this->Result.Border;
    this->Result.Near = nearSamplesOf(
      this->Mesh, this->Axes, this->Threads, this->Boxes, this->Result.Cells.get(), unclaimed);
    const auto size = std::ptrdiff_t(border.size());
    for (const NearSample& near : this->Result.Near)
    {
      this->Result.Cells[std::size_t(near.Sample)] = near.Cell;
      border.push_back({ near.Sample, near.Cell });
    }
    std::inplace_merge(border.begin(), border.begin() + size, border.end(),
      [](const BorderClaim& a, const BorderClaim& b) { return a.Sample < b.Sample; });
  }

  void settleOverlaps()
  {
    const std::size_t samples = std::size_t(this->Axes.samples());
    const std::unique_ptr<CellKey[]> keys(new CellKey[samples]);
    this->fill(keys.get(), noCellKey);
    auto* const claims = reinterpret_cast<std::uint32_t*>(this->Result.Cells.get());
    withSamplingAccess(this->Mesh,
      [&](const auto& access)
      {
        using Access = std::decay_t<decltype(access)>;
        using Walk = OverlapWalk<Access>;
        using Visitor = CellVisitor<Access, Walk>;
        const auto walk = [&](const typename Walk::Settle& settle)
        {
          std::vector<Walk> walks(std::size_t(this->Threads), Walk(access, settle));
          return Visitor(this->Mesh, this->Axes, walks).run(this->Progress);
        };
        // First finds the lowest key at each sample, then the first cell that has it. As an
        // unsigned number, -1 (unclaimed) is the largest.
        this->Result.Aborted = !walk([&](std::int64_t sample, std::int32_t, CellKey key)
          { lowerTo(keys.get() + sample, key); });
        if (!this->Result.Aborted)
        {
          this->fill(this->Result.Cells.get(), unclaimed);
          this->Result.Aborted = !walk(
            [&](std::int64_t sample, std::int32_t cell, CellKey key)
            {
              if (keys[std::size_t(sample)] == key)
              {
                lowerTo(claims + sample, std::uint32_t(cell));
              }
            });
        }
      });
  }

  const SimplexMesh& Mesh;
  LatticeAxes Axes;
  int Threads;
  const Report& Progress;
  GroupBoxes Boxes; ///< of the whole mesh, unless a device has visited it
  Claims Result;
};

} // namespace

Claims claimSamples(
  const SimplexMesh& mesh, const Lattice& lattice, int threads, const Report& report)
{
  return Claimer(mesh, lattice, threads, report).run();
}

Claims finishClaims(const SimplexMesh& mesh, const Lattice& lattice, int threads,
  std::unique_ptr<std::int32_t[]> cells, const SampledCells& sampled, const Report& report)
{
  return Claimer(mesh, lattice, threads, report).finish(std::move(cells), sampled);
}

namespace
{

/// Merges claims [first, last); the key of claim i is keys[i + shift].
template <typename Access>
void mergeRun(const Access& access, const LatticeAxes& axes, Claims& claims, std::int64_t first,
  std::int64_t last, std::int64_t shift, CellKey* keys)
{
  auto border = std::lower_bound(claims.Border.begin(), claims.Border.end(), first,
    [](const BorderClaim& claim, std::int64_t sample) { return claim.Sample < sample; });
  std::int32_t known = unclaimed;
  CellKey key = noCellKey;
  for (std::int64_t i = first; i < last; ++i)
  {
    std::int32_t& cell = claims.Cells[std::size_t(i)];
    if (cell < 0)
    {
      continue;
    }
    if (cell != known)
    {
      key = keyOf(access, cell);
      known = cell;
    }
    CellKey mine = key;
    if (border != claims.Border.end() && border->Sample == i)
    {
      mine = withRank(key, borderRank(access, axes, i, cell));
      ++border;
    }
    if (mine < keys[i + shift])
    {
      keys[i + shift] = mine;
    }
    else
    {
      cell = unclaimed;
    }
  }
}

} // namespace

void mergeClaims(
  const SimplexMesh& mesh, Claims& claims, const SampleWindow& window, int threads, CellKey* keys)
{
  const LatticeAxes axes(mesh, window.lattice());
  withSamplingAccess(mesh,
    [&](const auto& access)
    {
      forChunks(window.samples(), 1 << 12, threads, {},
        [&](std::int64_t begin, std::int64_t end, int)
        {
          window.forRuns(begin, end,
            [&](std::int64_t first, std::int64_t last, std::int64_t shift)
            { mergeRun(access, axes, claims, first, last, shift, keys); });
        });
    });
}

} // namespace tipp
