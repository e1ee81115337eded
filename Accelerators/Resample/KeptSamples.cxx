// SPDX-License-Identifier: BSD-3-Clause
#include "Resample/KeptSamples.h"

#include "Parallel/Instructions.h"
#include "Resample/ClaimSamples.h"
#include "Resample/Lanes.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <type_traits>

namespace tipp
{

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
    std::vector<SlotMap> maps{ std::size_t(threads) };
    std::atomic<std::int64_t> inside{ 0 };
    bool completed = false;
    withAccess(this->Mesh,
      [&](const auto& access)
      {
        if constexpr (std::decay_t<decltype(access)>::Dimension == 2)
        {
          completed = forChunks(std::int64_t(this->Kept.Strips.size()), 1, threads, report,
            [&](std::int64_t strip, std::int64_t, int thread)
            { inside += this->fillStrip(access, strip, maps[std::size_t(thread)]); });
        }
      });
    this->Kept.Inside = inside;
    return completed;
  }

private:
  /// Gives the triangles of a tile their slots: a hash table that is emptied in no time.
  class SlotMap
  {
  public:
    void clear()
    {
      ++this->Round;
      this->Cells.clear();
    }

    int slotOf(std::int32_t cell)
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
          return entry.Slot;
        }
      }
    }

    /// The triangles in the order of their slots.
    const std::vector<std::int32_t>& cells() const { return this->Cells; }

  private:
    struct Entry
    {
      std::int64_t Round = 0;
      std::int32_t Cell = 0;
      std::int32_t Slot = 0;
    };
    static constexpr std::uint32_t Shift = 32 - 12;
    static constexpr std::uint32_t Size = 1 << 12; // four times the samples of a tile

    std::int64_t Round = 0;
    std::vector<Entry> Entries = std::vector<Entry>(Size);
    std::vector<std::int32_t> Cells;
  };

  /// Returns the number of samples in triangles.
  template <typename Access>
  std::int64_t fillStrip(const Access& access, std::int64_t index, SlotMap& map)
  {
    Strip& strip = this->Kept.Strips[std::size_t(index)];
    std::int64_t inside = 0;
    const std::int64_t last = std::min((index + 1) * StripTiles, this->Kept.tileCount());
    for (std::int64_t tile = index * StripTiles; tile < last; ++tile)
    {
      inside += this->addTile(access, this->Kept.boxOf(tile), strip, map);
    }
    strip.Special.shrink_to_fit();
    strip.Numbers.shrink_to_fit();
    strip.Ids.shrink_to_fit();
    std::sort(strip.Special.begin(), strip.Special.end(),
      [](const Weighted& a, const Weighted& b) { return a.Sample < b.Sample; });
    return inside;
  }

  /// The claim of the mesh's border that has a sample; null if there is none.
  const NearSample* nearAt(std::int64_t sample) const
  {
    const auto found = std::lower_bound(this->Found.Near.begin(), this->Found.Near.end(), sample,
      [](const NearSample& near, std::int64_t at) { return near.Sample < at; });
    return found != this->Found.Near.end() && found->Sample == sample ? &*found : nullptr;
  }

  template <typename Access>
  std::int64_t addTile(const Access& access, const TileBox& box, Strip& strip, SlotMap& map)
  {
    map.clear();
    constexpr std::uint16_t outside = 0xFFFF;
    const std::size_t first = strip.SlotOfSample.size();
    std::int64_t inside = 0;
    for (std::int64_t row = box.Row; row < box.Row + box.Rows; ++row)
    {
      const std::int64_t start = row * this->Kept.Width + box.Column;
      for (std::int64_t sample = start; sample < start + box.Columns; ++sample)
      {
        const std::int32_t cell = this->Found.Cells[std::size_t(sample)];
        strip.SlotOfSample.push_back(cell < 0 ? outside : std::uint16_t(map.slotOf(cell)));
        inside += cell >= 0;
      }
    }
    const auto triangles = std::int32_t(map.cells().size());
    const Tile tile{ triangles, (triangles + laneCount) / laneCount * laneCount,
      strip.Numbers.size(), strip.Ids.size() };
    std::vector<unsigned char> thin;
    this->addSlots(access, map.cells(), tile, strip, thin);
    this->addSpecial(access, box, map.cells(), thin, first, strip);
    std::replace(strip.SlotOfSample.begin() + std::ptrdiff_t(first), strip.SlotOfSample.end(),
      outside, std::uint16_t(triangles));
    strip.Tiles.push_back(tile);
    return inside;
  }

  /// Sets `thin` for the slots whose samples need weights.
  template <typename Access>
  void addSlots(const Access& access, const std::vector<std::int32_t>& cells, const Tile& tile,
    Strip& strip, std::vector<unsigned char>& thin)
  {
    const auto slots = std::size_t(tile.Slots);
    strip.Numbers.resize(tile.FirstNumber + 6 * slots);
    strip.Ids.resize(tile.FirstId + 4 * slots);
    thin.resize(slots);
    double* const numbers = strip.Numbers.data() + tile.FirstNumber;
    std::int32_t* const ids = strip.Ids.data() + tile.FirstId;
    for (std::size_t slot = 0; slot < cells.size(); slot += laneCount)
    {
      std::int32_t four[laneCount];
      for (std::size_t lane = 0; lane < laneCount; ++lane)
      {
        four[lane] = cells[std::min(slot + lane, cells.size() - 1)];
      }
      GroupLanes<Access> group;
      group.set(access, four);
      for (std::size_t lane = 0; lane < laneCount; ++lane)
      {
        const std::size_t at = slot + lane;
        for (std::size_t i = 0; i < 2; ++i)
        {
          numbers[(2 * i) * slots + at] = group.Normals[i][0][lane];
          numbers[(2 * i + 1) * slots + at] = group.Normals[i][1][lane];
          numbers[(4 + i) * slots + at] = group.Corners[0][i][lane];
        }
        for (std::size_t corner = 0; corner < 3; ++corner)
        {
          ids[corner * slots + at] = std::int32_t(group.Ids[corner][lane]);
        }
        ids[3 * slots + at] = four[lane];
        thin[at] = group.Thin[lane] != 0;
      }
    }
  }

  /// Adds the samples of thin triangles, and those near the mesh's border.
  template <typename Access>
  void addSpecial(const Access& access, const TileBox& box, const std::vector<std::int32_t>& cells,
    const std::vector<unsigned char>& thin, std::size_t first, Strip& strip)
  {
    for (std::int64_t i = 0; i < box.Rows * box.Columns; ++i)
    {
      const std::size_t slot = strip.SlotOfSample[first + std::size_t(i)];
      if (slot >= cells.size())
      {
        continue;
      }
      const std::int64_t row = box.Row + i / box.Columns;
      const std::int64_t column = box.Column + i % box.Columns;
      const std::int64_t sample = row * this->Kept.Width + column;
      if (const NearSample* const near = this->nearAt(sample))
      {
        const auto begin = std::int32_t(near->Ids[0]);
        strip.Special.push_back({ sample, { begin, std::int32_t(near->Ids[1]), begin }, near->Cell,
          { near->Weight, 0 } });
      }
      else if (thin[slot] != 0)
      {
        strip.Special.push_back(this->weighted(access, cells[slot], row, column));
      }
    }
  }

  template <typename Access>
  Weighted weighted(
    const Access& access, std::int32_t cell, std::int64_t row, std::int64_t column) const
  {
    const std::int32_t four[laneCount] = { cell, cell, cell, cell };
    GroupLanes<Access> group;
    group.set(access, four);
    double edges[2][2];
    for (int i = 0; i < 2; ++i)
    {
      for (int axis = 0; axis < 2; ++axis)
      {
        edges[i][axis] = group.Corners[i + 1][axis][0] - group.Corners[0][axis][0];
      }
    }
    const double offset[2] = { this->Axes.U[int(column)] - group.Corners[0][0][0],
      this->Axes.V[int(row)] - group.Corners[0][1][0] };
    Weighted weighted{ row * this->Kept.Width + column, {}, cell, {} };
    thinWeights(edges, offset, weighted.Weights);
    for (int corner = 0; corner < 3; ++corner)
    {
      weighted.Ids[corner] = std::int32_t(group.Ids[corner][0]);
    }
    return weighted;
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
  kept.U.assign(axes.U.data(), axes.U.data() + kept.Width);
  kept.V.assign(axes.V.data(), axes.V.data() + kept.Height);
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
  std::size_t sum = size(this->U) + size(this->V);
  for (const Strip& strip : this->Strips)
  {
    sum += size(strip.Tiles) + size(strip.SlotOfSample) + size(strip.Numbers) + size(strip.Ids) +
      size(strip.Special);
  }
  return sum;
}

