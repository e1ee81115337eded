// SPDX-License-Identifier: BSD-3-Clause
#include "Resample/Interpolate.h"

#include "Resample/FillBlock.h"

#include <algorithm>

namespace tipp
{
namespace
{

/// Samples first..last - 1 of the claims, which are found `shift` further among all.
void fillRest(const std::vector<Attribute>& attributes, const std::int32_t* claims,
  std::int64_t first, std::int64_t last, std::int64_t shift, const InterpolationOptions& options)
{
  const auto claimed = [claims, shift](std::int64_t i) { return claims[i - shift] >= 0; };
  const std::int64_t begin = first + shift;
  const std::int64_t end = last + shift;
  for (const Attribute& attribute : attributes)
  {
    if (options.FillUnclaimed)
    {
      fillNull(attribute, begin, end, [&](std::int64_t i) { return !claimed(i); });
    }
    if (!attribute.Values)
    {
      fillNull(attribute, begin, end, claimed);
    }
  }
  for (std::int64_t i = options.Valid ? begin : end; i < end; ++i)
  {
    const bool is = claimed(i);
    options.Valid[i] = is || options.FillUnclaimed ? is : options.Valid[i];
  }
}

/// Calls work(cell, row, begin, count) for runs of samples begin..end - 1 of the window that one
/// cell claims; the row's first sample is counted among all.
template <typename Access, typename Work>
void forCellRuns(const Access& access, const LatticeAxes& axes, const SampleWindow& window,
  const std::int32_t* claims, std::int64_t begin, std::int64_t end, const Work& work)
{
  constexpr std::int64_t ahead = 16;
  const int width = axes.U.size();
  for (std::int64_t i = begin; i < end;)
  {
    const std::int64_t line = i / width;
    const std::int64_t rowBegin = line * width;
    const SampleRow row{ window.indexOf(line), int(line % axes.V.size()),
      int(line / axes.V.size()) };
    const std::int64_t rowEnd = std::min(end, rowBegin + width);
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
        work(cell, row, int(first - rowBegin), int(i - first));
      }
    }
  }
}

} // namespace

bool interpolate(const SimplexMesh& mesh, const SampleWindow& window, const std::int32_t* claims,
  const std::vector<Attribute>& attributes, const InterpolationOptions& options)
{
  const LatticeAxes axes(mesh, window.lattice());
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
            forCellRuns(access, axes, window, claims, begin, end,
              [&](std::int32_t cell, const SampleRow& row, int first, int count)
              { block.add(cell, row, first, count); });
            fillBlock(block, weighs, attributes, options);
          }
          window.forRuns(begin, end,
            [&](std::int64_t first, std::int64_t last, std::int64_t shift)
            { fillRest(attributes, claims, first, last, shift, options); });
        });
    });
  return completed;
}

} // namespace tipp
