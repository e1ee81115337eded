// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSampleBlock_h
#define tippSampleBlock_h

#include "Arrays/Scalar.h"
#include "Parallel/Instructions.h"
#include "Resample/Attribute.h"
#include "Resample/CellLanes.h"
#include "Resample/Lanes.h"
#include "Resample/Lattice.h"
#include "Resample/SimplexMesh.h"

#include <algorithm>
#include <cstdint>
#include <type_traits>
#include <vector>

namespace tipp
{

/// A buffer of samples that cells claim: in runs along the first axis, grouped by cell.
///
/// Most cells have few samples, and branch prediction cannot foresee how many. So samples are
/// collected first, and the expensive work is done in loops over many cells, runs or samples.
template <typename Access>
class SampleBlock
{
public:
  static constexpr int D = Access::Dimension;
  static constexpr int Capacity = 512;

  SampleBlock(const SimplexMesh& mesh, const LatticeAxes& axes)
    : Cells(mesh)
    , Axes(axes)
    , Indices(Capacity + Stride)
    , Offsets(Capacity + Stride)
    , RunOfSamples(Capacity + Stride)
    , Runs(Capacity + 1)
    , RunOffsets(Capacity)
    , GroupCells(Capacity + laneCount)
    , Groups(Capacity / laneCount + 1)
  {
  }

  int room() const { return Capacity - this->Size; }

  void clear()
  {
    this->Size = 0;
    this->RunCount = 0;
    this->LastGroup = -1;
    this->LastCell = -1;
  }

  /// Adds `count` samples of a row, at most room(); does nothing if count <= 0.
  [[gnu::always_inline]] void add(std::int32_t cell, const SampleRow& row, int begin, int count)
  {
    const int group = this->LastGroup + int(cell != this->LastCell);
    const bool any = count > 0;
    this->GroupCells[std::size_t(group)] = cell;
    this->Runs[std::size_t(this->RunCount)] = { row.Row, row.Layer, group };
    // Always writes a whole stride; the surplus is overwritten by the next call.
    for (int i = 0; i < Stride; ++i)
    {
      this->write(i, row.First + begin, this->Axes.U.data() + begin);
    }
    for (int i = Stride; i < count; ++i)
    {
      this->write(i, row.First + begin, this->Axes.U.data() + begin);
    }
    this->LastGroup = any ? group : this->LastGroup;
    this->LastCell = any ? cell : this->LastCell;
    this->RunCount += int(any);
    this->Size += any ? count : 0;
  }

  /// Computes the groups' corners, the gradients of their weights, and the samples' offsets.
  void weigh()
  {
    runWith(Instructions::Best, [this] { this->weighAll(); });
  }

  int size() const { return this->Size; }
  /// The index of each sample in the lattice.
  const std::int64_t* indices() const { return this->Indices.data(); }
  const std::int32_t* runsOfSamples() const { return this->RunOfSamples.data(); }
  int groupOf(int j) const { return this->groupOfRun(this->RunOfSamples[std::size_t(j)]); }
  std::int32_t cellOf(int j) const { return this->GroupCells[std::size_t(this->groupOf(j))]; }

  int runs() const { return this->RunCount; }
  int groupOfRun(int run) const { return this->Runs[std::size_t(run)].Group; }

  int groups() const { return this->LastGroup + 1; }

  /// Groups 4 * i to 4 * i + 3. Valid, like all that follows, after weigh().
  const GroupLanes<Access>& groupLanes(int i) const { return this->Groups[std::size_t(i)]; }
  /// The point index of a corner; corners are in lexicographic order of their coordinates.
  std::int64_t cornerId(int group, int corner) const
  {
    return this->groupLanes(group / laneCount).Ids[corner][group % laneCount];
  }

  /// The offset of each sample from its cell's first corner along the first axis.
  const double* offsets() const { return this->Offsets.data(); }
  /// The offset of a run's samples along the other axes.
  const double (&runOffset(int run) const)[D - 1]
  {
    return this->RunOffsets[std::size_t(run)].Along;
  }

