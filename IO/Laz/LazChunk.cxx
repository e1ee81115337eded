// SPDX-License-Identifier: BSD-3-Clause
#include "Laz/LazChunk.h"

#include <cstring>

namespace tipp
{

void LazChunkDecoder::begin(const std::uint8_t* bytes, std::size_t size)
{
  if (size < this->RecordLength)
  {
    throw LazError("ends before its first point");
  }
  this->First = bytes;
  this->IsFirst = true;
  this->IsStarted = false;
  this->open(size);
}

void LazChunkDecoder::read(std::size_t count, std::uint8_t* records)
{
  const std::size_t first = this->readFirst(count, records);
  this->decode(count - first, records + first * this->RecordLength);
}

void LazChunkDecoder::readWith(
  LazChunkDecoder& other, std::size_t count, std::uint8_t* records, std::uint8_t* otherRecords)
{
  const std::size_t first = this->readFirst(count, records);
  if (other.readFirst(count, otherRecords) != first)
  {
    throw LazError("has chunks that are not read from their first points on");
  }
  const std::size_t begin = first * this->RecordLength;
  this->decodeWith(other, count - first, records + begin, otherRecords + begin);
}

/// Copies the first point if it is the next one, and starts the models if there are others. Returns
/// the number of points copied.
std::size_t LazChunkDecoder::readFirst(std::size_t count, std::uint8_t* records)
{
  const std::size_t first = count > 0 && this->IsFirst ? 1 : 0;
  if (first > 0)
  {
    std::memcpy(records, this->First, this->RecordLength);
    this->IsFirst = false;
  }
  if (count > first && !this->IsStarted) // for a chunk of one point there is nothing to start
  {
    this->start();
    this->IsStarted = true;
  }
  return first;
}

} // namespace tipp
