// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippLazFormat_h
#define tippLazFormat_h

#include "vtkTIPPIOModule.h"

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <vector>

namespace tipp
{

/// Thrown if compressed points cannot be decoded. what() goes on after the name of the
/// file or the chunk: "has ...".
class VTKTIPPIO_EXPORT LazError : public std::runtime_error
{
  using std::runtime_error::runtime_error;
};

/// A part of a point record that is compressed by a method of its own.
struct LazItem
{
  enum class Kind : std::uint16_t
  {
    Bytes = 0,
    Point10 = 6,
    Time11 = 7,
    Colour12 = 8,
    Wave13 = 9,
    Point14 = 10,
    Colour14 = 11,
    ColourInfrared14 = 12,
    Wave14 = 13,
    Bytes14 = 14
  };
  Kind What = Kind::Bytes;
  std::size_t Size = 0;   ///< bytes in the record
  std::size_t Offset = 0; ///< of its first byte in the record
  int Version = 0;        ///< of the method
};

/// How the points of a file are compressed, by its record 22204 of 'laszip encoded'.
struct VTKTIPPIO_EXPORT LazFormat
{
  static constexpr std::uint32_t VariableChunks = 0xFFFFFFFF;

  /// Points of a chunk as all writers have them.
  static constexpr std::uint32_t UsualChunkPoints = 50000;

  std::vector<LazItem> Items;    ///< in the order of the record's bytes
  std::size_t RecordLength = 0;  ///< bytes of a point
  bool IsChunked = false;        ///< false: one chunk, and no table
  bool IsLayered = false;        ///< each attribute of a chunk has its own bytes
  std::uint32_t ChunkPoints = 0; ///< points of each chunk but the last, or VariableChunks

  /// Reads the content of the record, of `size` bytes. Throws LazError if it is damaged or of a
  /// kind that is not known.
  LazFormat(const std::uint8_t* content, std::size_t size);
  LazFormat() = default;

  /// How points of format 6, 7 or 8 are compressed here: in layers, by version 3 of the items.
  static LazFormat layered(int pointFormat, std::size_t extraBytes);
  /// Returns the content of the record of a layered format.
  std::vector<std::uint8_t> record() const;
};

/// Where a chunk is.
struct LazChunkPlace
{
  std::uint64_t Begin = 0; ///< offset in the file, in bytes
  std::uint64_t Bytes = 0;
  std::uint64_t FirstPoint = 0;
  std::uint64_t Points = 0;
};

struct LazChunkTable
{
  std::vector<LazChunkPlace> Chunks; ///< of the points that were asked for
  std::uint64_t End = 0;             ///< of all chunks, also those of further points
};

/// Decodes a chunk table, whose bytes begin with its version, and returns the chunks of `points`
/// points. The first chunk begins at `begin`, and the last one ends at or before `end`. Throws
/// LazError if the table is damaged or does not have these points.
VTKTIPPIO_EXPORT LazChunkTable readLazChunkTable(const LazFormat& format, const std::uint8_t* table,
  std::size_t size, std::uint64_t points, std::uint64_t begin, std::uint64_t end);

/// Returns a chunk table, from its version on, for chunks of these sizes in bytes, all of which but
/// the last have as many points as the format says.
VTKTIPPIO_EXPORT std::vector<std::uint8_t> writeLazChunkTable(
  const std::vector<std::uint32_t>& sizes);

} // namespace tipp

#endif
