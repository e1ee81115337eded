// SPDX-License-Identifier: BSD-3-Clause
#include "Files/StandardInput.h"

#include "Files/IOError.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <vector>

#include <unistd.h>

namespace tipp
{
namespace
{

[[noreturn]] void failToCopy(const std::string& what)
{
  throw IOError(
    "The standard input cannot be copied to a temporary file (" + what + "); name a file instead.");
}

void writeAll(int file, const char* data, std::size_t bytes)
{
  while (bytes > 0)
  {
    const ssize_t put = write(file, data, bytes);
    if (put < 0 && errno != EINTR)
    {
      failToCopy(std::strerror(errno));
    }
    data += put > 0 ? put : 0;
    bytes -= put > 0 ? std::size_t(put) : 0;
  }
}

/// Returns the descriptor of a file without a name, which goes away with the process.
int copyStandardInput()
{
  const char* const folder = std::getenv("TMPDIR");
  std::string path = std::string(folder && *folder ? folder : "/tmp") + "/tipp-XXXXXX";
  const int file = mkstemp(path.data());
  if (file < 0)
  {
    failToCopy(std::strerror(errno));
  }
  unlink(path.c_str());
  std::vector<char> block(std::size_t(1) << 20);
  for (;;)
  {
    const ssize_t got = read(STDIN_FILENO, block.data(), block.size());
    if (got == 0)
    {
      return file;
    }
    if (got < 0 && errno != EINTR)
    {
      failToCopy(std::strerror(errno));
    }
    writeAll(file, block.data(), got > 0 ? std::size_t(got) : 0);
  }
}

} // namespace

std::string openablePath(const std::string& path)
{
  if (path != "-")
  {
    return path;
  }
  static const int copy = copyStandardInput();
  return "/proc/self/fd/" + std::to_string(copy);
}

} // namespace tipp
