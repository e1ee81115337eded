// SPDX-License-Identifier: BSD-3-Clause
#include "Parallel/Poll.h"

#include <utility>

namespace tipp
{
namespace
{

thread_local PollScope* innermost = nullptr;

} // namespace

PollScope::PollScope(std::function<bool()> goesOn)
  : GoesOn(std::move(goesOn))
  , Outer(innermost)
{
  innermost = this;
}

PollScope::~PollScope()
{
  innermost = this->Outer;
}

void poll()
{
  if (innermost && innermost->GoesOn && !innermost->GoesOn())
  {
    throw WorkAborted();
  }
}

} // namespace tipp