/// Interpolates one field.
template <typename Value, typename Sample>
class KeptSamples::Evaluation
{
public:
  Evaluation(const KeptSamples& kept, const Value* values, Sample* samples, Sample null, int stride)
    : Kept(kept)
    , Values(values)
    , Samples(samples)
    , Null(null)
    , Stride(stride)
  {
  }

  /// The ground at the samples, for waterLevel().
  const Sample* Ground = nullptr;

  /// Calls work(tile, box, strip, slots), where `slots` are the tile's SlotOfSample, for all tiles,
  /// and then special(sample) for all special samples.
  template <typename Work, typename Special>
  void forTiles(int threads, const Work& work, const Special& special) const
  {
    forChunks(std::int64_t(this->Kept.Strips.size()), 1, threads, {},
      [&](std::int64_t index, std::int64_t, int)
      {
        const Strip& strip = this->Kept.Strips[std::size_t(index)];
        const std::uint16_t* slots = strip.SlotOfSample.data();
        for (std::size_t i = 0; i < strip.Tiles.size(); ++i)
        {
          const TileBox box = this->Kept.boxOf(index * StripTiles + std::int64_t(i));
          work(strip.Tiles[i], box, strip, slots);
          slots += box.Rows * box.Columns;
        }
        for (const Weighted& weighted : strip.Special)
        {
          special(weighted);
        }
      });
  }

