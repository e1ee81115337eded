// SPDX-License-Identifier: BSD-3-Clause
#include "Files/InputFile.h"

#include "Files/IOError.h"

#include <algorithm>
#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace tipp
{

InputFile::InputFile(const std::string& path)
  : Path(path)
  // O_NONBLOCK: opening a pipe, which is refused below, must not wait for its writer.
  , Descriptor(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK))
{
  if (this->Descriptor < 0)
  {
    throw IOError(path, std::string("cannot be opened (") + std::strerror(errno) + ").");
  }
  struct stat status = {};
  if (fstat(this->Descriptor, &status) != 0 || !S_ISREG(status.st_mode))
  {
    close(this->Descriptor);
    throw IOError(path,
      S_ISDIR(status.st_mode) ? "is a folder, not a file; name a file in it."
                              : "is not an ordinary file; copy it to one.");
  }
  this->Size = std::uint64_t(status.st_size);
}

InputFile::~InputFile()
{
  close(this->Descriptor);
}

void InputFile::read(std::uint64_t offset, void* to, std::size_t bytes) const
{
  // A system call transfers less than 2 GiB.
  constexpr std::size_t most = std::size_t(1) << 30;
  auto* at = static_cast<char*>(to);
  while (bytes > 0)
  {
    const ssize_t got = pread(this->Descriptor, at, std::min(bytes, most), off_t(offset));
    if (got < 0 && errno == EINTR)
    {
      continue;
    }
    if (got < 0)
    {
      throw IOError(this->Path, std::string("cannot be read (") + std::strerror(errno) + ").");
    }
    if (got == 0)
    {
      throw IOError(this->Path,
        "ends at byte " + std::to_string(offset) + ", " + std::to_string(bytes) +
          " bytes before its data do; copy or make it again.");
    }
    at += got;
    offset += std::uint64_t(got);
    bytes -= std::size_t(got);
  }
}

} // namespace tipp
