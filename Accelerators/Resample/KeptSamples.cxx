// SPDX-License-Identifier: BSD-3-Clause
#include "Resample/KeptSamples.h"

#include "Arrays/IndexSet.h"
#include "Resample/ClaimSamples.h"
#include "Resample/Lanes.h"
#include "Resample/SamplingAccess.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

namespace tipp
{
namespace
{

constexpr float noValue = std::numeric_limits<float>::quiet_NaN();

/// Numbers the triangles of a tile in the order in which they are met: a hash table that is emptied
/// in no time.
class TileCells
{
public:
  void clear()
  {
    ++this->Round;
    this->Cells.clear();
  }

  std::size_t numberOf(std::int32_t cell)
  {
    for (std::uint32_t at = std::uint32_t(cell) * 2654435769U >> Shift;; at = (at + 1) % Size)
    {
      Entry& entry = this->Entries[at];
      if (entry.Round != this->Round)
      {
        entry = { this->Round, cell, std::int32_t(this->Cells.size()) };
        this->Cells.push_back(cell);
      }
      if (entry.Cell == cell)
      {
        return std::size_t(entry.Number);
      }
    }
  }

  const std::vector<std::int32_t>& cells() const { return this->Cells; }

private:
  struct Entry
  {
    std::int64_t Round = 0;
    std::int32_t Cell = 0;
    std::int32_t Number = 0;
  };
  static constexpr std::uint32_t Shift = 32 - 12;
  static constexpr std::uint32_t Size = 1 << 12; // four times the samples of a tile

  std::int64_t Round = 0;
  std::vector<Entry> Entries = std::vector<Entry>(Size);
  std::vector<std::int32_t> Cells;
};

/// Returns the weights of the second and third corner, in the order of a group of triangles, of the
/// one in a lane at a position.
template <typename Access>
std::array<double, 2> weightsAt(const GroupLanes<Access>& group, int lane, double u, double v)
{
  const double offset[2] = { u - group.Corners[0][0][lane], v - group.Corners[0][1][lane] };
  double weights[2];
  if (group.Thin[lane] != 0)
  {
    double edges[2][2];
    for (int i = 0; i < 2; ++i)
    {
      for (int axis = 0; axis < 2; ++axis)
      {
        edges[i][axis] = group.Corners[i + 1][axis][lane] - group.Corners[0][axis][lane];
      }
    }
    thinWeights(edges, offset, weights);
    return { weights[0], weights[1] };
  }
  for (int i = 0; i < 2; ++i)
  {
    weights[i] = group.Normals[i][0][lane] * offset[0] + group.Normals[i][1][lane] * offset[1];
  }
  return { weights[0], weights[1] };
}

} // namespace

/// Makes the strips from claims.
class KeptSamples::Builder
{
public:
  Builder(KeptSamples& kept, const SimplexMesh& mesh, const LatticeAxes& axes, const Claims& claims)
    : Kept(kept)
    , Mesh(mesh)
    , Axes(axes)
    , Found(claims)
  {
  }

  bool run(int threads, const Report& report)
  {
    std::vector<TileCells> cells{ std::size_t(threads) };
    std::atomic<std::int64_t> inside{ 0 };
    bool completed = false;
    withSamplingAccess(this->Mesh,
      [&](const auto& access)
      {
        if constexpr (std::decay_t<decltype(access)>::Dimension == 2)
        {
          completed = forChunks(std::int64_t(this->Kept.Strips.size()), 1, threads, report,
            [&](std::int64_t strip, std::int64_t, int thread)
            { inside += this->fillStrip(access, strip, cells[std::size_t(thread)]); });
        }
      });
    this->Kept.Inside = inside;
    return completed;
  }

private:
  /// Returns the number of samples in triangles.
  template <typename Access>
  std::int64_t fillStrip(const Access& access, std::int64_t index, TileCells& cells)
  {
    Strip& strip = this->Kept.Strips[std::size_t(index)];
    std::int64_t inside = 0;
    const std::int64_t last = std::min((index + 1) * StripTiles, this->Kept.tileCount());
    for (std::int64_t tile = index * StripTiles; tile < last; ++tile)
    {
      inside += this->addTile(access, this->Kept.boxOf(tile), strip, cells);
    }
    strip.Slots.shrink_to_fit();
    strip.Samples.shrink_to_fit();
    return inside;
  }

  /// The claim near the mesh's border that has a sample; null if there is none.
  const NearSample* nearAt(std::int64_t sample) const
  {
    const auto found = std::lower_bound(this->Found.Near.begin(), this->Found.Near.end(), sample,
      [](const NearSample& near, std::int64_t at) { return near.Sample < at; });
    return found != this->Found.Near.end() && found->Sample == sample ? &*found : nullptr;
  }

