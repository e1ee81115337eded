// SPDX-License-Identifier: BSD-3-Clause
// A library for LD_PRELOAD. It counts reads, writes and syncs of regular files. In call
// TIPP_HANG_AT, the thread creates the file TIPP_HANG_MARK and then hangs. With TIPP_HANG_RANK,
// only this rank of mpirun hangs. Counting starts when the program handles SIGTERM, since shared
// libraries may read files before that.
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <cstring>

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

namespace
{

std::atomic<int> callCount{ 0 };

bool isOtherRank()
{
  const char* const wanted = std::getenv("TIPP_HANG_RANK");
  const char* const rank = std::getenv("OMPI_COMM_WORLD_RANK");
  return wanted && rank && std::strcmp(wanted, rank) != 0;
}

bool isOrdinary(int file)
{
  struct stat info = {};
  return fstat(file, &info) == 0 && S_ISREG(info.st_mode);
}

bool handlesSignals()
{
  struct sigaction present = {};
  return sigaction(SIGTERM, nullptr, &present) == 0 && present.sa_handler != SIG_DFL;
}

void hangHere(int file)
{
  const char* const at = std::getenv("TIPP_HANG_AT");
  const char* const mark = std::getenv("TIPP_HANG_MARK");
  if (at && mark && handlesSignals() && !isOtherRank() && isOrdinary(file) &&
    ++callCount == std::atoi(at))
  {
    close(open(mark, O_WRONLY | O_CREAT, 0600));
    for (;;)
    {
      pause();
    }
  }
}

template <typename Result, typename... Arguments>
Result callOrHang(const char* name, int file, Arguments... arguments)
{
  hangHere(file);
  return reinterpret_cast<Result (*)(int, Arguments...)>(dlsym(RTLD_NEXT, name))(
    file, arguments...);
}

} // namespace

// Replaces functions of the C library.
extern "C"
{
  ssize_t read(int file, void* to, size_t count)
  {
    return callOrHang<ssize_t>("read", file, to, count);
  }

  ssize_t pread64(int file, void* to, size_t count, off64_t offset)
  {
    return callOrHang<ssize_t>("pread64", file, to, count, offset);
  }

  ssize_t pread(int file, void* to, size_t count, off_t offset)
  {
    return callOrHang<ssize_t>("pread", file, to, count, offset);
  }

  ssize_t write(int file, const void* from, size_t count)
  {
    return callOrHang<ssize_t>("write", file, from, count);
  }

  ssize_t writev(int file, const iovec* from, int count)
  {
    return callOrHang<ssize_t>("writev", file, from, count);
  }

  ssize_t pwrite64(int file, const void* from, size_t count, off64_t offset)
  {
    return callOrHang<ssize_t>("pwrite64", file, from, count, offset);
  }

  ssize_t pwrite(int file, const void* from, size_t count, off_t offset)
  {
    return callOrHang<ssize_t>("pwrite", file, from, count, offset);
  }

  int fsync(int file)
  {
    return callOrHang<int>("fsync", file);
  }
}
