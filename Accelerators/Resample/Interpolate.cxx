// SPDX-License-Identifier: BSD-3-Clause
#include "Resample/Interpolate.h"

#include "Resample/FillBlock.h"

#include <algorithm>

namespace tipp
{
namespace
{

void fillRest(const std::vector<Attribute>& attributes, const std::int32_t* claims,
  std::int64_t begin, std::int64_t end, const InterpolationOptions& options)
{
  for (const Attribute& attribute : attributes)
  {
    if (options.FillUnclaimed)
    {
      fillNull(attribute, begin, end, [claims](std::int64_t i) { return claims[i] < 0; });
    }
    if (!attribute.Values)
    {
      fillNull(attribute, begin, end, [claims](std::int64_t i) { return claims[i] >= 0; });
    }
  }
  for (std::int64_t i = options.Valid ? begin : end; i < end; ++i)
  {
    const bool claimed = claims[i] >= 0;
    options.Valid[i] = claimed || options.FillUnclaimed ? claimed : options.Valid[i];
  }
}

/// Calls work(cell, row, begin, count) for runs of samples begin..end - 1 of the lattice that one
/// cell claims.
template <typename Access, typename Work>
void forRuns(const Access& access, const LatticeAxes& axes, const std::int32_t* claims,
  std::int64_t begin, std::int64_t end, const Work& work)
{
  constexpr std::int64_t ahead = 16;
  const int width = axes.U.size();
  for (std::int64_t i = begin; i < end;)
  {
    const std::int64_t line = i / width;
    const SampleRow row{ line * width, int(line % axes.V.size()), int(line / axes.V.size()) };
    const std::int64_t rowEnd = std::min(end, row.First + width);
    while (i < rowEnd)
    {
      const std::int32_t cell = claims[i];
      const std::int64_t first = i;
      while (i < rowEnd && claims[i] == cell)
      {
        ++i;
      }
      if (cell >= 0)
      {
        const std::int64_t soon = std::min(i + ahead, end - 1);
        const std::int64_t later = std::min(i + 2 * ahead, end - 1);
        claims[soon] >= 0 ? access.prefetch(claims[soon]) : void();
        __builtin_prefetch(access.ids(std::max(claims[later], 0)));
        work(cell, row, int(first - row.First), int(i - first));
      }
    }
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
      using Block = SampleBlock<std::decay_t<decltype(access)>>;
      const bool samples = std::any_of(attributes.begin(), attributes.end(),
        [&](const Attribute& attribute) { return isSampled(attribute, options); });
      const bool weighs = needsWeights(attributes, options);
      std::vector<Block> blocks(std::size_t(options.Threads), Block(mesh, axes));
      completed = forChunks(axes.samples(), Block::Capacity, options.Threads, options.Progress,
        [&](std::int64_t begin, std::int64_t end, int thread)
        {
          Block& block = blocks[std::size_t(thread)];
          if (samples)
          {
            block.clear();
            forRuns(access, axes, claims, begin, end,
              [&](std::int32_t cell, const SampleRow& row, int first, int count)
              { block.add(cell, row, first, count); });
            fillBlock(block, weighs, attributes, options);
          }
          fillRest(attributes, claims, begin, end, options);
        });
    });
  return completed;
}

} // namespace tipp
