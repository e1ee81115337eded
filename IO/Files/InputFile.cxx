// SPDX-License-Identifier: BSD-3-Clause
#include "Files/InputFile.h"

#include "Files/IOError.h"

#include <cerrno>
#include <cstring>
#include <filesystem>

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

std::size_t readUpTo(
  int descriptor, const std::string& path, std::uint64_t offset, void* to, std::size_t bytes)
{
  // A system call transfers less than 2 GiB.
  constexpr std::size_t most = std::size_t(1) << 30;
  std::size_t done = 0;
  while (done < bytes)
  {
    const ssize_t got = pread(descriptor, static_cast<char*>(to) + done,
      std::min(bytes - done, most), off_t(offset + done));
    if (got < 0 && errno == EINTR)
    {
      continue;
    }
    if (got < 0)
    {
      throw IOError(path, std::string("cannot be read (") + std::strerror(errno) + ").");
    }
    if (got == 0)
    {
      break;
    }
    done += std::size_t(got);
  }
  return done;
}

void InputFile::read(std::uint64_t offset, void* to, std::size_t bytes) const
{
  const std::size_t done = readUpTo(this->Descriptor, this->Path, offset, to, bytes);
  if (done < bytes)
  {
    throw IOError(this->Path,
      "ends at byte " + std::to_string(offset + done) + ", " + std::to_string(bytes - done) +
        " bytes before its data do; copy or make it again.");
  }
}

std::string extensionOf(const std::string& path)
{
  const std::size_t end = path.find_last_not_of('/'); // "mesh.tipp/" is a folder's name, too
  std::string extension = std::filesystem::path(path.substr(0, end + 1)).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
    [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
  return extension;
}

} // namespace tipp
