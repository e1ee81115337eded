// SPDX-License-Identifier: BSD-3-Clause
#include "Triangulation/KernelCells.h"

#include "Parallel/ParallelFor.h"

#include <algorithm>
#include <utility>

namespace tipp
{

template <int D>
void KernelCells<D>::add(const Kernel& kernel, typename Kernel::Index cell,
  const RegionsOf<D>& regions, const RegionChoice<D>* choice)
{
  const typename Dimension<D>::Ball ball = ballOf<D>(cornersOf<D>(kernel, cell));
  if (choice && !ball.meets(choice->Bounds))
  {
    return;
  }
  std::vector<PartitionIndex>& met = this->Met;
  met.clear();
  regions.visitMet(ball, [&met](PartitionIndex p) { met.push_back(p); });
  if (!choice ||
    std::any_of(met.begin(), met.end(),
      [choice](PartitionIndex p) { return choice->IsChosen[std::size_t(p)] != 0; }))
  {
    this->Mesh.add(pointIndicesOf(kernel, cell), met.data(), met.data() + met.size());
    this->Indices.push_back(cell);
  }
}

template <int D>
KernelCells<D> findCells(const typename Dimension<D>::Kernel& kernel, const RegionsOf<D>& regions,
  const RegionChoice<D>* choice, int threads)
{
  const auto count = static_cast<std::size_t>(threads);
  std::vector<KernelCells<D>> parts(count);
  parallelFor(threads, threads,
    [&](std::int64_t i)
    {
      KernelCells<D> part; // local: threads do not write to the same cache line
      kernel.forEach(std::size_t(i), count,
        [&](auto cell)
        {
          if (!kernel.isInfinite(cell))
          {
            part.add(kernel, cell, regions, choice);
          }
        });
      parts[std::size_t(i)] = std::move(part);
    });
  KernelCells<D> all = std::move(parts.front());
  std::for_each(parts.begin() + 1, parts.end(),
    [&all](const KernelCells<D>& part)
    {
      all.Mesh.append(part.Mesh);
      all.Indices.insert(all.Indices.end(), part.Indices.begin(), part.Indices.end());
    });
  return all;
}

template struct KernelCells<2>;
template struct KernelCells<3>;
template KernelCells<2> findCells<2>(const DelaunayKernel& kernel, const RegionsOf<2>& regions,
  const RegionChoice<2>* choice, int threads);
template KernelCells<3> findCells<3>(const DelaunayKernel3& kernel, const RegionsOf<3>& regions,
  const RegionChoice<3>* choice, int threads);

} // namespace tipp
