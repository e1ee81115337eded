// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippMakeTiling_h
#define tippMakeTiling_h

#include "Partition/BoxTiling.h"
#include "Predicates/Box3.h"

namespace tipp
{

struct PartitionRun;

/// The tiling that the run's options ask for. A call of all ranks. Throws IOError.
BoxTiling makeTiling(const PartitionRun& run, const Box3& domain);

} // namespace tipp

#endif
