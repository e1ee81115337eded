// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippFillBlock_h
#define tippFillBlock_h

#include "Arrays/Scalar.h"
#include "Resample/Interpolate.h"
#include "Resample/SampleBlock.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace tipp
{

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
        hasAvx2() ? this->interpolateAvx2(component) : this->interpolate(component);
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

#ifdef __x86_64__
  [[gnu::target("avx2")]]
#endif
  void
  interpolateAvx2(int component)
  {
    this->interpolate(component);
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

/// Fills the samples of a block. `parents` is InterpolationOptions::Parents.
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

/// Writes the null value to the samples in [first, end) for which wanted(sample) is true.
template <typename Wanted>
void fillNull(
  const Attribute& attribute, std::int64_t first, std::int64_t end, const Wanted& wanted)
{
  withScalar(attribute.Type,
    [&](auto type)
    {
      using T = decltype(type);
      const T null = toScalar<T>(attribute.NullValue);
      const int components = attribute.Components;
      T* const samples = static_cast<T*>(attribute.Samples);
      for (std::int64_t i = first; i < end; ++i)
      {
        if (wanted(i))
        {
          std::fill(samples + i * components, samples + (i + 1) * components, null);
        }
      }
    });
}

} // namespace tipp

#endif
