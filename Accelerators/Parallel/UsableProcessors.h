// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippUsableProcessors_h
#define tippUsableProcessors_h

#include "vtkTIPPAcceleratorsModule.h"

#include <string>

namespace tipp
{

/// A number of processors or threads, at least 1, and what it comes from.
struct ProcessorCount
{
  int Count;
  const char* From;
};

/// Returns how many processors this process may keep busy. From is "processors", "affinity",
/// "control group" or "ranks on this node". The number is the smallest of: the processors that the
/// system lets the calling thread use (its affinity); the processor time that a control group
/// allows (Linux; containers have such limits), rounded up; this computer's processors divided
/// among its MPI ranks, whose number Open MPI and MPICH's launchers tell in environment variables.
/// Found once; does not change later.
VTKTIPPACCELERATORS_EXPORT const ProcessorCount& usableProcessors();

/// The number of processors that the calling thread may use (its affinity).
VTKTIPPACCELERATORS_EXPORT int processorCount();

/// Returns how many processors' time this process may use by its control groups, or 0 if there is
/// no limit. `groups` is what /proc/self/cgroup holds, `folder` where control groups are mounted.
VTKTIPPACCELERATORS_EXPORT double controlGroupLimit(
  const std::string& groups, const std::string& folder);

/// Returns the same for given limits: the processors of the affinity and of the computer; `limit`
/// and `ranks` are 0 if there is none.
VTKTIPPACCELERATORS_EXPORT ProcessorCount fewestProcessors(
  int allowed, int all, double limit, int ranks);

} // namespace tipp

#endif
