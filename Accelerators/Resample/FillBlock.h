// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippFillBlock_h
#define tippFillBlock_h

#include "Resample/Interpolate.h"
#include "Resample/SampleBlock.h"
#include "Resample/ToScalar.h"

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
  using Group = typename Block::Group;
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
        this->interpolate(component);
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
      const std::int32_t simplex = this->Weighed.group(this->Weighed[j].Group).Cell;
      this->take(j, this->Values + (parents ? parents[simplex] : simplex) * this->Components);
    }
  }

private:
  /// An ordinary store; but cells that overlap may be in two threads at once.
  static void store(T* to, T value) { __atomic_store(to, &value, __ATOMIC_RELAXED); }

  T* sample(int j) const { return this->Samples + this->Weighed[j].Place * this->Components; }

  void take(int j, const T* from)
  {
    for (int component = 0; component < this->Components; ++component)
    {
      store(this->sample(j) + component, from[component]);
    }
  }

  void interpolate(int component)
  {
    double gradients[Block::Capacity][D + 1];
    this->findGradients(component, gradients);
    for (int j = 0; j < this->Weighed.size(); ++j)
    {
      const double(&gradient)[D + 1] = gradients[this->Weighed[j].Group];
      double sum = this->Weighed.weights(0)[j] * gradient[1];
      for (int i = 1; i < D; ++i)
      {
        sum += this->Weighed.weights(i)[j] * gradient[i + 1];
      }
      store(this->sample(j) + component, T(gradient[0] + sum));
    }
  }

  /// Of each group: the first corner's value, and by how much the others' are more.
  void findGradients(int component, double (*gradients)[D + 1]) const
  {
    constexpr int ahead = 32;
    const int groups = this->Weighed.groups();
    for (int i = 0; i < groups; ++i)
    {
      if (i % ahead == 0)
      {
        this->prefetch(i == 0 ? 0 : i + ahead, std::min(i + 2 * ahead, groups));
      }
      const Group& group = this->Weighed.group(i);
      const T* const values = this->Values + component;
      gradients[i][0] = double(values[group.Corners[0] * this->Components]);
      for (int corner = 1; corner <= D; ++corner)
      {
        gradients[i][corner] =
          double(values[group.Corners[corner] * this->Components]) - gradients[i][0];
      }
    }
  }

  void prefetch(int begin, int end) const
  {
    for (int i = begin; i < end; ++i)
    {
      for (const std::int64_t id : this->Weighed.group(i).Corners)
      {
        __builtin_prefetch(this->Values + id * this->Components);
      }
    }
  }

  void takeNearest()
  {
    for (int j = 0; j < this->Weighed.size(); ++j)
    {
      double rest = 1;
      for (int i = 0; i < D; ++i)
      {
        rest -= this->Weighed.weights(i)[j];
      }
      int nearest = 0;
      for (int i = 0; i < D; ++i)
      {
        if (this->Weighed.weights(i)[j] > rest)
        {
          rest = this->Weighed.weights(i)[j];
          nearest = i + 1;
        }
      }
      const std::int64_t id = this->Weighed.group(this->Weighed[j].Group).Corners[nearest];
      this->take(j, this->Values + id * this->Components);
    }
  }

  const T* Values;
  T* Samples;
  int Components;
  const Block& Weighed;
};

/// Whether there is something left to sample.
inline bool isSampled(const Attribute& attribute, const InterpolationOptions& options)
{
  return attribute.Values && !(options.SkipInterpolated && isInterpolated(attribute));
}

/// Whether samples need weights.
inline bool needsWeights(
  const std::vector<Attribute>& attributes, const InterpolationOptions& options)
{
  return std::any_of(attributes.begin(), attributes.end(),
    [&](const Attribute& attribute)
    { return isSampled(attribute, options) && !attribute.OfCells; });
}

/// Fills the samples of a block.
template <typename Access>
void fillBlock(SampleBlock<Access>& block, bool weighs, const std::vector<Attribute>& attributes,
  const InterpolationOptions& options)
{
  weighs ? block.weigh() : void();
  for (const Attribute& attribute : attributes)
  {
    if (!isSampled(attribute, options))
    {
      continue;
    }
    withScalar(attribute.Type,
      [&](auto type)
      {
        BlockFiller<Access, decltype(type)> filler(attribute, block);
        attribute.OfCells ? filler.fromCells(options.Parents) : filler.fromPoints();
      });
  }
}

/// The null value in samples first..end - 1 for which wanted(sample).
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
