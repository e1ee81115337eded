// SPDX-License-Identifier: BSD-3-Clause
#include "Files/FileLines.h"

#include "Files/IOError.h"

#include <algorithm>
#include <cerrno>
#include <cstring>

#include <sys/stat.h>

namespace tipp
{

FileLines::FileLines(const std::string& path, std::size_t blockBytes)
  : Path(path)
  , File(std::fopen(path.c_str(), "rb"), std::fclose)
  , BlockBytes(blockBytes)
{
  if (!this->File)
  {
    throw IOError(path, std::string("cannot be opened (") + std::strerror(errno) + ").");
  }
  this->readOn();
  this->startText();
}

/// What the first block tells.
void FileLines::startText()
{
  constexpr std::size_t looked = 4096;
  if (std::memchr(this->Buffer.data(), '\0', std::min(this->End, looked)))
  {
    throw IOError(this->Path, "is not a text file; give its extension as what it is.");
  }
  struct stat status = {};
  if (this->End > 0 && fstat(fileno(this->File.get()), &status) == 0 && S_ISREG(status.st_mode))
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

/// Reads the next bytes behind what is left. False at the end.
bool FileLines::readOn()
{
  constexpr std::size_t longest = std::size_t(64) << 20;
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
  return got > 0;
}

bool FileLines::next(std::string_view& line)
{
  std::size_t looked = 0; // bytes without an end of line
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
      end = looked; // the last one
    }
    // readOn() may have moved it.
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
