// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPoll_h
#define tippPoll_h

#include "vtkTIPPAcceleratorsModule.h"

#include <cstdint>
#include <functional>

namespace tipp
{

/// Thrown by work that is told to stop: not an error, but the user's wish.
struct WorkAborted
{
};

/// While it lives, poll() on its thread asks `goesOn`. The innermost one counts.
class VTKTIPPACCELERATORS_EXPORT PollScope
{
public:
  explicit PollScope(std::function<bool()> goesOn);
  ~PollScope();
  PollScope(const PollScope&) = delete;
  PollScope& operator=(const PollScope&) = delete;

private:
  friend void poll();
  std::function<bool()> GoesOn;
  PollScope* Outer;
};

/// To be called every few thousand items by all work that may take long, wherever it is: throws
/// WorkAborted if the user wants to stop. Without a scope, as on the threads of a parallel loop
/// other than the calling one, it does nothing.
VTKTIPPACCELERATORS_EXPORT void poll();

/// In a loop over small items: polls at some of them.
inline void pollAt(std::int64_t item)
{
  if ((item & 0x3fff) == 0)
  {
    poll();
  }
}

} // namespace tipp

#endif