  /// The weights of all corners but the first at sample j.
  void weightsOf(int j, double (&weights)[D]) const
  {
    const int group = this->groupOf(j);
    const GroupLanes<Access>& lanes = this->groupLanes(group / laneCount);
    const int lane = group % laneCount;
    double offset[D] = { this->Offsets[std::size_t(j)] };
    std::copy_n(this->runOffset(this->RunOfSamples[std::size_t(j)]), D - 1, offset + 1);
    if (lanes.Thin[lane] != 0)
    {
      double edges[D][D];
      for (int i = 0; i < D; ++i)
      {
        for (int axis = 0; axis < D; ++axis)
        {
          edges[i][axis] = lanes.Corners[i + 1][axis][lane] - lanes.Corners[0][axis][lane];
        }
      }
      thinWeights(edges, offset, weights);
      return;
    }
    for (int i = 0; i < D; ++i)
    {
      double rest = 0;
      for (int axis = 1; axis < D; ++axis)
      {
        rest += lanes.Normals[i][axis][lane] * offset[axis];
      }
      weights[i] = lanes.Normals[i][0][lane] * offset[0] + rest;
    }
  }

private:
  /// Samples that add() writes at a time; LatticeAxis::data() is padded by as many.
  static constexpr int Stride = 4;

  struct SampleRun
  {
    std::int32_t Row;
    std::int32_t Layer;
    std::int32_t Group;
  };

  struct RunOffset
  {
    double First; ///< coordinate of the first corner along the first axis
    double Along[D - 1];
  };

  [[gnu::always_inline]] void write(int i, std::int64_t index, const double* coordinates)
  {
    const std::size_t j = std::size_t(this->Size) + std::size_t(i);
    this->Indices[j] = index + i;
    this->Offsets[j] = coordinates[i];
    this->RunOfSamples[j] = this->RunCount;
  }

  [[gnu::always_inline]] void weighAll()
  {
    const int groups = this->groups();
    // Unused lanes repeat the last group.
    for (int i = groups; i % laneCount != 0; ++i)
    {
      this->GroupCells[std::size_t(i)] = this->GroupCells[std::size_t(groups - 1)];
    }
    for (int i = 0; i < groups; i += laneCount)
    {
      this->Groups[std::size_t(i / laneCount)].set(this->Cells, this->GroupCells.data() + i);
    }
    for (int run = 0; run < this->RunCount; ++run)
    {
      const SampleRun& of = this->Runs[std::size_t(run)];
      const auto& origin = this->groupLanes(of.Group / laneCount).Corners[0];
      const int lane = of.Group % laneCount;
      RunOffset& offset = this->RunOffsets[std::size_t(run)];
      offset.First = origin[0][lane];
      offset.Along[0] = this->Axes.V[of.Row] - origin[1][lane];
      if constexpr (D == 3)
      {
        offset.Along[1] = this->Axes.W[of.Layer] - origin[2][lane];
      }
    }
    for (int j = 0; j < this->Size; ++j)
    {
      this->Offsets[std::size_t(j)] -=
        this->RunOffsets[std::size_t(this->RunOfSamples[std::size_t(j)])].First;
    }
  }

  Access Cells;
  const LatticeAxes& Axes;
  int Size = 0;
  int RunCount = 0;
  int LastGroup = -1;
  std::int32_t LastCell = -1;
  std::vector<std::int64_t> Indices;
  std::vector<double> Offsets; ///< the samples' coordinates before weigh()
  std::vector<std::int32_t> RunOfSamples;
  std::vector<SampleRun> Runs;
  std::vector<RunOffset> RunOffsets;
  std::vector<std::int32_t> GroupCells;
  std::vector<GroupLanes<Access>> Groups; ///< four each
};

/// Fills one attribute's samples of a block.
template <typename Access, typename T>
class BlockFiller
{
public:
  using Block = SampleBlock<Access>;
  static constexpr int D = Access::Dimension;