  void interpolate(int threads) const
  {
    this->forTiles(
      threads,
      [this](const Tile& tile, const TileBox& box, const Strip& strip, const std::uint16_t* slots)
      { runWith(Instructions::Best, [&] { this->interpolateTile(tile, box, strip, slots); }); },
      [this](const Weighted& weighted) { this->interpolateWeighted(weighted); });
  }

  void take(int threads) const
  {
    this->forTiles(
      threads,
      [this](const Tile& tile, const TileBox& box, const Strip& strip, const std::uint16_t* slots)
      {
        const std::int32_t* const cells = strip.Ids.data() + tile.FirstId + 3 * tile.Slots;
        this->forSamples(box,
          [&](std::int64_t i, std::int64_t sample)
          {
            const int slot = slots[i];
            this->Samples[sample * this->Stride] = slot < tile.Triangles
              ? Sample(this->Values[std::int64_t(cells[slot]) * this->Stride])
              : this->Null;
          });
      },
      [this](const Weighted& weighted)
      {
        this->Samples[weighted.Sample * this->Stride] =
          Sample(this->Values[std::int64_t(weighted.Cell) * this->Stride]);
      });
  }

private:
  /// The most slots of a tile: one per sample, one for samples outside, and the rest of a group.
  static constexpr std::size_t MostSlots = TileRows * TileColumns + laneCount;

  /// The field as linear functions in the slots' triangles.
  struct Gradients
  {
    double First[MostSlots]; ///< the value at the first corner
    double AlongU[MostSlots];
    double AlongV[MostSlots];
    bool PartlyDry[MostSlots]; ///< only with Ground
  };

  /// Calls work(i, sample) for all samples of a tile; i counts them.
  template <typename Work>
  void forSamples(const TileBox& box, const Work& work) const
  {
    std::int64_t i = 0;
    for (std::int64_t row = box.Row; row < box.Row + box.Rows; ++row)
    {
      const std::int64_t first = row * this->Kept.Width + box.Column;
      for (std::int64_t sample = first; sample < first + box.Columns; ++sample, ++i)
      {
        work(i, sample);
      }
    }
  }

  double valueAt(std::int32_t id) const
  {
    return double(this->Values[std::int64_t(id) * this->Stride]);
  }

  [[gnu::always_inline]] void interpolateTile(
    const Tile& tile, const TileBox& box, const Strip& strip, const std::uint16_t* slots) const
  {
    alignas(32) Gradients gradients;
    const double* const numbers = strip.Numbers.data() + tile.FirstNumber;
    const std::int32_t* const ids = strip.Ids.data() + tile.FirstId;
    const bool isWet = this->findGradients(tile, numbers, ids, gradients);
    const double* const firstU = numbers + 4 * tile.Slots;
    const double* const firstV = numbers + 5 * tile.Slots;
    for (std::int64_t row = 0; row < box.Rows; ++row)
    {
      const double v = this->Kept.V[std::size_t(box.Row + row)];
      const double* const u = this->Kept.U.data() + box.Column;
      const std::uint16_t* const of = slots + row * box.Columns;
      Sample* const samples =
        this->Samples + ((box.Row + row) * this->Kept.Width + box.Column) * this->Stride;
      for (std::int64_t i = 0; i < box.Columns; ++i)
      {
        const int slot = of[i];
        const double onRow = gradients.First[slot] + gradients.AlongV[slot] * (v - firstV[slot]);
        samples[i * this->Stride] = Sample(onRow + gradients.AlongU[slot] * (u[i] - firstU[slot]));
      }
    }
    if (this->Ground && !isWet)
    {
      this->forSamples(box,
        [&](std::int64_t i, std::int64_t sample)
        { this->dryAbove(sample, gradients.PartlyDry[slots[i]]); });
    }
  }

