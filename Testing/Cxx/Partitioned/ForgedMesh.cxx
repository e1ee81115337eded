// SPDX-License-Identifier: BSD-3-Clause
#include "ForgedMesh.h"

#include "Files/Checksum.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>

namespace tipp
{
namespace test
{
namespace
{

std::string read(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  return { std::istreambuf_iterator<char>(file), {} };
}

void writeTo(const std::string& path, const std::string& content)
{
  std::ofstream(path, std::ios::binary) << content;
}

/// Sets the correct checksum of each piece's table, and then of the index.
std::string withChecksums(std::string index, const std::string& tables)
{
  std::size_t at = 0;
  while ((at = index.find("\"table\":[", at)) != std::string::npos)
  {
    char* end = nullptr;
    const std::uint64_t offset = std::strtoull(index.c_str() + at + 9, &end, 10);
    const std::uint64_t bytes = std::strtoull(end + 1, nullptr, 10);
    const std::size_t name = index.find("\"table_xxh3\":\"", at);
    if (name != std::string::npos && offset <= tables.size() && bytes <= tables.size() - offset)
    {
      index.replace(name + 14, 16, checksumText(checksumOf(tables.data() + offset, bytes)));
    }
    ++at;
  }
  const std::size_t tail = std::min(index.rfind(",\n\"xxh3\""), index.size());
  return index.substr(0, tail) + ",\n\"xxh3\": \"" + checksumText(checksumOf(index.data(), tail)) +
    "\"\n}\n";
}

} // namespace

ForgedMesh::ForgedMesh(const std::string& path)
  : Mesh(openPartitionedMesh(path))
{
  this->Index = read(this->Mesh.indexPath());
  this->Tables = read(this->Mesh.tablesPath());
  for (std::size_t piece = 0; piece < this->Mesh.Pieces.size(); ++piece)
  {
    this->Pieces.push_back(read(this->Mesh.piecePath(piece)));
    this->PieceTables.push_back(readPieceTable(this->Mesh, piece));
  }
}

std::vector<PieceArray> ForgedMesh::arraysOf(std::size_t piece) const
{
  return pieceArrays(this->Mesh, this->Mesh.Pieces[piece]);
}

std::size_t ForgedMesh::find(std::size_t piece, PieceRole role) const
{
  const std::vector<PieceArray> arrays = this->arraysOf(piece);
  return std::size_t(std::find_if(arrays.begin(), arrays.end(),
                       [role](const PieceArray& array) { return array.Role == role; }) -
    arrays.begin());
}

std::size_t ForgedMesh::arrayBytes(std::size_t piece, std::size_t array) const
{
  const PieceArray description = this->arraysOf(piece)[array];
  const auto starts = this->PieceTables[piece].partStarts(
    this->Mesh, this->Mesh.Pieces[piece], description.ofPoints());
  return std::size_t(starts.back()) * description.tupleBytes();
}

void ForgedMesh::putWord(std::size_t piece, std::size_t array, std::size_t at, std::uint64_t word)
{
  PieceTable& table = this->PieceTables[piece];
  const PieceSummary& summary = this->Mesh.Pieces[piece];
  const PieceArray description = this->arraysOf(piece)[array];
  char* data = this->Pieces[piece].data() + table.Offsets[array];
  std::memcpy(data + at, &word, 8);
  const auto starts = table.partStarts(this->Mesh, summary, description.ofPoints());
  for (std::size_t part = 0; part + 1 < starts.size(); ++part)
  {
    const std::size_t bytes =
      std::size_t(starts[part + 1] - starts[part]) * description.tupleBytes();
    table.Checksums[array][part] = checksumOf(data, bytes);
    data += bytes;
  }
  const Bytes packed = packTable(table);
  std::memcpy(this->Tables.data() + summary.TableOffset, packed.data(), packed.size());
}

void ForgedMesh::write() const
{
  writeTo(this->Mesh.indexPath(), withChecksums(this->Index, this->Tables));
  writeTo(this->Mesh.tablesPath(), this->Tables);
  for (std::size_t piece = 0; piece < this->Pieces.size(); ++piece)
  {
    writeTo(this->Mesh.piecePath(piece), this->Pieces[piece]);
  }
}

} // namespace test
} // namespace tipp
