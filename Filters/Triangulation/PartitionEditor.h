// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPartitionEditor_h
#define tippPartitionEditor_h

#include "Kernel/DelaunayKernel.h"
#include "Triangulation/Tiling.h"

#include <cstdint>

namespace tipp
{

/// Changes the interior triangles of partitions before they are written, in the kernel's mesh.
/// Their number and their union must stay. Each thread has its own one.
class PartitionEditor
{
public:
  /// Ids: of the kernel's vertices from 1 on; -1 for those of other partitions. IsBoundary: of each
  /// triangle of the kernel, whether it is not interior.
  template <typename Id>
  struct Partition
  {
    PartitionIndex Number;
    DelaunayKernel& Kernel;
    const Id* Ids;
    const char* IsBoundary;
  };

  virtual ~PartitionEditor() = default;
  virtual void edit(const Partition<std::int32_t>& partition) = 0;
  virtual void edit(const Partition<std::int64_t>& partition) = 0;
};

} // namespace tipp

#endif
