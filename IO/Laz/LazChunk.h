// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippLazChunk_h
#define tippLazChunk_h

#include "Laz/LazFormat.h"
#include "vtkTIPPIOModule.h"

#include <cstddef>
#include <cstdint>
#include <memory>

namespace tipp
{

/// Attributes of points that can be left undecoded, as bits of a mask. Layered compression saves
/// their time; pointwise compression decodes all. X, Y, the returns and the scanner channel are
/// always decoded.
namespace laz
{
constexpr unsigned Z = 1;
constexpr unsigned Class = 2;
constexpr unsigned Flags = 4; ///< of the classification, the scan's direction and its edge
constexpr unsigned Intensity = 8;
constexpr unsigned Angle = 16;
constexpr unsigned UserData = 32;
constexpr unsigned Source = 64;
constexpr unsigned Time = 128;
constexpr unsigned Colour = 256;
constexpr unsigned Infrared = 512;
constexpr unsigned Wave = 1024;
constexpr unsigned Extra = 2048; ///< extra bytes
constexpr unsigned All = 4095;
} // namespace laz

/// A method of compression: decodes one chunk at a time. A chunk begins with its first point, which
/// is not compressed, and from which the models start.
class VTKTIPPIO_EXPORT LazChunkDecoder
{
public:
  virtual ~LazChunkDecoder() = default;

  void begin(const std::uint8_t* bytes, std::size_t size);
  void read(std::size_t count, std::uint8_t* records);
  /// Decodes points of this chunk and of another one of the same kind.
  void readWith(
    LazChunkDecoder& other, std::size_t count, std::uint8_t* records, std::uint8_t* otherRecords);
  virtual std::size_t position() const = 0;

protected:
  explicit LazChunkDecoder(std::size_t recordLength)
    : RecordLength(recordLength)
  {
  }

  /// Reads what precedes the compressed points; First is set.
  virtual void open(std::size_t size) = 0;
  /// Starts the models with the first point.
  virtual void start() = 0;
  virtual void decode(std::size_t count, std::uint8_t* records) = 0;
  virtual void decodeWith(LazChunkDecoder& other, std::size_t count, std::uint8_t* records,
    std::uint8_t* otherRecords) = 0;

  const std::size_t RecordLength;
  const std::uint8_t* First = nullptr; ///< the first point, where the chunk begins
  bool IsStarted = false;              ///< the models are those of this chunk

private:
  std::size_t readFirst(std::size_t count, std::uint8_t* records);

  bool IsFirst = true; ///< the first point is the next one to read
};

VTKTIPPIO_EXPORT std::unique_ptr<LazChunkDecoder> pointwiseDecoder(const LazFormat& format);
VTKTIPPIO_EXPORT std::unique_ptr<LazChunkDecoder> layeredDecoder(
  const LazFormat& format, unsigned attributes);

/// Decodes the points of a chunk, in order, to records as in a LAS file. Objects are independent
/// of each other, so that threads decode chunks in parallel; an object decodes one chunk after the
/// other with the same memory.
///
/// Chunks are not trusted: the decoder never reads outside of their bytes, or writes outside of
/// the records, and ends after as many points as were asked for.
class LazChunk
{
public:
  explicit LazChunk(const LazFormat& format, unsigned attributes = laz::All)
    : Decoder(format.IsLayered ? layeredDecoder(format, attributes) : pointwiseDecoder(format))
  {
  }

  /// Starts with a chunk, whose bytes must stay until its last point is read; there may be more
  /// bytes after it. Throws LazError if it has no point.
  void begin(const std::uint8_t* bytes, std::size_t size) { this->Decoder->begin(bytes, size); }

  /// Decodes the next `count` records. The caller knows how many the chunk has. Attributes that are
  /// not asked for stay as in the chunk's first point. Throws LazError if the bytes are damaged;
  /// then a new chunk can be begun.
  void read(std::size_t count, std::uint8_t* records) { this->Decoder->read(count, records); }

  /// Decodes the next `count` records of this chunk and of another one, of the same format and
  /// attributes, of which equally many points were read. Where both are needed, this takes less
  /// time than one after the other.
  void readWith(
    LazChunk& other, std::size_t count, std::uint8_t* records, std::uint8_t* otherRecords)
  {
    this->Decoder->readWith(*other.Decoder, count, records, otherRecords);
  }

  /// The number of the chunk's bytes, once its last point is read.
  std::size_t position() const { return this->Decoder->position(); }

private:
  std::unique_ptr<LazChunkDecoder> Decoder;
};

} // namespace tipp

#endif
