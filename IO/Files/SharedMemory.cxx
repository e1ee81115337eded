// SPDX-License-Identifier: BSD-3-Clause
#include "Files/SharedMemory.h"

#include "Files/IOError.h"
#include "Files/Platform.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>

#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace tipp
{
namespace
{

[[noreturn]] void fail(std::size_t bytes)
{
  throw IOError("There is no memory of " + std::to_string(bytes) +
    " bytes to share with a process (" + std::strerror(errno) + "); free memory.");
}

/// Opens an empty file in memory, or a temporary one without a name.
int openSharedFile()
{
  const int memory = openMemoryFile("tipp-shared");
  if (memory >= 0)
  {
    return memory;
  }
  std::string path = (std::filesystem::temp_directory_path() / "tippXXXXXX").string();
  const int file = mkstemp(path.data());
  if (file >= 0)
  {
    unlink(path.c_str());
    fcntl(file, F_SETFD, FD_CLOEXEC);
  }
  return file;
}

} // namespace

SharedMemory::SharedMemory()
  : Descriptor(openSharedFile())
{
  if (this->Descriptor < 0)
  {
    fail(0);
  }
}

SharedMemory::~SharedMemory()
{
  this->unmap();
  close(this->Descriptor);
}

void SharedMemory::unmap()
{
  if (this->Address)
  {
    munmap(this->Address, this->Mapped);
    this->Address = nullptr;
    this->Mapped = 0;
  }
}

char* SharedMemory::resize(std::size_t bytes)
{
  // A much smaller block returns the rest to the system.
  constexpr std::size_t least = std::size_t(64) << 20;
  const bool isMuchSmaller = this->Mapped > least && bytes < this->Mapped / 4;
  if (bytes == 0 || bytes > this->Mapped || isMuchSmaller)
  {
    this->unmap();
    if (ftruncate(this->Descriptor, off_t(bytes)) != 0)
    {
      fail(bytes);
    }
  }
  return this->map(bytes);
}

char* SharedMemory::map(std::size_t bytes)
{
  struct stat status = {};
  // Memory beyond the end of the file would kill the process that touches it.
  if (fstat(this->Descriptor, &status) != 0 || std::size_t(status.st_size) < bytes)
  {
    throw IOError("A process that was to do a part of the work has left less than was asked for.");
  }
  if (bytes > this->Mapped)
  {
    this->unmap();
    void* const address =
      mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, this->Descriptor, 0);
    if (address == MAP_FAILED)
    {
      fail(bytes);
    }
    this->Address = static_cast<char*>(address);
    this->Mapped = bytes;
  }
  return this->Address;
}

} // namespace tipp
