// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioned/PieceWriter.h"

#include <cstring>
#include <string>
#include <utility>

namespace tipp
{

PieceWriter::PieceWriter(const PartitionedMesh& mesh, std::size_t number,
  const PieceSummary& summary, std::size_t bufferBytes)
  : Layout(layOutPiece(mesh, number, summary))
  , File(mesh.piecePath(number))
{
  this->File.write(0, this->Layout.Header.data(), this->Layout.Header.size());
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
  const std::size_t footer = std::strlen(pieceFooter);
  this->File.write(this->Layout.End, pieceFooter, footer);
  this->File.startWriteback();
  table.Offsets = this->Layout.Offsets;
  table.HeaderBytes = this->Layout.Header.size();
  table.HeaderChecksum = checksumOf(this->Layout.Header.data(), this->Layout.Header.size());
  return this->Layout.End + footer;
}

} // namespace tipp
