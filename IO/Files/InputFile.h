// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippInputFile_h
#define tippInputFile_h

#include "vtkTIPPIOModule.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace tipp
{

/// A regular file open for reading at any offset. Threads may read concurrently.
class VTKTIPPIO_EXPORT InputFile
{
public:
  /// Throws IOError if the file cannot be opened or is not a regular file.
  explicit InputFile(const std::string& path);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  const std::string& path() const { return this->Path; }
  int descriptor() const { return this->Descriptor; }
  /// The size in bytes at the time of opening.
  std::uint64_t size() const { return this->Size; }

  /// Reads exactly `bytes` bytes from byte `offset`. Throws IOError if the file ends before that or
  /// cannot be read.
  void read(std::uint64_t offset, void* to, std::size_t bytes) const;
  /// Reads exactly `bytes` bytes from byte `offset`, in blocks that fit in the processor's cache:
  /// calls take(data, bytes) for each. Throws IOError if the file ends before that or cannot be
  /// read.
  template <typename Take>
  void readBlocks(std::uint64_t offset, std::uint64_t bytes, Take take) const
  {
    constexpr std::uint64_t most = std::uint64_t(1) << 18;
    std::vector<char> block(std::size_t(std::min(most, bytes)));
    while (bytes > 0)
    {
      const auto count = std::size_t(std::min(most, bytes));
      this->read(offset, block.data(), count);
      take(block.data(), count);
      offset += count;
      bytes -= count;
    }
  }

private:
  std::string Path;
  int Descriptor;
  std::uint64_t Size = 0;
};

/// Reads `bytes` bytes at an offset of an open file; errors call it `path`. Returns the number of
/// bytes read, which is lower only at the end of the file. Throws IOError.
VTKTIPPIO_EXPORT std::size_t readUpTo(
  int descriptor, const std::string& path, std::uint64_t offset, void* to, std::size_t bytes);

/// Returns a path's extension in lower case with its dot, such as ".vtp"; empty if there is none.
VTKTIPPIO_EXPORT std::string extensionOf(const std::string& path);

} // namespace tipp

#endif