  template <typename Access>
  std::int64_t addTile(const Access& access, const TileBox& box, Strip& strip, TileCells& cells)
  {
    cells.clear();
    const std::size_t first = strip.Samples.size();
    std::int64_t inside = 0;
    this->forSamples(box,
      [&](std::int64_t sample, int, int)
      {
        const std::int32_t cell = this->Found.Cells[std::size_t(sample)];
        strip.Samples.push_back(
          { cell < 0 ? 0 : std::uint32_t(cells.numberOf(cell)), noValue, noValue });
        inside += cell >= 0;
      });
    std::vector<GroupLanes<Access>> groups;
    strip.FirstSlots.push_back(strip.Slots.size());
    this->addSlots(access, cells.cells(), groups, strip);
    KeptSample* to = strip.Samples.data() + first;
    this->forSamples(box,
      [&](std::int64_t sample, int column, int row)
      {
        if (this->Found.Cells[std::size_t(sample)] >= 0)
        {
          const int slot = int(to->Slot);
          const auto [second, third] = weightsAt(groups[std::size_t(slot / laneCount)],
            slot % laneCount, this->Axes.U[column], this->Axes.V[row]);
          *to = { to->Slot, float(second), float(third) };
        }
        if (const NearSample* const near = this->nearAt(sample))
        {
          *to = { std::uint32_t(strip.Slots.size() - strip.FirstSlots.back()), float(near->Weight),
            0 };
          const auto begin = std::int32_t(near->Ids[0]);
          strip.Slots.push_back({ { begin, std::int32_t(near->Ids[1]), begin }, near->Cell });
        }
        ++to;
      });
    if (strip.Slots.size() == strip.FirstSlots.back())
    {
      strip.Slots.push_back({}); // for the samples outside, whose weights are NaN
    }
    return inside;
  }

  /// Adds the triangles of a tile. Sets `groups`, four triangles each.
  template <typename Access>
  void addSlots(const Access& access, const std::vector<std::int32_t>& cells,
    std::vector<GroupLanes<Access>>& groups, Strip& strip) const
  {
    for (std::size_t slot = 0; slot < cells.size(); slot += laneCount)
    {
      std::int32_t four[laneCount];
      for (std::size_t lane = 0; lane < laneCount; ++lane)
      {
        four[lane] = cells[std::min(slot + lane, cells.size() - 1)];
      }
      GroupLanes<Access>& group = groups.emplace_back();
      group.set(access, four);
      for (std::size_t lane = 0; lane < std::min<std::size_t>(laneCount, cells.size() - slot);
           ++lane)
      {
        strip.Slots.push_back(
          { { std::int32_t(group.Ids[0][lane]), std::int32_t(group.Ids[1][lane]),
              std::int32_t(group.Ids[2][lane]) },
            four[lane] });
      }
    }
  }

  /// Calls work(sample, column, row) for all samples of a tile.
  template <typename Work>
  void forSamples(const TileBox& box, const Work& work) const
  {
    for (std::int64_t row = box.Row; row < box.Row + box.Rows; ++row)
    {
      for (std::int64_t column = box.Column; column < box.Column + box.Columns; ++column)
      {
        work(row * this->Kept.Width + column, int(column), int(row));
      }
    }
  }

