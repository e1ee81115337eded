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

/// The files of a valid mesh. A test changes them, and write() writes them with correct checksums,
/// so that the reader has to find the error without checksums.
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
  /// Overwrites 8 bytes of a piece's array, `at` bytes from its start.
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
