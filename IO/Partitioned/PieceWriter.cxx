// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioned/PieceWriter.h"

#include <cstring>
#include <utility>

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

std::uint64_t writeFrame(const OutputFile& file, const PieceLayout& layout, PieceTable& table)
{
  file.write(0, layout.Header.data(), layout.Header.size());
  const std::size_t footer = std::strlen(pieceFooter);
  file.write(layout.End, pieceFooter, footer);
  file.startWriteback();
  table.Offsets = layout.Offsets;
  table.HeaderBytes = layout.Header.size();
  table.HeaderChecksum = checksumOf(layout.Header.data(), layout.Header.size());
  return layout.End + footer;
}

PieceWriter::PieceWriter(const PartitionedMesh& mesh, std::size_t number,
  const PieceSummary& summary, std::size_t bufferBytes)
  : Layout(layOutPiece(mesh, number, summary))
  , File(mesh.piecePath(number))
{
  for (std::size_t a = 0; a < this->Layout.Arrays.size(); ++a)
  {
    const PieceArray& array = this->Layout.Arrays[a];
    const std::uint64_t bytes =
      std::uint64_t(storedTuples(mesh, summary, array)) * array.tupleBytes();
    this->File.write(this->Layout.Offsets[a] - 8, &bytes, 8);
    this->Columns.emplace_back(this->File, this->Layout.Offsets[a], bufferBytes);
  }
}

void PieceWriter::endPart(bool ofPoints)
{
  for (std::size_t a = 0; a < this->Columns.size(); ++a)
  {
    if (this->Layout.Arrays[a].ofPoints() == ofPoints)
    {
      this->Columns[a].endPart();
    }
  }
}

std::uint64_t PieceWriter::finish(PieceTable& table)
{
  for (ColumnWriter& column : this->Columns)
  {
    column.flush();
    table.Checksums.push_back(std::move(column.checksums()));
  }
  return writeFrame(this->File, this->Layout, table);
}

} // namespace tipp
