// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioned/PieceTable.h"

#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Partitioned/Checksum.h"
#include "Partitioned/PieceLayout.h"

#include <limits>
#include <string>
#include <utility>

namespace tipp
{
namespace
{

void packGroups(const std::vector<LentGroup>& groups, std::vector<std::uint64_t>& words)
{
  words.push_back(groups.size());
  for (const LentGroup& group : groups)
  {
    words.push_back(std::uint64_t(group.Count));
    words.push_back(group.To.size());
    words.insert(words.end(), group.To.begin(), group.To.end());
  }
}

void packBorrowed(const std::vector<BorrowedGroup>& groups, std::vector<std::uint64_t>& words)
{
  words.push_back(groups.size());
  for (const BorrowedGroup& group : groups)
  {
    words.push_back(std::uint64_t(group.Owner));
    words.push_back(std::uint64_t(group.Group));
  }
}

[[noreturn]] void failInTable(
  const PartitionedMesh& mesh, std::size_t piece, const std::string& problem)
{
  throw IOError(mesh.tablesPath(),
    "its table of piece " + std::to_string(piece) + " " + problem +
      "; copy or make the mesh again.");
}

/// Reads a table word by word; the caller checks each of them.
class TableReader
{
public:
  TableReader(const PartitionedMesh& mesh, std::size_t piece, std::vector<std::uint64_t> words)
    : Mesh(mesh)
    , Number(piece)
    , Words(std::move(words))
  {
  }

  [[noreturn]] void fail(const std::string& problem) const
  {
    failInTable(this->Mesh, this->Number, problem);
  }

  std::uint64_t word()
  {
    if (this->At == this->Words.size())
    {
      this->fail("ends too early");
    }
    return this->Words[this->At++];
  }

  /// Reads a number of at most `limit`.
  std::int64_t number(std::int64_t limit, const char* what)
  {
    const std::uint64_t value = this->word();
    if (value > std::uint64_t(limit))
    {
      this->fail(std::string("has a wrong ") + what + " (" + std::to_string(value) + ")");
    }
    return std::int64_t(value);
  }

  /// Reads a count of items of `wordsEach` words each, which the table must have.
  std::size_t count(std::size_t wordsEach, const char* what)
  {
    const std::size_t left = this->Words.size() - this->At;
    return std::size_t(this->number(std::int64_t(left / wordsEach), what));
  }

