// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippMemoryLimits_h
#define tippMemoryLimits_h

#include "vtkTIPPIOModule.h"

namespace tipp
{

/// Memory of which a part can be handed back to the system.
class VTKTIPPIO_EXPORT LimitedMemory
{
public:
  LimitedMemory() = default;
  LimitedMemory(const LimitedMemory&) = delete;
  LimitedMemory& operator=(const LimitedMemory&) = delete;

  /// Hands memory back if a limit is exceeded. Threads may call it at the same time.
  virtual void keepLimit() = 0;

protected:
  virtual ~LimitedMemory() = default;
  ///@{
  /// From the one to the other, keepMemoryLimits() calls keepLimit().
  void list();
  void unlist();
  ///@}
};

/// Calls keepLimit() of all objects. Loops over arrays that may be larger than memory call this
/// about each megabyte. Costs about a microsecond, and nothing while no object exists.
VTKTIPPIO_EXPORT void keepMemoryLimits();

} // namespace tipp

#endif
