// SPDX-License-Identifier: BSD-3-Clause
#include "Files/FileLines.h"

#include "Files/Extension.h"
#include "Files/IOError.h"
#include "Files/StandardInput.h"

#include <algorithm>
#include <cerrno>
#include <cstring>

#include <sys/stat.h>
#include <sys/wait.h>

namespace tipp
{

namespace
{

/// The program that decompresses a file to its standard output; empty if the file is not
/// compressed.
std::string decompressorOf(const std::string& path)
{
  const std::string extension = extensionOf(path);
  return extension == ".gz" ? "gzip"
    : extension == ".xz"    ? "xz"
    : extension == ".zst"   ? "zstd"
                            : "";
}

/// Quotes a path for the shell.
std::string quoted(const std::string& path)
{
  std::string word = "'";
  for (const char c : path)
  {
    word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  }
  return word + "'";
}

} // namespace

FileLines::FileLines(const std::string& path, std::size_t blockBytes)
  : Path(path)
  , Program(decompressorOf(path))
  , File(std::fopen(openablePath(path).c_str(), "rb"), std::fclose)
  , BlockBytes(blockBytes)
{
  if (!this->File)
  {
    throw IOError(path, std::string("cannot be opened (") + std::strerror(errno) + ").");
  }
  if (!this->Program.empty())
  {
    const std::string command =
      "exec " + this->Program + " -dc < " + quoted(path) + " 2> /dev/null";
    this->File = { popen(command.c_str(), "r"), pclose };
    if (!this->File)
    {
      throw IOError(path, "cannot be decompressed, since no process can be started.");
    }
  }
  this->readOn();
  this->startText();
}

/// Skips the byte order mark and estimates the number of lines.
void FileLines::startText()
{
  constexpr std::size_t looked = 4096;
  if (std::memchr(this->Buffer.data(), '\0', std::min(this->End, looked)))
  {
    throw IOError(this->Path, "is not a text file; give its extension as what it is.");
  }
  struct stat status = {};
  if (this->End > 0 && this->File && fstat(fileno(this->File.get()), &status) == 0 &&
    S_ISREG(status.st_mode))
  {
    const auto lines =
      std::count(this->Buffer.begin(), this->Buffer.begin() + std::ptrdiff_t(this->End), '\n');
    this->Expected =
      std::int64_t(double(lines + 1) * std::max(1.0, double(status.st_size) / double(this->End)));
  }
  constexpr std::string_view byteOrderMark = "\xef\xbb\xbf";
  if (std::string_view(this->Buffer.data(), this->End).substr(0, 3) == byteOrderMark)
  {
    this->Begin = byteOrderMark.size();
  }
}

/// Appends the next bytes to the buffer. Returns false at the end.
bool FileLines::readOn()
{
  constexpr std::size_t longest = std::size_t(64) << 20;
  if (!this->File)
  {
    return false;
  }
  const std::size_t left = this->End - this->Begin;
  if (left > longest)
  {
    throw IOError(
      this->Path, this->Number + 1, "is longer than any line of points; check the file.");
  }
  std::copy(this->Buffer.begin() + std::ptrdiff_t(this->Begin),
    this->Buffer.begin() + std::ptrdiff_t(this->End), this->Buffer.begin());
  this->Buffer.resize(std::max(this->Buffer.size(), std::max(left, this->BlockBytes) + left));
  const std::size_t got =
    std::fread(&this->Buffer[left], 1, this->Buffer.size() - left, this->File.get());
  if (std::ferror(this->File.get()))
  {
    throw IOError(this->Path, std::string("cannot be read (") + std::strerror(errno) + ").");
  }
  this->Begin = 0;
  this->End = left + got;
  if (got == 0 && !this->Program.empty())
  {
    this->endDecompression();
  }
  return got > 0;
}

void FileLines::endDecompression()
{
  constexpr int notFound = 127; // the shell's exit status
  const int status = pclose(this->File.release());
  if (status != 0)
  {
    const bool isMissing = WIFEXITED(status) && WEXITSTATUS(status) == notFound;
    throw IOError(this->Path,
      isMissing ? "needs the program " + this->Program + ", which is not there; install it."
                : "cannot be decompressed by " + this->Program + "; copy it again.");
  }
}

bool FileLines::next(std::string_view& line)
{
  std::size_t looked = 0; // bytes already searched for an end of line
  for (;;)
  {
    const std::string_view rest(this->Buffer.data() + this->Begin, this->End - this->Begin);
    std::size_t end = rest.find('\n', looked);
    if (end == std::string_view::npos)
    {
      looked = rest.size();
      if (this->readOn())
      {
        continue;
      }
      if (looked == 0)
      {
        return false;
      }
      end = looked; // the last line has no end of line
    }
    // readOn() may have moved the buffer.
    line = std::string_view(this->Buffer.data() + this->Begin, end);
    this->Begin = std::min(this->Begin + end + 1, this->End);
    if (!line.empty() && line.back() == '\r')
    {
      line.remove_suffix(1);
    }
    ++this->Number;
    return true;
  }
}

} // namespace tipp
