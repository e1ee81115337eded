// SPDX-License-Identifier: BSD-3-Clause
#include "Console/Interrupt.h"

#include <fmt/format.h>

#include <atomic>
#include <csignal>

namespace tipp
{
namespace
{

std::atomic<bool> interrupted{ false };
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler sets it");

extern "C" void onInterrupt(int)
{
  interrupted = true;
}

} // namespace

void watchForInterrupt()
{
  struct sigaction action = {};
  action.sa_handler = onInterrupt;
  action.sa_flags = SA_RESTART | SA_RESETHAND;
  sigaction(SIGINT, &action, nullptr);
}

bool isInterrupted()
{
  return interrupted;
}

int reportInterrupt()
{
  fmt::print(stderr, "tipp: interrupted; nothing was written.\n");
  return interruptedExitCode;
}

} // namespace tipp