  KeptSamples& Kept;
  const SimplexMesh& Mesh;
  const LatticeAxes& Axes;
  const Claims& Found;
};

KeptSamples::TileBox KeptSamples::boxOf(std::int64_t tile) const
{
  const std::int64_t row = tile / this->TilesAcross * TileRows;
  const std::int64_t column = tile % this->TilesAcross * TileColumns;
  return { row, column, std::min(TileRows, this->Height - row),
    std::min(TileColumns, this->Width - column) };
}

std::optional<KeptSamples> KeptSamples::find(
  const SimplexMesh& mesh, const Lattice& lattice, int threads, const Report& report)
{
  const LatticeAxes axes(mesh, lattice);
  const Claims claims = claimSamples(mesh, lattice, threads, partOf(report, 0, 0.8));
  if (claims.Aborted)
  {
    return std::nullopt;
  }
  KeptSamples kept;
  kept.Width = axes.U.size();
  kept.Height = axes.V.size();
  kept.TilesAcross = (kept.Width + TileColumns - 1) / TileColumns;
  kept.TilesDown = (kept.Height + TileRows - 1) / TileRows;
  kept.Strips.resize(std::size_t((kept.tileCount() + StripTiles - 1) / StripTiles));
  if (!Builder(kept, mesh, axes, claims).run(threads, partOf(report, 0.8, 1)))
  {
    return std::nullopt;
  }
  return kept;
}

std::size_t KeptSamples::bytes() const
{
  const auto size = [](const auto& values) { return values.capacity() * sizeof(values[0]); };
  std::size_t sum = 0;
  for (const Strip& strip : this->Strips)
  {
    sum += size(strip.FirstSlots) + size(strip.Slots) + size(strip.Samples);
  }
  return sum;
}

template <typename Work>
void KeptSamples::forSlots(const Work& work)
{
  for (Strip& strip : this->Strips)
  {
    for (Slot& slot : strip.Slots)
    {
      work(slot);
    }
  }
}

std::vector<std::int32_t> KeptSamples::keepPoints(std::int64_t count)
{
  IndexSet used(count);
  this->forSlots(
    [&used](const Slot& slot)
    {
      for (const std::int32_t point : slot.Points)
      {
        used.add(point);
      }
    });
  used.number();
  this->forSlots(
    [&used](Slot& slot)
    {
      for (std::int32_t& point : slot.Points)
      {
        point = std::int32_t(used.rank(point));
      }
    });
  return used.elements();
}

std::vector<std::int32_t> KeptSamples::keepCells(std::int64_t count)
{
  IndexSet used(count);
  this->forSlots([&used](const Slot& slot) { used.add(slot.Cell); });
  used.number();
  this->forSlots([&used](Slot& slot) { slot.Cell = std::int32_t(used.rank(slot.Cell)); });
  return used.elements();
}

void KeptSamples::renumberPoints(const std::vector<std::int32_t>& numbers)
{
  this->forSlots(
    [&numbers](Slot& slot)
    {
      for (std::int32_t& point : slot.Points)
      {
        point = numbers[std::size_t(point)];
      }
    });
}

template <typename Work>
void KeptSamples::forTiles(int threads, const Work& work) const
{
  forChunks(std::int64_t(this->Strips.size()), 1, threads, {},
    [&](std::int64_t index, std::int64_t, int)
    {
      const Strip& strip = this->Strips[std::size_t(index)];
      const KeptSample* samples = strip.Samples.data();
      for (std::size_t i = 0; i < strip.FirstSlots.size(); ++i)
      {
        const TileBox box = this->boxOf(index * StripTiles + std::int64_t(i));
        work(box, strip.Slots.data() + strip.FirstSlots[i], samples);
        samples += box.Rows * box.Columns;
      }
    });
}

template <typename Work>
void KeptSamples::forSamples(int threads, const Work& work) const
{
  this->forTiles(threads,
    [&](const TileBox& box, const Slot* slots, const KeptSample* kept)
    {
      for (std::int64_t row = box.Row; row < box.Row + box.Rows; ++row)
      {
        const std::int64_t first = row * this->Width + box.Column;
        for (std::int64_t i = first; i < first + box.Columns; ++i, ++kept)
        {
          work(slots[kept->Slot], *kept, i);
        }
      }
    });
}

void KeptSamples::fromPoints(const double* values, float* samples, int threads) const
{
  this->forSamples(threads,
    [values, samples](const Slot& slot, const KeptSample& kept, std::int64_t i)
    {
      const double first = values[slot.Points[0]];
      samples[i] = float(first + double(kept.Second) * (values[slot.Points[1]] - first) +
        double(kept.Third) * (values[slot.Points[2]] - first));
    });
}

void KeptSamples::pairFromPoints(
  const double* values, float* first, float* second, int threads) const
{
  this->forSamples(threads,
    [values, first, second](const Slot& slot, const KeptSample& kept, std::int64_t i)
    {
      TwoDoubles at[3];
      for (int k = 0; k < 3; ++k)
      {
        std::memcpy(&at[k], values + 2 * std::size_t(slot.Points[k]), sizeof at[k]);
      }
      const TwoDoubles sampled =
        at[0] + double(kept.Second) * (at[1] - at[0]) + double(kept.Third) * (at[2] - at[0]);
      first[i] = float(sampled[0]);
      second[i] = float(sampled[1]);
    });
}

void KeptSamples::fromCells(const double* values, float* samples, int threads) const
{
  this->forSamples(threads,
    [values, samples](const Slot& slot, const KeptSample& kept, std::int64_t i)
    { samples[i] = std::isnan(kept.Second) ? noValue : float(values[slot.Cell]); });
}

namespace
{

/// Gives dry corners the mean of the wet ones. Returns whether a triangle is partly dry.
bool fillDry(double (&value)[3])
{
  double sum = 0;
  int wet = 0;
  for (const double corner : value)
  {
    sum += std::isnan(corner) ? 0 : corner;
    wet += !std::isnan(corner);
  }
  for (double& corner : value)
  {
    corner = std::isnan(corner) && wet > 0 ? sum / wet : corner;
  }
  return wet == 1 || wet == 2;
}

} // namespace

void KeptSamples::waterLevel(
  const double* values, const float* ground, float* samples, int threads) const
{
  this->forSamples(threads,
    [values, ground, samples](const Slot& slot, const KeptSample& kept, std::int64_t i)
    {
      double value[3] = { values[slot.Points[0]], values[slot.Points[1]], values[slot.Points[2]] };
      const bool isPartlyDry = fillDry(value);
      const auto level = float(value[0] + double(kept.Second) * (value[1] - value[0]) +
        double(kept.Third) * (value[2] - value[0]));
      samples[i] = isPartlyDry && !(level > ground[i]) ? noValue : level;
    });
}

} // namespace tipp
