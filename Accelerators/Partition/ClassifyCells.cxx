// SPDX-License-Identifier: BSD-3-Clause
#include "Partition/ClassifyCells.h"

#include "Parallel/ParallelFor.h"
#include "Predicates/ExactPredicates3.h"

#include <atomic>
#include <string>
#include <utility>

namespace tipp
{

CellShape::CellShape(const CellsView& cells, int dimension)
  : Cells(cells)
  , Dimension(dimension)
  , Stride(static_cast<std::size_t>(cells.Dimension) * static_cast<std::size_t>(cells.Corners))
{
  const bool triangles = cells.Corners == 3 && (cells.Dimension == 2 || cells.Dimension == 3);
  const bool tetrahedra = cells.Corners == 4 && cells.Dimension == 3;
  if (!triangles && !tetrahedra)
  {
    throw AcceleratorError("Cells are triangles, or tetrahedra in space; not cells of " +
      std::to_string(cells.Corners) + " corners in " + std::to_string(cells.Dimension) +
      " dimensions.");
  }
  if (dimension > cells.Dimension || (tetrahedra && dimension != 3))
  {
    throw AcceleratorError("Partitions of " + std::to_string(dimension) +
      " dimensions do not go with " + (tetrahedra ? "tetrahedra." : "triangles in the plane."));
  }
}

bool CellShape::meets(const double* corner, const Box3& box) const
{
  if (this->Dimension == 2)
  {
    const double* b = corner + this->Cells.Dimension;
    const double* c = b + this->Cells.Dimension;
    return triangleMeetsBox({ corner[0], corner[1] }, { b[0], b[1] }, { c[0], c[1] }, box);
  }
  const auto point = [corner](int i) {
    return Point3{ corner[3 * i], corner[3 * i + 1], corner[3 * i + 2] };
  };
  // A triangle in space is treated as a flat tetrahedron.
  return tetrahedronMeetsBox(point(0), point(1), point(2), point(this->Cells.Corners - 1), box);
}

namespace
{

constexpr std::size_t BlockSize = 16384;

// Classifies cells in blocks; a block's borrowers are buffered until their position in the result
// is known.
class BlockwiseClassification
{
public:
  BlockwiseClassification(const CellShape& shape, const BoxTiling& tiling, int threads)
    : Count(shape.cells().Cells)
    , Tiling(tiling)
    , Shape(shape)
    , Threads(threadCount(threads))
    , Borrowers((this->Count + BlockSize - 1) / BlockSize)
  {
    this->Result.Owner.resize(this->Count);
    this->Result.BorrowerStart.resize(this->Count + 1);
  }

  Membership run()
  {
    forChunks(static_cast<std::int64_t>(this->Borrowers.size()), 1, this->Threads, {},
      [&](std::int64_t block, std::int64_t, int)
      { this->classify(static_cast<std::size_t>(block)); });
    if (this->FirstOutside.load() < this->Count)
    {
      failForCell(this->Shape, this->FirstOutside.load());
    }
    this->gather();
    return std::move(this->Result);
  }

private:
  // Fills Owner, Borrowers[block], and in BorrowerStart the ends relative to the block.
  void classify(std::size_t block)
  {
    std::vector<std::int32_t>& borrowers = this->Borrowers[block];
    const std::size_t end = std::min(this->Count, (block + 1) * BlockSize);
    for (std::size_t i = block * BlockSize; i < end; ++i)
    {
      this->Result.Owner[i] = this->classifyCell(i, borrowers);
      this->Result.BorrowerStart[i + 1] = static_cast<std::int64_t>(borrowers.size());
    }
  }

  std::int32_t classifyCell(std::size_t index, std::vector<std::int32_t>& borrowers)
  {
    const double* cell = this->Shape.cell(index);
    Box3 bounds;
    std::int32_t owner = -1;
    if (this->Shape.bounds(cell, bounds))
    {
      std::int32_t only = -1;
      int candidates = 0;
      this->Tiling.forEachMeeting(bounds,
        [&](std::int32_t id)
        {
          only = id;
          ++candidates;
        });
      // A single candidate meets the cell if the cell meets the domain. That needs a test only if
      // the bounding box extends beyond the domain.
      if (candidates == 1 && this->Tiling.domain().contains(bounds))
      {
        return only;
      }
      owner = this->decide(cell, bounds, borrowers);
    }
    if (owner < 0)
    {
      this->reportOutside(index);
    }
    return owner;
  }

  std::int32_t decide(const double* cell, const Box3& bounds, std::vector<std::int32_t>& borrowers)
  {
    std::int32_t owner = -1;
    this->Tiling.forEachMeeting(bounds,
      [&](std::int32_t id)
      {
        if (this->Shape.meets(cell, this->Tiling.box(id)))
        {
          addPartition(id, owner, borrowers);
        }
      });
    return owner;
  }

  void reportOutside(std::size_t index)
  {
    std::size_t first = this->FirstOutside.load();
    while (index < first && !this->FirstOutside.compare_exchange_weak(first, index))
    {
    }
  }

  void gather()
  {
    const std::size_t blocks = this->Borrowers.size();
    std::vector<std::int64_t> starts(blocks + 1, 0);
    for (std::size_t block = 0; block < blocks; ++block)
    {
      starts[block + 1] = starts[block] + static_cast<std::int64_t>(this->Borrowers[block].size());
    }
    this->Result.Borrowers.resize(static_cast<std::size_t>(starts[blocks]));
    forChunks(static_cast<std::int64_t>(blocks), 1, this->Threads, {},
      [&](std::int64_t b, std::int64_t, int)
      {
        const auto block = static_cast<std::size_t>(b);
        const std::size_t end = std::min(this->Count, (block + 1) * BlockSize);
        for (std::size_t i = block * BlockSize; i < end; ++i)
        {
          this->Result.BorrowerStart[i + 1] += starts[block];
        }
        std::copy(this->Borrowers[block].begin(), this->Borrowers[block].end(),
          this->Result.Borrowers.begin() + starts[block]);
      });
  }

  std::size_t Count;
  const BoxTiling& Tiling;
  const CellShape& Shape;
  int Threads;
  std::vector<std::vector<std::int32_t>> Borrowers;
  Membership Result;
  std::atomic<std::size_t> FirstOutside{ static_cast<std::size_t>(-1) };
};

} // namespace

void failForCell(const CellShape& shape, std::size_t cell)
{
  Box3 bounds;
  const bool finite = shape.bounds(shape.cell(cell), bounds);
  throw AcceleratorError("Cell " + std::to_string(cell) +
    (finite ? " lies outside the domain that is partitioned."
            : " has a corner whose coordinates are not finite."));
}

Membership classifyCells(
  const CellsView& cells, const BoxTiling& tiling, const ClassifyOptions& options)
{
  const CellShape shape(cells, tiling.dimension());
  std::optional<Membership> onDevice = classifyOnDevice(shape, tiling, options);
  return onDevice ? std::move(*onDevice)
                  : BlockwiseClassification(shape, tiling, options.Threads).run();
}

} // namespace tipp
