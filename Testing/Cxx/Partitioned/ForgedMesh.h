// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippForgedMesh_h
#define tippForgedMesh_h

#include "Partitioned/PartitionedMesh.h"
#include "Partitioned/PieceFormat.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace tipp
{
namespace test
{

/// The files of a good mesh, to be changed and written back with right checksums: what remains
/// wrong, the reader must find out by itself.
class ForgedMesh
{
public:
  explicit ForgedMesh(const std::string& path);

  std::string Index;
  std::string Tables;

  std::size_t pieces() const { return this->Mesh.Pieces.size(); }
  std::size_t arrays(std::size_t piece) const { return this->PieceTables[piece].Offsets.size(); }
  std::size_t find(std::size_t piece, PieceRole role) const;
  std::size_t arrayBytes(std::size_t piece, std::size_t array) const;
  /// Puts 8 bytes into a piece's array, `at` bytes from its beginning.
  void putWord(std::size_t piece, std::size_t array, std::size_t at, std::uint64_t word);

  void write() const;

private:
  std::vector<PieceArray> arraysOf(std::size_t piece) const;

  PartitionedMesh Mesh;
  std::vector<std::string> Pieces;
  std::vector<PieceTable> PieceTables;
};

} // namespace test
} // namespace tipp

#endif
