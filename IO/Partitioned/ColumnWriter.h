// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippColumnWriter_h
#define tippColumnWriter_h

#include "Files/OutputFile.h"
#include "Partitioned/Checksum.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// Writes one array of a file sequentially through a buffer, and computes a checksum for each of
/// its parts.
class ColumnWriter
{
public:
  ColumnWriter(const OutputFile& file, std::uint64_t offset, std::size_t bufferBytes);

  /// Returns the buffer for the next bytes, which the caller must fill before the next call. Throws
  /// IOError.
  char* extend(std::size_t bytes);
  void endPart();
  /// Writes the buffered bytes.
  void flush();
  std::vector<std::uint64_t>& checksums() { return this->Checksums; }

private:
  const OutputFile& File;
  std::uint64_t Offset;
  std::vector<char> Buffer;
  std::size_t Used = 0;
  std::size_t Hashed = 0;
  Checksum Part;
  std::vector<std::uint64_t> Checksums;
};

} // namespace tipp

#endif
