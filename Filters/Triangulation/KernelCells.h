// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippKernelCells_h
#define tippKernelCells_h

#include "Predicates/Geometry.h"
#include "Triangulation/BoundaryCells.h"
#include "Triangulation/Dimension.h"
#include "Triangulation/Regions.h"

#include <vector>

namespace tipp
{

/// The chosen partitions.
template <int D>
struct RegionChoice
{
  const std::vector<char>& IsChosen; ///< by partition
  Box<D> Bounds;                     ///< contains their regions
};

/// Cells found in a kernel. Their corners are the kernel's point indices; Mesh.Vertices is left
/// empty, for the caller to set.
template <int D>
struct KernelCells
{
  using Kernel = typename Dimension<D>::Kernel;

  BoundaryCells<D> Mesh;
  std::vector<typename Kernel::Index> Indices; ///< the same cells, as the kernel identifies them
  std::vector<PartitionIndex> Met;             ///< working memory

  /// Adds a finite cell if it meets a chosen region. Without `choice` it is always added.
  void add(const Kernel& kernel, typename Kernel::Index cell, const RegionsOf<D>& regions,
    const RegionChoice<D>* choice);
};

/// Returns the kernel's finite cells that meet a chosen region; all of them without `choice`.
template <int D>
KernelCells<D> findCells(const typename Dimension<D>::Kernel& kernel, const RegionsOf<D>& regions,
  const RegionChoice<D>* choice, int threads);

} // namespace tipp

#endif
