// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPoll_h
#define tippPoll_h

#include "vtkTIPPAcceleratorsModule.h"

#include <cstdint>
#include <functional>

namespace tipp
{

/// Thrown by work that the user has stopped; not an error.
struct WorkAborted
{
};

/// While the object lives, poll() on its thread calls `goesOn`. Scopes may be nested; the innermost
/// is used.
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

/// To be called every few thousand items by all work that may take long: throws WorkAborted if the
/// user wants to stop. Without a PollScope on the same thread, as on the other threads of a
/// parallel loop, it does nothing.
VTKTIPPACCELERATORS_EXPORT void poll();

/// For loops over small items: polls at some of them.
inline void pollAt(std::int64_t item)
{
  if ((item & 0x3fff) == 0)
  {
    poll();
  }
}

} // namespace tipp

#endif