  /// Makes a sample dry where the water is not above the ground.
  void dryAbove(std::int64_t sample, bool isPartlyDry) const
  {
    Sample& level = this->Samples[sample];
    level = isPartlyDry && !(level > this->Ground[sample]) ? Sample(NAN) : level;
  }

  /// Returns whether no triangle is partly dry.
  [[gnu::always_inline]] bool findGradients(
    const Tile& tile, const double* numbers, const std::int32_t* ids, Gradients& gradients) const
  {
    const int slots = tile.Slots;
    bool isWet = true;
    for (int slot = 0; slot < slots; ++slot)
    {
      double value[3] = { this->valueAt(ids[slot]), this->valueAt(ids[slots + slot]),
        this->valueAt(ids[2 * slots + slot]) };
      if (this->Ground)
      {
        gradients.PartlyDry[slot] = fillDry(value);
        isWet &= !gradients.PartlyDry[slot];
      }
      const double second = value[1] - value[0];
      const double third = value[2] - value[0];
      gradients.First[slot] = value[0];
      gradients.AlongU[slot] = numbers[slot] * second + numbers[2 * slots + slot] * third;
      gradients.AlongV[slot] = numbers[slots + slot] * second + numbers[3 * slots + slot] * third;
    }
    for (int slot = tile.Triangles; slot < slots; ++slot)
    {
      gradients.First[slot] = double(this->Null);
      gradients.AlongU[slot] = 0;
      gradients.AlongV[slot] = 0;
      gradients.PartlyDry[slot] = false;
    }
    return isWet;
  }

  /// Gives dry corners the mean of the wet ones. Returns whether a triangle is partly dry.
  static bool fillDry(double (&value)[3])
  {
    double sum = 0;
    int wet = 0;
    for (const double corner : value)
    {
      sum += std::isnan(corner) ? 0 : corner;
      wet += !std::isnan(corner);
    }
    if (wet == 3 || wet == 0)
    {
      return false;
    }
    for (double& corner : value)
    {
      corner = std::isnan(corner) ? sum / wet : corner;
    }
    return true;
  }

  void interpolateWeighted(const Weighted& weighted) const
  {
    double value[3] = { this->valueAt(weighted.Ids[0]), this->valueAt(weighted.Ids[1]),
      this->valueAt(weighted.Ids[2]) };
    const bool isPartlyDry = this->Ground && fillDry(value);
    double sum = weighted.Weights[0] * (value[1] - value[0]);
    sum += weighted.Weights[1] * (value[2] - value[0]);
    this->Samples[weighted.Sample * this->Stride] = Sample(value[0] + sum);
    if (this->Ground)
    {
      this->dryAbove(weighted.Sample, isPartlyDry);
    }
  }

  const KeptSamples& Kept;
  const Value* const Values;
  Sample* const Samples;
  const Sample Null;
  const std::int64_t Stride;
};

template <typename Value, typename Sample>
void KeptSamples::fromPoints(
  const Value* values, Sample* samples, Sample null, int threads, int stride) const
{
  Evaluation<Value, Sample>(*this, values, samples, null, stride).interpolate(threads);
}

template <typename Value, typename Sample>
void KeptSamples::fromCells(
  const Value* values, Sample* samples, Sample null, int threads, int stride) const
{
  Evaluation<Value, Sample>(*this, values, samples, null, stride).take(threads);
}

template <typename Value, typename Sample>
void KeptSamples::waterLevel(
  const Value* values, const Sample* ground, Sample* samples, Sample null, int threads) const
{
  Evaluation<Value, Sample> evaluation(*this, values, samples, null, 1);
  evaluation.Ground = ground;
  evaluation.interpolate(threads);
}

#define TIPP_INSTANTIATE(Value, Sample)                                                            \
  template void KeptSamples::fromPoints(const Value*, Sample*, Sample, int, int) const;            \
  template void KeptSamples::fromCells(const Value*, Sample*, Sample, int, int) const;             \
  template void KeptSamples::waterLevel(const Value*, const Sample*, Sample*, Sample, int) const;
TIPP_INSTANTIATE(float, float)
TIPP_INSTANTIATE(double, float)
TIPP_INSTANTIATE(double, double)
#undef TIPP_INSTANTIATE

} // namespace tipp
