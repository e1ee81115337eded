// SPDX-License-Identifier: BSD-3-Clause
// A library for LD_PRELOAD. It kills the process just before it renames or removes a file or folder
// for the TIPP_KILL_AT-th time.
#include <atomic>
#include <csignal>
#include <cstdlib>

#include <dlfcn.h>

namespace
{

std::atomic<int> callCount{ 0 };

template <typename... Arguments>
int callOrDie(const char* name, Arguments... arguments)
{
  const char* const last = std::getenv("TIPP_KILL_AT");
  if (last && ++callCount == std::atoi(last))
  {
    std::raise(SIGKILL);
  }
  return reinterpret_cast<int (*)(Arguments...)>(dlsym(RTLD_NEXT, name))(arguments...);
}

} // namespace

// Replaces functions of the C library.
extern "C"
{
  int rename(const char* from, const char* to) noexcept
  {
    return callOrDie("rename", from, to);
  }

  int renameat2(int fromAt, const char* from, int toAt, const char* to, unsigned flags) noexcept
  {
    return callOrDie("renameat2", fromAt, from, toAt, to, flags);
  }

  int remove(const char* path) noexcept
  {
    return callOrDie("remove", path);
  }

  int unlink(const char* path) noexcept
  {
    return callOrDie("unlink", path);
  }

  int unlinkat(int at, const char* path, int flags) noexcept
  {
    return callOrDie("unlinkat", at, path, flags);
  }

  int rmdir(const char* path) noexcept
  {
    return callOrDie("rmdir", path);
  }
}