  BlockFiller(const Attribute& attribute, const Block& block)
    : Values(static_cast<const T*>(attribute.Values))
    , Samples(static_cast<T*>(attribute.Samples))
    , Components(attribute.Components)
    , Weighed(block)
  {
  }

  void fromPoints()
  {
    if constexpr (std::is_floating_point_v<T>)
    {
      for (int component = 0; component < this->Components; ++component)
      {
        runWith(Instructions::Best, [&] { this->interpolate(component); });
      }
    }
    else
    {
      this->takeNearest();
    }
  }

  void fromCells(const std::int64_t* parents)
  {
    for (int j = 0; j < this->Weighed.size(); ++j)
    {
      const std::int32_t simplex = this->Weighed.cellOf(j);
      this->take(j, this->Values + (parents ? parents[simplex] : simplex) * this->Components);
    }
  }

private:
  /// The values of four groups at their first corners, and their gradients.
  struct alignas(32) Gradients
  {
    Lanes First;
    Lanes Rise[D];
  };

  /// A run's values as a linear function of the first coordinate, relative to the cell's first
  /// corner.
  struct Line
  {
    double First;
    double Rise;
  };

  /// An ordinary store; but cells that overlap may be in two threads at once.
  static void store(T* to, T value) { __atomic_store(to, &value, __ATOMIC_RELAXED); }

  T* sample(int j) const { return this->Samples + this->Weighed.indices()[j] * this->Components; }

  void take(int j, const T* from)
  {
    for (int component = 0; component < this->Components; ++component)
    {
      store(this->sample(j) + component, from[component]);
    }
  }

  [[gnu::always_inline]] void interpolate(int component)
  {
    Gradients gradients[Block::Capacity / laneCount + 1];
    Line lines[Block::Capacity];
    const LaneMask useful = this->findGradients(component, gradients);
    for (int run = 0; run < this->Weighed.runs(); ++run)
    {
      const int group = this->Weighed.groupOfRun(run);
      const Gradients& gradient = gradients[group / laneCount];
      const int lane = group % laneCount;
      const auto& offset = this->Weighed.runOffset(run);
      double sum = gradient.Rise[1][lane] * offset[0];
      if constexpr (D == 3)
      {
        sum += gradient.Rise[2][lane] * offset[1];
      }
      lines[run] = { gradient.First[lane] + sum, gradient.Rise[0][lane] };
    }
    // Local copies of the pointers: otherwise the compiler reloads them after each store.
    const std::int64_t* const indices = this->Weighed.indices();
    const std::int32_t* const runs = this->Weighed.runsOfSamples();
    const double* const offsets = this->Weighed.offsets();
    T* const samples = this->Samples + component;
    const std::int64_t components = this->Components;
    const int size = this->Weighed.size();
    for (int j = 0; j < size; ++j)
    {
      const Line& line = lines[runs[j]];
      store(samples + indices[j] * components, T(line.First + line.Rise * offsets[j]));
    }
    if (any(~useful))
    {
      this->interpolateByWeights(component, gradients);
    }
  }

  /// Computes the gradients of all groups; returns where they may be used.
  [[gnu::always_inline]] LaneMask findGradients(int component, Gradients* gradients) const
  {
    constexpr int ahead = 8;
    const int count = (this->Weighed.groups() + laneCount - 1) / laneCount;
    LaneMask useful = LaneMask{} - 1;
    for (int i = 0; i < count; ++i)
    {
      if (i % ahead == 0)
      {
        this->prefetch(i == 0 ? 0 : i + ahead, std::min(i + 2 * ahead, count));
      }
      const GroupLanes<Access>& group = this->Weighed.groupLanes(i);
      Gradients& gradient = gradients[i];
      gradient.First = this->valuesAt(group.Ids[0], component);
      for (int corner = 0; corner < D; ++corner)
      {
        const Lanes rise = this->valuesAt(group.Ids[corner + 1], component) - gradient.First;
        for (int axis = 0; axis < D; ++axis)
        {
          const Lanes part = group.Normals[corner][axis] * rise;
          gradient.Rise[axis] = corner == 0 ? part : gradient.Rise[axis] + part;
        }
      }
      useful &= isUseful(group, gradient);
    }
    return useful;
  }

