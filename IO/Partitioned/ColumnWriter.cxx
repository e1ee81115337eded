// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioned/ColumnWriter.h"

namespace tipp
{

ColumnWriter::ColumnWriter(const OutputFile& file, std::uint64_t offset, std::size_t bufferBytes)
  : File(file)
  , Offset(offset)
  , Buffer(bufferBytes)
{
}

char* ColumnWriter::extend(std::size_t bytes)
{
  if (this->Used + bytes > this->Buffer.size())
  {
    this->flush();
    if (bytes > this->Buffer.size())
    {
      this->Buffer.resize(bytes);
    }
  }
  char* const room = this->Buffer.data() + this->Used;
  this->Used += bytes;
  return room;
}

void ColumnWriter::endPart()
{
  this->Part.add(this->Buffer.data() + this->Hashed, this->Used - this->Hashed);
  this->Hashed = this->Used;
  this->Checksums.push_back(this->Part.finish());
}

void ColumnWriter::flush()
{
  this->Part.add(this->Buffer.data() + this->Hashed, this->Used - this->Hashed);
  this->File.write(this->Offset, this->Buffer.data(), this->Used);
  this->Offset += this->Used;
  this->Used = 0;
  this->Hashed = 0;
}

} // namespace tipp
