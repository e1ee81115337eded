// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippFileLines_h
#define tippFileLines_h

#include "vtkTIPPIOModule.h"

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace tipp
{

/// The lines of a text file of any size, without their ends (\n or \r\n) and without a byte order
/// mark; a pipe will do. A file .gz, .xz or .zst is decompressed by the program gzip, xz or zstd.
class VTKTIPPIO_EXPORT FileLines
{
public:
  /// Reads so many bytes at a time. Throws IOError if the file cannot be read or is not text.
  explicit FileLines(const std::string& path, std::size_t blockBytes = std::size_t(1) << 20);

  /// The line stays until the next call. False at the end. Throws IOError, also for a line of more
  /// than 64 MiB.
  bool next(std::string_view& line);
  std::int64_t lineNumber() const { return this->Number; }

  /// About how many lines the file has, by its size and first block; 0 for a pipe.
  std::int64_t expectedLines() const { return this->Expected; }

private:
  bool readOn();
  void endDecompression();
  void startText();

  std::string Path;
  std::string Program; ///< that decompresses; empty: none
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> File;
  const std::size_t BlockBytes;
  std::vector<char> Buffer;
  std::size_t Begin = 0; ///< of what has not been given out
  std::size_t End = 0;
  std::int64_t Number = 0;
  std::int64_t Expected = 0;
};

} // namespace tipp

#endif
