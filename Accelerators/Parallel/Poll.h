// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPoll_h
#define tippPoll_h

#include "vtkTIPPAcceleratorsModule.h"

#include <cstdint>
#include <functional>

namespace tipp
{

/// Thrown by work that the user has aborted; not an error.
struct WorkAborted
{
};

/// While the object lives, poll() on its thread calls `goesOn`, which returns false to stop the
/// work. Scopes may be nested; the innermost is used.
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

/// Throws WorkAborted if the user has asked to stop. Long-running work must call it every few
/// thousand items. It does nothing on a thread without a PollScope, such as the other threads of a
/// parallel loop.
VTKTIPPACCELERATORS_EXPORT void poll();

/// For loops over small items: polls once every few thousand of them.
inline void pollAt(std::int64_t item)
{
  if ((item & 0x3fff) == 0)
  {
    poll();
  }
}

} // namespace tipp

#endif