  void requireEnd() const
  {
    if (this->At != this->Words.size())
    {
      this->fail("is too long");
    }
  }

private:
  const PartitionedMesh& Mesh;
  std::size_t Number;
  std::vector<std::uint64_t> Words;
  std::size_t At = 0;
};

std::vector<LentGroup> takeGroups(
  TableReader& in, std::int64_t pieces, std::int64_t self, std::int64_t tuples)
{
  std::vector<LentGroup> groups(in.count(2, "number of lent groups"));
  for (LentGroup& group : groups)
  {
    group.Count = in.number(tuples, "size of a lent group");
    tuples -= group.Count;
    group.To.resize(in.count(1, "number of borrowers"));
    std::int64_t last = -1;
    for (std::int32_t& to : group.To)
    {
      const std::int64_t piece = in.number(pieces - 1, "borrower");
      if (piece <= last || piece == self)
      {
        in.fail("names a borrower twice, out of order or its owner");
      }
      to = std::int32_t(last = piece);
    }
    // Only the first group may have no borrowers, because part 0 is for such tuples.
    if (group.Count == 0 || (group.To.empty() && &group != groups.data()))
    {
      in.fail("has an empty lent group");
    }
  }
  return groups;
}

std::vector<BorrowedGroup> takeBorrowed(TableReader& in, std::int64_t pieces, std::int64_t self)
{
  std::vector<BorrowedGroup> groups(in.count(2, "number of borrowed groups"));
  const BorrowedGroup* last = nullptr;
  for (BorrowedGroup& group : groups)
  {
    group.Owner = std::int32_t(in.number(pieces - 1, "owner"));
    group.Group =
      std::int32_t(in.number(std::numeric_limits<std::int32_t>::max(), "borrowed group"));
    const bool ascends = !last || last->Owner < group.Owner ||
      (last->Owner == group.Owner && last->Group < group.Group);
    if (!ascends || group.Owner == self)
    {
      in.fail("has borrowed groups out of order or of its own");
    }
    last = &group;
  }
  return groups;
}

void takeArrays(
  TableReader& in, const PartitionedMesh& mesh, const PieceSummary& piece, PieceTable& table)
{
  const std::vector<PieceArray> arrays = pieceArrays(mesh, piece);
  if (in.word() != arrays.size())
  {
    in.fail("has another number of arrays than the index");
  }
  for (const PieceArray& array : arrays)
  {
    const std::uint64_t offset = in.word();
    const auto tuples = std::uint64_t(storedTuples(mesh, piece, array));
    if (offset > piece.FileBytes || tuples > (piece.FileBytes - offset) / array.tupleBytes())
    {
      in.fail("has the array " + array.Name + " end behind its file");
    }
    table.Offsets.push_back(offset);
    const std::vector<LentGroup>& groups = array.ofPoints() ? table.PointGroups : table.CellGroups;
    std::vector<std::uint64_t> checksums(groups.size() + (mesh.Duplicated ? 2 : 1));
    for (std::uint64_t& checksum : checksums)
    {
      checksum = in.word();
    }
    table.Checksums.push_back(std::move(checksums));
  }
}

} // namespace

std::vector<std::int64_t> PieceTable::parts(
  const PartitionedMesh& mesh, const PieceSummary& piece, bool ofPoints) const
{
  std::vector<std::int64_t> counts{ ofPoints ? piece.Points : piece.Cells };
  for (const LentGroup& group : ofPoints ? this->PointGroups : this->CellGroups)
  {
    counts.push_back(group.Count);
    counts[0] -= group.Count;
  }
  if (mesh.Duplicated)
  {
    counts.push_back(ofPoints ? piece.GhostPoints : piece.BorrowedCells);
  }
  return counts;
}

std::vector<std::uint64_t> packTable(const PieceTable& table)
{
  std::vector<std::uint64_t> words{ table.HeaderBytes, table.HeaderChecksum };
  packGroups(table.PointGroups, words);
  packGroups(table.CellGroups, words);
  words.push_back(table.Offsets.size());
  for (std::size_t a = 0; a < table.Offsets.size(); ++a)
  {
    words.push_back(table.Offsets[a]);
    words.insert(words.end(), table.Checksums[a].begin(), table.Checksums[a].end());
  }
  packBorrowed(table.BorrowedPoints, words);
  packBorrowed(table.BorrowedCells, words);
  return words;
}

PieceTable unpackTable(
  const PartitionedMesh& mesh, std::size_t piece, std::vector<std::uint64_t> words)
{
  const PieceSummary& summary = mesh.Pieces[piece];
  const auto pieces = std::int64_t(mesh.Pieces.size());
  const auto self = std::int64_t(piece);
  TableReader in(mesh, piece, std::move(words));
  PieceTable table;
  table.HeaderBytes = std::uint64_t(in.number(std::int64_t(summary.FileBytes), "header size"));
  table.HeaderChecksum = in.word();
  table.PointGroups = takeGroups(in, pieces, self, summary.Points);
  table.CellGroups = takeGroups(in, pieces, self, summary.Cells);
  takeArrays(in, mesh, summary, table);
  table.BorrowedPoints = takeBorrowed(in, pieces, self);
  table.BorrowedCells = takeBorrowed(in, pieces, self);
  in.requireEnd();
  return table;
}

PieceTable readPieceTable(const PartitionedMesh& mesh, std::size_t piece)
{
  const PieceSummary& summary = mesh.Pieces[piece];
  std::vector<std::uint64_t> words(std::size_t(summary.TableBytes / 8));
  const InputFile file(mesh.tablesPath());
  file.read(summary.TableOffset, words.data(), words.size() * 8);
  if (checksumOf(words.data(), words.size() * 8) != summary.TableChecksum)
  {
    failInTable(mesh, piece, "does not have the checksum that the index gives");
  }
  return unpackTable(mesh, piece, std::move(words));
}

} // namespace tipp
