// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippLazFile_h
#define tippLazFile_h

#include "Las/LasHeader.h"
#include "Laz/LazChunk.h"
#include "vtkTIPPIOModule.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace tipp
{

class InputFile;

/// The chunks of points of a LAZ file. Where its chunk table is damaged or missing, the chunks are
/// found by decoding them one after the other.
class VTKTIPPIO_EXPORT LazFile
{
public:
  /// Throws IOError if the compression is damaged or not known.
  LazFile(const std::string& path, const LasHeader& header);

  const std::string& path() const { return this->Path; }
  const LazFormat& format() const { return this->Format; }
  const std::vector<LazChunkPlace>& chunks() const { return this->Chunks; }
  /// The number of a chunk among all of the file, for messages: such as "2 of 7".
  std::string numberOf(std::size_t chunk) const;
  /// What is wrong with the chunk table, or empty.
  const std::string& remark() const { return this->Remark; }

  /// Forgets all but the first `count` chunks.
  void keepFirst(std::size_t count) { this->Chunks.resize(count); }
  /// Forgets the chunks whose entry is false.
  void keep(const std::vector<bool>& isKept);

private:
  const std::string Path;
  LazFormat Format;
  std::vector<LazChunkPlace> Chunks;
  std::vector<std::size_t> Numbers; ///< of the chunks, if not all are kept
  std::size_t All = 0;              ///< number of chunks before keep()
  std::string Remark;
};

/// Decodes chunks of a LAZ file, one after the other. Threads need a reader each.
class VTKTIPPIO_EXPORT LazReader
{
public:
  LazReader(const LazFile& laz, unsigned attributes)
    : Laz(laz)
    , Decoder(laz.format(), attributes)
  {
  }

  /// Starts with a chunk. Throws IOError, which names the chunk.
  void begin(const InputFile& file, std::size_t chunk);
  /// Decodes the next records of the chunk. Throws IOError, which names the chunk.
  void read(std::size_t count, char* records);
  /// Decodes the next records of two chunks, which takes less time than one after the other.
  /// Throws LazError, since it is not known which chunk is damaged.
  void readWith(LazReader& other, std::size_t count, char* records, char* otherRecords);

private:
  [[noreturn]] void refuse(const LazError& error) const;

  const LazFile& Laz;
  LazChunk Decoder;
  std::vector<std::uint8_t> Bytes;
  std::size_t Chunk = 0;
};

} // namespace tipp

#endif
