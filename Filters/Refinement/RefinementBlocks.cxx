// SPDX-License-Identifier: BSD-3-Clause
#include "Refinement/RefinementBlocks.h"

#include "Parallel/ParallelFor.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace tipp
{
namespace
{

struct PlacedElement
{
  Point2 At;
  RefinementQueue::Element What;
};

class BlockTree
{
public:
  BlockTree(Buffer<PlacedElement>& elements, std::size_t size, bool avoidsBorders)
    : Elements(elements)
    , Size(size)
    , AvoidsBorders(avoidsBorders)
  {
  }

  /// Cuts a block again and again, `depth` times at most.
  void cut(const RefinementBlock& block, int depth)
  {
    if (block.End - block.Begin <= this->Size || depth == 0)
    {
      this->Blocks.push_back(block);
      return;
    }
    const auto [axis, at] = this->AvoidsBorders ? this->emptiest(block) : this->median(block);
    PlacedElement* const first = this->Elements.begin();
    const PlacedElement* const middle =
      std::partition(first + std::ptrdiff_t(block.Begin), first + std::ptrdiff_t(block.End),
        [this, axis = axis, at = at](const PlacedElement& element)
        {
          this->countAccess();
          return element.At[axis] < at;
        });
    const std::size_t cut = std::size_t(middle - first);
    if (cut == block.Begin || cut == block.End) // the elements are too close together
    {
      this->Blocks.push_back(block);
      return;
    }
    const auto [below, above] = block.Bounds.cut(axis, at);
    this->cut({ below, block.Begin, cut }, depth - 1);
    this->cut({ above, cut, block.End }, depth - 1);
  }

  std::vector<RefinementBlock> Blocks;

private:
  using Cut = std::pair<std::size_t, double>; ///< an axis and a coordinate

  static std::size_t longerAxis(const Box2& box) { return box.width(0) >= box.width(1) ? 0 : 1; }

  /// Across the longer side, through the median of a sample.
  Cut median(const RefinementBlock& block)
  {
    constexpr std::size_t sample = 1023;
    const std::size_t step = std::max<std::size_t>(1, (block.End - block.Begin) / sample);
    Box2 box = Box2::empty();
    this->Sample.clear();
    for (std::size_t i = block.Begin; i < block.End; i += step)
    {
      box.extend(this->Elements[i].At);
      this->Sample.push_back(this->Elements[i].At);
    }
    const std::size_t axis = longerAxis(box);
    const auto middle = this->Sample.begin() + std::ptrdiff_t(this->Sample.size() / 2);
    std::nth_element(this->Sample.begin(), middle, this->Sample.end(),
      [axis](Point2 a, Point2 b) { return a[axis] < b[axis]; });
    return { axis, (*middle)[axis] };
  }

  /// Across the longer side, where fewest elements are between its first and last third of them.
  Cut emptiest(const RefinementBlock& block)
  {
    Box2 box = Box2::empty();
    for (std::size_t i = block.Begin; i < block.End; ++i)
    {
      this->countAccess();
      box.extend(this->Elements[i].At);
    }
    const std::size_t axis = longerAxis(box);
    constexpr std::size_t bins = 512;
    std::array<std::size_t, bins + 1> counts{};
    const double scale = double(bins) / box.width(axis);
    for (std::size_t i = block.Begin; i < block.End; ++i)
    {
      this->countAccess();
      // The last bin is for the upper end alone; also if all have the same coordinate.
      const double bin = (this->Elements[i].At[axis] - box.Min[axis]) * scale;
      ++counts[bin < double(bins) ? std::size_t(bin) : bins];
    }
    const std::size_t third = (block.End - block.Begin) / 3;
    std::size_t below = 0;
    std::size_t best = bins;
    for (std::size_t bin = 0; bin < bins; below += counts[bin++])
    {
      if (below >= third && below + counts[bin] <= 2 * third &&
        (best == bins || counts[bin] < counts[best]))
      {
        best = bin;
      }
    }
    if (best == bins) // a bin has more than a third
    {
      best = std::size_t(std::max_element(counts.begin(), counts.end()) - counts.begin());
    }
    return { axis, box.Min[axis] + (double(best) + 0.5) / scale };
  }

  /// To be called for each element that is read, of which there may be more than memory holds.
  void countAccess()
  {
    constexpr std::size_t often = std::size_t(1) << 16;
    if (++this->Accesses % often == 0)
    {
      keepMemoryLimits();
    }
  }

  Buffer<PlacedElement>& Elements;
  const std::size_t Size; ///< largest number of elements of a block
  const bool AvoidsBorders;
  std::vector<Point2> Sample;
  std::size_t Accesses = 0;
};

} // namespace

std::vector<RefinementBlock> makeBlocks(const RefinementMesh& mesh,
  Buffer<RefinementQueue::Element>& elements, std::size_t most, bool avoidsBorders, int threads,
  PagedMemory* memory)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr std::size_t smallest = 1024; // so that a block fits into a processor's own cache
  const Box2 plane{ { -infinity, -infinity }, { infinity, infinity } };
  const std::size_t size = std::max(smallest, elements.size() / most + 1);
  if (elements.size() <= 2 * size || most == 1)
  {
    return { { plane, 0, elements.size() } };
  }
  const auto forElements = [&](const auto& visit)
  {
    constexpr std::int64_t chunk = 1 << 13;
    forChunks(std::int64_t(elements.size()), chunk, threads, {},
      [&](std::int64_t begin, std::int64_t end, int)
      {
        for (std::int64_t i = begin; i < end; ++i)
        {
          visit(std::size_t(i));
        }
        keepMemoryLimits();
      });
  };
  Buffer<PlacedElement> placed = bufferIn<PlacedElement>(memory, elements.size());
  forElements(
    [&](std::size_t i)
    {
      const RefinementQueue::Element element = elements[i];
      const RefinementMesh::Index corner = mesh.Triangles[std::size_t(element.Triangle)].Corner[0];
      placed[i] = { mesh.Points[std::size_t(corner)], element };
    });
  // A few large blocks first, which threads then cut.
  constexpr int coarse = 4;
  constexpr int all = 64;
  BlockTree top(placed, size, avoidsBorders);
  top.cut({ plane, 0, placed.size() }, coarse);
  std::vector<std::vector<RefinementBlock>> parts(top.Blocks.size());
  parallelFor(std::int64_t(parts.size()), threads,
    [&](std::int64_t i)
    {
      BlockTree part(placed, size, avoidsBorders);
      part.cut(top.Blocks[std::size_t(i)], all);
      parts[std::size_t(i)] = std::move(part.Blocks);
    });
  std::vector<RefinementBlock> blocks;
  for (const std::vector<RefinementBlock>& part : parts)
  {
    blocks.insert(blocks.end(), part.begin(), part.end());
  }
  forElements([&](std::size_t i) { elements[i] = placed[i].What; });
  return blocks;
}

} // namespace tipp
