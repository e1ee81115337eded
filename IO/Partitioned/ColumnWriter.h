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

/// Writes one array of a file from its first byte to its last through a buffer, a checksum for each
/// of its parts.
class ColumnWriter
{
public:
  ColumnWriter(const OutputFile& file, std::uint64_t offset, std::size_t bufferBytes);

  /// Room for the next bytes, which must be filled before the next call. Throws IOError.
  char* extend(std::size_t bytes);
  void endPart();
  /// Writes what has come so far.
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
