// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPlatform_h
#define tippPlatform_h

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <string>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#ifdef __linux__
#include <csignal>
#include <sys/prctl.h>
#endif
#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace tipp
{

/// @file
/// The calls to the system in which Linux and macOS differ.

/// The time of a file's last change.
inline timespec modificationTime(const struct stat& status)
{
#ifdef __APPLE__
  return status.st_mtimespec;
#else
  return status.st_mtim;
#endif
}

/// What happens if the new path exists.
enum class Rename
{
  Replaces,
  Fails, ///< with EEXIST
  Exchanges
};

/// Renames a file or folder in one step. Returns 0 or the reason: EINVAL, ENOSYS or ENOTSUP if the
/// file system cannot do that.
inline int renamePath(const std::string& from, const std::string& to, Rename existing)
{
  if (existing == Rename::Replaces)
  {
    return std::rename(from.c_str(), to.c_str()) == 0 ? 0 : errno;
  }
#ifdef __APPLE__
  const unsigned flags = existing == Rename::Fails ? RENAME_EXCL : RENAME_SWAP;
  return renamex_np(from.c_str(), to.c_str(), flags) == 0 ? 0 : errno;
#else
  const unsigned flags = existing == Rename::Fails ? RENAME_NOREPLACE : RENAME_EXCHANGE;
  return renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), flags) == 0 ? 0 : errno;
#endif
}

/// Lets the system begin to write a file's data to the disk. Only a hint.
inline void startWriteback([[maybe_unused]] int descriptor)
{
#ifdef __linux__
  static_cast<void>(sync_file_range(descriptor, 0, 0, SYNC_FILE_RANGE_WRITE));
#endif
}

/// Extends a file by a range, whose space on the disk is then reserved. Returns 0 or the reason.
inline int allocateRange(int descriptor, off_t begin, off_t bytes)
{
#ifdef __APPLE__
  fstore_t store = {};
  store.fst_flags = F_ALLOCATEALL;
  store.fst_posmode = F_PEOFPOSMODE;
  store.fst_length = bytes;
  return fcntl(descriptor, F_PREALLOCATE, &store) == 0 && ftruncate(descriptor, begin + bytes) == 0
    ? 0
    : errno;
#else
  return posix_fallocate(descriptor, begin, bytes);
#endif
}

/// The memory of this process that is resident, in bytes.
struct ResidentMemory
{
  std::uint64_t Bytes = 0;
  std::uint64_t Mapped = 0; ///< the part of it that is pages of files
};

/// Returns what is resident; zeros if the system does not say.
inline ResidentMemory residentMemory()
{
  ResidentMemory result;
#ifdef __linux__
  static const int file = open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
  char text[128];
  const ssize_t size = pread(file, text, sizeof(text) - 1, 0);
  text[std::max<ssize_t>(0, size)] = '\0';
  unsigned long long resident = 0;
  unsigned long long mapped = 0;
  if (std::sscanf(text, "%*u %llu %llu", &resident, &mapped) == 2)
  {
    const auto page = std::uint64_t(sysconf(_SC_PAGESIZE));
    result = { resident * page, mapped * page };
  }
#endif
  return result;
}

/// Frees the space of a range of a file, which then reads as zeros, or leaves it as it is if the
/// file system cannot do that.
inline void freeRange(int descriptor, off_t begin, off_t bytes)
{
#ifdef __APPLE__
  fpunchhole_t hole = {};
  hole.fp_offset = begin;
  hole.fp_length = bytes;
  static_cast<void>(fcntl(descriptor, F_PUNCHHOLE, &hole));
#else
  const int ignored =
    fallocate(descriptor, FALLOC_FL_PUNCH_HOLE | FALLOC_FL_KEEP_SIZE, begin, bytes);
  static_cast<void>(ignored);
#endif
}

/// Locks a range of a file for writing (F_WRLCK), or unlocks it (F_UNLCK). Waits for other
/// processes; returns whether it succeeded. The lock belongs to the open file: with locks owned by
/// processes, threads of two processes could look like a deadlock to the system.
inline bool setRangeLock(int descriptor, short type, off_t begin, off_t bytes)
{
  struct flock lock = {};
  lock.l_type = type;
  lock.l_whence = SEEK_SET;
  lock.l_start = begin;
  lock.l_len = bytes;
  int result = 0;
  do
  {
#ifdef F_OFD_SETLKW
    result = fcntl(descriptor, F_OFD_SETLKW, &lock);
#else
    result = fcntl(descriptor, F_SETLKW, &lock);
#endif
  } while (result < 0 && errno == EINTR);
  return result == 0;
}

/// A path that opens the file of a descriptor.
inline std::string pathOfDescriptor(int descriptor)
{
#ifdef __linux__
  return "/proc/self/fd/" + std::to_string(descriptor);
#else
  return "/dev/fd/" + std::to_string(descriptor);
#endif
}

/// Opens an empty file in memory, for processes that this one starts. -1 if the system has none.
inline int openMemoryFile([[maybe_unused]] const char* name)
{
#ifdef __linux__
  return memfd_create(name, MFD_CLOEXEC);
#else
  return -1;
#endif
}

/// Lets the allocator return large blocks to the system when they are freed, also after it has seen
/// larger ones.
inline void returnLargeBlocks()
{
#ifdef __GLIBC__
  mallopt(M_MMAP_THRESHOLD, 1 << 20);
#endif
}

/// Returns freed memory to the system.
inline void returnFreedMemory()
{
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

/// Lets the system end this process when its parent ends, if it supports that.
inline void endWithParent()
{
#ifdef __linux__
  prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
}

} // namespace tipp

#endif
