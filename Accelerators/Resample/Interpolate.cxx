// SPDX-License-Identifier: BSD-3-Clause
#include "Resample/Interpolate.h"

#include "Resample/SampleRuns.h"
#include "Resample/ToScalar.h"

#include <algorithm>

namespace tipp
{
namespace
{

/// Fills one attribute's samples of a block.
template <typename Access, typename T>
class BlockFiller
{
public:
  using Runs = SampleRuns<Access>;
  using Run = typename Runs::Run;
  static constexpr int D = Access::Dimension;

  BlockFiller(const Attribute& attribute, const Runs& runs, std::int64_t first)
    : Values(static_cast<const T*>(attribute.Values))
    , Samples(static_cast<T*>(attribute.Samples) + first * attribute.Components)
    , Components(attribute.Components)
    , Block(runs)
  {
  }

  void fromPoints()
  {
    constexpr std::size_t ahead = 8;
    const std::vector<Run>& runs = this->Block.runs();
    for (std::size_t i = 0; i < runs.size(); ++i)
    {
      if (i + ahead < runs.size())
      {
        for (const std::int64_t id : runs[i + ahead].Corners)
        {
          __builtin_prefetch(this->Values + id * this->Components);
        }
      }
      if constexpr (std::is_floating_point_v<T>)
      {
        this->interpolate(runs[i]);
      }
      else
      {
        this->takeNearest(runs[i]);
      }
    }
  }

  void fromCells(const std::int64_t* parents)
  {
    for (const Run& run : this->Block.runs())
    {
      const std::int64_t cell = parents ? parents[run.Cell] : run.Cell;
      const T* const from = this->Values + cell * this->Components;
      for (int j = run.Begin; j < run.Begin + run.Count; ++j)
      {
        std::copy(
          from, from + this->Components, this->Samples + std::int64_t(j) * this->Components);
      }
    }
  }

private:
  void interpolate(const Run& run)
  {
    const int end = run.Begin + run.Count;
    for (int component = 0; component < this->Components; ++component)
    {
      const T* const values = this->Values + component;
      T* const samples = this->Samples + component;
      const double first = double(values[run.Corners[0] * this->Components]);
      double steps[D];
      const double* weights[D];
      for (int i = 0; i < D; ++i)
      {
        steps[i] = double(values[run.Corners[i + 1] * this->Components]) - first;
        weights[i] = this->Block.weights(i);
      }
      for (int j = run.Begin; j < end; ++j)
      {
        double sum = weights[0][j] * steps[0];
        for (int i = 1; i < D; ++i)
        {
          sum += weights[i][j] * steps[i];
        }
        samples[std::int64_t(j) * this->Components] = T(first + sum);
      }
    }
  }

  void takeNearest(const Run& run)
  {
    for (int j = run.Begin; j < run.Begin + run.Count; ++j)
    {
      double rest = 1;
      for (int i = 0; i < D; ++i)
      {
        rest -= this->Block.weights(i)[j];
      }
      int nearest = 0;
      for (int i = 0; i < D; ++i)
      {
        if (this->Block.weights(i)[j] > rest)
        {
          rest = this->Block.weights(i)[j];
          nearest = i + 1;
        }
      }
      const T* const from = this->Values + run.Corners[nearest] * this->Components;
      std::copy(from, from + this->Components, this->Samples + std::int64_t(j) * this->Components);
    }
  }

  const T* Values;
  T* Samples;
  int Components;
  const Runs& Block;
};

/// Sets the samples whose being claimed is as given.
void fillNull(const Attribute& attribute, const std::int32_t* claims, bool claimed,
  std::int64_t first, std::int64_t end)
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
        if ((claims[i] >= 0) == claimed)
        {
          std::fill(samples + i * components, samples + (i + 1) * components, null);
        }
      }
    });
}

/// Whether there is something left to sample.
bool isSampled(const Attribute& attribute, const InterpolationOptions& options)
{
  return attribute.Values && !(options.SkipInterpolated && isInterpolated(attribute));
}

template <typename Access>
void fillBlock(const SampleRuns<Access>& runs, const std::vector<Attribute>& attributes,
  std::int64_t first, const InterpolationOptions& options)
{
  for (const Attribute& attribute : attributes)
  {
    if (!isSampled(attribute, options))
    {
      continue;
    }
    withScalar(attribute.Type,
      [&](auto type)
      {
        BlockFiller<Access, decltype(type)> filler(attribute, runs, first);
        attribute.OfCells ? filler.fromCells(options.Parents) : filler.fromPoints();
      });
  }
}

void fillRest(const std::vector<Attribute>& attributes, const std::int32_t* claims,
  std::int64_t begin, std::int64_t end, const InterpolationOptions& options)
{
  for (const Attribute& attribute : attributes)
  {
    if (options.FillUnclaimed)
    {
      fillNull(attribute, claims, false, begin, end);
    }
    if (!attribute.Values)
    {
      fillNull(attribute, claims, true, begin, end);
    }
  }
  for (std::int64_t i = options.Valid ? begin : end; i < end; ++i)
  {
    const bool claimed = claims[i] >= 0;
    options.Valid[i] = claimed || options.FillUnclaimed ? claimed : options.Valid[i];
  }
}

} // namespace

bool interpolate(const SimplexMesh& mesh, const Lattice& lattice, const std::int32_t* claims,
  const std::vector<Attribute>& attributes, const InterpolationOptions& options)
{
  const LatticeAxes axes(mesh, lattice);
  bool completed = false;
  withAccess(mesh,
    [&](const auto& access)
    {
      using Runs = SampleRuns<std::decay_t<decltype(access)>>;
      const bool needsRuns = std::any_of(attributes.begin(), attributes.end(),
        [&](const Attribute& attribute) { return isSampled(attribute, options); });
      const bool needsWeights = std::any_of(attributes.begin(), attributes.end(),
        [&](const Attribute& attribute)
        { return isSampled(attribute, options) && !attribute.OfCells; });
      std::vector<Runs> blocks(std::size_t(options.Threads), Runs(mesh, axes));
      completed = forChunks(axes.samples(), Runs::BlockSize, options.Threads, options.Progress,
        [&](std::int64_t begin, std::int64_t end, int thread)
        {
          Runs& runs = blocks[std::size_t(thread)];
          if (needsRuns)
          {
            runs.find(claims, begin, int(end - begin));
            needsWeights ? runs.weigh() : void();
            fillBlock(runs, attributes, begin, options);
          }
          fillRest(attributes, claims, begin, end, options);
        });
    });
  return completed;
}

} // namespace tipp
