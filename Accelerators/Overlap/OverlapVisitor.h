// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippOverlapVisitor_h
#define tippOverlapVisitor_h

#include "Locate/BoxTree.h"
#include "Locate/MortonOrder.h"
#include "Overlap/PlaneTriangles.h"
#include "Overlap/TrianglePairs.h"
#include "Parallel/ParallelFor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <stdexcept>
#include <vector>

namespace tipp
{

/// Finds the common parts of two meshes' triangles. For each target it visits the source triangles
/// in an order that depends on the two meshes alone. Triangles without area, hidden ones and those
/// with a corner that is not finite are left out.
///
/// Targets are visited approximately along the Morton curve, in blocks of neighbours. A block's
/// sources are gathered from the tree once, and their corners are copied to consecutive memory.
template <int Values>
class OverlapVisitor
{
public:
  /// The meshes' arrays must outlive the object. Throws std::length_error for more than 2^31 - 1
  /// triangles.
  OverlapVisitor(const SimplexMesh& targets, const SimplexMesh& sources, int threads)
    : Targets(targets)
    , Sources(sources)
    , Threads(threads)
    , Tree(sources.Cells, threads, [this](std::int64_t i) { return this->Sources.boxOf(i); })
  {
    if (targets.Cells > std::numeric_limits<std::int32_t>::max())
    {
      throw std::length_error("A mesh of more than 2147483647 triangles cannot be a target.");
    }
    const Box2 all = boundsOf<2>(
      sources.Cells, threads, [this](std::int64_t i) { return this->Sources.boxOf(i); });
    this->Order = nearOrder<2>(targets.Cells, threads,
      [this, &all](std::int64_t i)
      {
        const Box2 box = this->Targets.boxOf(i);
        return box.meets(all) ? box.center() : Point2{ NAN, NAN }; // left out
      });
  }

  const TriangleReader& targets() const { return this->Targets; }
  const TriangleReader& sources() const { return this->Sources; }

  /// Calls collector.begin(target), then collector.add(source, part, area) for each common part,
  /// and collector.end(), for each target. makeCollector(thread) makes the collector of some
  /// targets; several threads call it. Returns false if `report` stopped the work.
  template <typename MakeCollector>
  bool visit(const MakeCollector& makeCollector, const Report& report) const
  {
    return forChunks(std::int64_t(this->Order.size()), ChunkSize, this->Threads, report,
      [&](std::int64_t begin, std::int64_t end, int thread)
      {
        auto collector = makeCollector(thread);
        const auto block = std::make_unique<Block>();
        for (std::int64_t i = begin; i < end; i += BlockSize)
        {
          this->visitBlock(i, std::min(i + BlockSize, end), *block, collector);
        }
      });
  }

private:
  static constexpr std::int64_t BlockSize = 32;
  static constexpr std::int64_t ChunkSize = 64 * BlockSize;

  /// The working memory of a block of targets.
  struct Block
  {
    typename BoxTree<2>::Gathered Boxes;
    std::array<PlaneTriangle, BoxTree<2>::Gathered::Most> Sources;
    std::array<PlaneTriangle, BlockSize> Targets;
    CommonPart<Values> Parts[2];
  };

  template <typename Collector>
  void visitBlock(std::int64_t begin, std::int64_t end, Block& block, Collector& collector) const
  {
    std::size_t count = 0;
    Box2 region = Box2::empty();
    for (std::int64_t i = begin; i < end; ++i)
    {
      PlaneTriangle& target = block.Targets[count];
      if (this->Targets.read(this->Order[std::size_t(i)], target))
      {
        region.extend(target.box());
        ++count;
      }
    }
    const bool isGathered = count > 0 && this->gather(region, block);
    for (std::size_t i = 0; i < count; ++i)
    {
      const PlaneTriangle& target = block.Targets[i];
      collector.begin(target);
      if (isGathered)
      {
        this->Tree.search(block.Boxes, target.box(),
          [&](std::int32_t k)
          { this->visitPair(target, block.Sources[std::size_t(k)], block, collector); });
      }
      else
      {
        this->Tree.search(target.box(),
          [&](std::int32_t k)
          {
            PlaneTriangle source;
            if (this->Sources.read(k, source))
            {
              this->visitPair(target, source, block, collector);
            }
          });
      }
      collector.end();
    }
  }

  /// Reads the sources that may meet a region. Returns false if there are too many.
  bool gather(const Box2& region, Block& block) const
  {
    if (!this->Tree.gather(region, block.Boxes))
    {
      return false;
    }
    for (int i = 0; i < block.Boxes.Count; ++i)
    {
      this->Sources.prefetch(block.Boxes.Numbers[std::size_t(i)]);
    }
    for (std::size_t i = 0; i < std::size_t(block.Boxes.Count); ++i)
    {
      if (!this->Sources.read(block.Boxes.Numbers[i], block.Sources[i]))
      {
        block.Sources[i].Cell = -1;
      }
      block.Boxes.Numbers[i] = std::int32_t(i); // search() visits indices into Sources
    }
    return true;
  }

  template <typename Collector>
  static void visitPair(
    const PlaneTriangle& target, const PlaneTriangle& source, Block& block, Collector& collector)
  {
    if (source.Cell < 0)
    {
      return;
    }
    const CommonPart<Values>* part = nullptr;
    const double area = intersect(target, source, block.Parts, part);
    if (area > 0)
    {
      collector.add(source, *part, area);
    }
  }

  TriangleReader Targets;
  TriangleReader Sources;
  int Threads;
  BoxTree<2> Tree;
  std::vector<std::int32_t> Order; ///< the targets, near ones together
};

} // namespace tipp

#endif
