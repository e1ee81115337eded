// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippLasWriter_h
#define tippLasWriter_h

#include "Crs/CrsRecords.h"
#include "Files/PendingOutput.h"
#include "Laz/LazEncoder.h"
#include "vtkTIPPIOModule.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace tipp
{

/// What a LAS file of version 1.4 says about all of its points.
struct LasLayout
{
  int Format = 6; ///< 6, 7 (with colour) or 8 (with infrared, too)
  std::array<double, 3> Scale{ 1, 1, 1 };
  std::array<double, 3> Offset{};
  std::string Descriptors;    ///< of the extra bytes: LasExtra::Descriptor of each
  std::size_t ExtraBytes = 0; ///< of a record
  CrsRecords Crs;
  bool HasStandardTime = false;     ///< the GPS times are not those of a week
  bool AreReturnsSynthetic = false; ///< the return numbers were made by software
  std::string System = "OTHER";     ///< the system identifier
  std::string Software;             ///< what generated the file
};

/// Writes a LAS file, or a LAZ file if its name ends so. Threads compress chunks of points, whose
/// bytes do not depend on the number of threads.
class VTKTIPPIO_EXPORT LasWriter
{
public:
  /// Creates a temporary file (PendingFile, which explains `before`). `threads`: 0: OpenMP's
  /// default. Throws IOError.
  LasWriter(const std::string& path, const LasLayout& layout, int threads,
    const std::optional<PathState>& before = std::nullopt);

  std::size_t recordLength() const { return this->Format.RecordLength; }

  /// Makes room for the next records, at most `most`, and returns how many there is room for. The
  /// caller writes them to `records`, and then calls add(). Throws IOError.
  std::size_t makeRoom(std::size_t most, std::uint8_t*& records);
  /// Adds the records that were written since makeRoom().
  void add(std::size_t count) { this->Waiting += count; }

  /// Writes the header, and publishes the file. Throws IOError.
  void close();

private:
  /// A chunk of points, and what the header says about them.
  struct Chunk
  {
    std::vector<std::uint8_t> Bytes; ///< compressed
    std::array<std::int32_t, 3> Low{};
    std::array<std::int32_t, 3> High{};
    std::array<std::uint64_t, 16> Returns{}; ///< points by return number

    void survey(std::size_t count, const std::uint8_t* records, std::size_t length);
    void add(const Chunk& other);
  };

  void flush();
  std::uint32_t sizeOf(const Chunk& chunk) const;
  void write(const void* from, std::size_t bytes);
  std::string recordsOfHeader(const std::string& path);
  std::string header() const;

  const std::string Path;
  const LasLayout Layout;
  const bool IsCompressed;
  const int Threads;
  const LazFormat Format;
  int RecordCount = 0;
  const std::string VariableRecords; ///< behind the header, RecordCount of them
  PendingFile Pending;
  std::uint64_t End;                     ///< of the bytes written so far
  std::vector<LazChunkEncoder> Encoders; ///< of each thread
  std::vector<Chunk> Chunks;             ///< that are compressed together
  std::vector<std::uint8_t> Records;     ///< those waiting, and room for others
  std::size_t Waiting = 0;
  std::vector<std::uint32_t> Sizes; ///< of the chunks written, in bytes
  Chunk All;
  std::uint64_t Points = 0;
};

} // namespace tipp

#endif