  /// Where gradients may be used: not in thin cells, and not if they are infinite or NaN, since the
  /// samples may be finite.
  [[gnu::always_inline]] static LaneMask isUseful(
    const GroupLanes<Access>& group, const Gradients& gradient)
  {
    Lanes sum = gradient.Rise[0] - gradient.Rise[0];
    for (int axis = 1; axis < D; ++axis)
    {
      sum += gradient.Rise[axis] - gradient.Rise[axis];
    }
    return ~group.Thin & (sum == 0);
  }

  [[gnu::always_inline]] Lanes valuesAt(LaneMask ids, int component) const
  {
    const T* const values = this->Values + component;
    const std::int64_t components = this->Components;
    return Lanes{ double(values[ids[0] * components]), double(values[ids[1] * components]),
      double(values[ids[2] * components]), double(values[ids[3] * components]) };
  }

  [[gnu::always_inline]] void prefetch(int begin, int end) const
  {
    for (int i = begin; i < end; ++i)
    {
      for (const LaneMask& ids : this->Weighed.groupLanes(i).Ids)
      {
        for (int lane = 0; lane < laneCount; ++lane)
        {
          __builtin_prefetch(this->Values + ids[lane] * this->Components);
        }
      }
    }
  }

  /// Recomputes the samples of groups whose gradients cannot be used.
  [[gnu::noinline]] void interpolateByWeights(int component, const Gradients* gradients)
  {
    for (int j = 0; j < this->Weighed.size(); ++j)
    {
      const int group = this->Weighed.groupOf(j);
      const LaneMask useful =
        isUseful(this->Weighed.groupLanes(group / laneCount), gradients[group / laneCount]);
      if (useful[group % laneCount] != 0)
      {
        continue;
      }
      double weights[D];
      this->Weighed.weightsOf(j, weights);
      const auto value = [&](int corner)
      {
        const std::int64_t id = this->Weighed.cornerId(group, corner);
        return double(this->Values[id * this->Components + component]);
      };
      const double first = value(0);
      double sum = weights[0] * (value(1) - first);
      for (int i = 1; i < D; ++i)
      {
        sum += weights[i] * (value(i + 1) - first);
      }
      store(this->sample(j) + component, T(first + sum));
    }
  }

  void takeNearest()
  {
    for (int j = 0; j < this->Weighed.size(); ++j)
    {
      double weights[D];
      this->Weighed.weightsOf(j, weights);
      double rest = 1;
      for (int i = 0; i < D; ++i)
      {
        rest -= weights[i];
      }
      int nearest = 0;
      for (int i = 0; i < D; ++i)
      {
        if (weights[i] > rest)
        {
          rest = weights[i];
          nearest = i + 1;
        }
      }
      const std::int64_t id = this->Weighed.cornerId(this->Weighed.groupOf(j), nearest);
      this->take(j, this->Values + id * this->Components);
    }
  }

  const T* Values;
  T* Samples;
  int Components;
  const Block& Weighed;
};

/// Fills the samples of a block. `parents` is ResampleOptions::Parents.
template <typename Access>
void fillBlock(
  SampleBlock<Access>& block, const std::vector<Attribute>& attributes, const std::int64_t* parents)
{
  const auto needsWeights = [](const Attribute& attribute)
  { return attribute.Values && !attribute.OfCells; };
  if (std::any_of(attributes.begin(), attributes.end(), needsWeights))
  {
    block.weigh();
  }
  for (const Attribute& attribute : attributes)
  {
    if (!attribute.Values)
    {
      continue;
    }
    withScalar(attribute.Type,
      [&](auto type)
      {
        BlockFiller<Access, decltype(type)> filler(attribute, block);
        attribute.OfCells ? filler.fromCells(parents) : filler.fromPoints();
      });
  }
}

} // namespace tipp

#endif
