// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioned/PieceFormat.h"

#include "Files/Checksum.h"
#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Files/VtkXml.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <set>
#include <utility>

namespace tipp
{
namespace
{

void saveGroups(SaveArchive& archive, const std::vector<SharedGroup>& groups)
{
  archive(std::uint64_t(groups.size()));
  for (const SharedGroup& group : groups)
  {
    archive(std::uint64_t(group.Count),
      std::vector<std::uint64_t>(group.Borrowers.begin(), group.Borrowers.end()));
  }
}

void saveGroups(SaveArchive& archive, const std::vector<BorrowedGroup>& groups)
{
  archive(std::uint64_t(groups.size()));
  for (const BorrowedGroup& group : groups)
  {
    archive(std::uint64_t(group.Owner), std::uint64_t(group.Group));
  }
}

/// Reads a table number by number; the caller checks each of them.
class TableReader
{
public:
  TableReader(const PartitionedMesh& mesh, std::size_t piece, const Bytes& table)
    : Mesh(mesh)
    , Number(piece)
    , Table(table)
  {
  }

  [[noreturn]] void fail(const std::string& problem) const
  {
    throw IOError(this->Mesh.tablesPath(),
      "its table of piece " + std::to_string(this->Number) + " " + problem +
        "; copy or make the mesh again.");
  }

  std::uint64_t word()
  {
    if (this->wordsLeft() == 0)
    {
      this->fail("ends too early");
    }
    return this->Table.get<std::uint64_t>();
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
    return std::size_t(this->number(std::int64_t(this->wordsLeft() / wordsEach), what));
  }

  void requireEnd() const
  {
    if (this->Table.left() != 0)
    {
      this->fail("is too long");
    }
  }

private:
  std::size_t wordsLeft() const { return this->Table.left() / sizeof(std::uint64_t); }

  const PartitionedMesh& Mesh;
  std::size_t Number;
  LoadArchive Table;
};

std::vector<SharedGroup> takeGroups(
  TableReader& in, std::int64_t pieces, std::int64_t self, std::int64_t tuples)
{
  std::vector<SharedGroup> groups(in.count(2, "number of shared groups"));
  for (SharedGroup& group : groups)
  {
    group.Count = in.number(tuples, "size of a shared group");
    tuples -= group.Count;
    group.Borrowers.resize(in.count(1, "number of borrowers"));
    std::int64_t last = -1;
    for (std::int32_t& to : group.Borrowers)
    {
      const std::int64_t piece = in.number(pieces - 1, "borrower");
      if (piece <= last || piece == self)
      {
        in.fail("names a borrower twice, out of order or its owner");
      }
      to = std::int32_t(last = piece);
    }
    // Only the first group may have no borrowers, because part 0 is for such tuples.
    if (group.Count == 0 || (group.Borrowers.empty() && &group != groups.data()))
    {
      in.fail("has an empty shared group");
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
    const auto tuples = std::uint64_t(storedTuples(mesh, piece, array.ofPoints()));
    if (offset > piece.FileBytes || tuples > (piece.FileBytes - offset) / array.tupleBytes())
    {
      in.fail("has the array " + array.Name + " end behind its file");
    }
    table.Offsets.push_back(offset);
    const std::vector<SharedGroup>& groups =
      array.ofPoints() ? table.PointGroups : table.CellGroups;
    std::vector<std::uint64_t> checksums(groups.size() + (mesh.Duplicated ? 2 : 1));
    for (std::uint64_t& checksum : checksums)
    {
      checksum = in.word();
    }
    table.Checksums.push_back(std::move(checksums));
  }
}

std::string startOf(const std::string& type)
{
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"" + type +
    "\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n";
}

/// The attributes that describe an array both in a piece and in the .pvtu.
std::string describe(const PieceArray& array)
{
  // VTK's connectivity has one component.
  const int components = array.Role == PieceRole::Connectivity ? 1 : array.Components;
  std::string text = std::string(" type=\"") + scalarName(array.Type) + "\" Name=\"" +
    escapedXml(array.Name) + "\" NumberOfComponents=\"" + std::to_string(components) + "\"";
  // VTK accepts global ids only in arrays of vtkIdType.
  const bool ids = array.Role == PieceRole::PointIds || array.Role == PieceRole::CellIds;
  return ids ? text + " IdType=\"1\"" : text;
}

/// The section that lists arrays of this role. Relies on the order of the roles.
const char* sectionOf(PieceRole role)
{
  return role == PieceRole::Points ? "Points"
    : role <= PieceRole::PointData ? "PointData"
    : role <= PieceRole::Types     ? "Cells"
                                   : "CellData";
}

/// The sections that list the arrays of a piece in its .vtu file. Without `offsets`: the sections
/// of the .pvtu file, whose tags begin with P and which has no section Cells.
std::string sections(
  const std::vector<PieceArray>& arrays, const std::vector<std::uint64_t>* offsets)
{
  const std::string prefix = offsets ? "" : "P";
  const std::string begin = "      <" + prefix;
  const std::string array = "        <" + prefix + "DataArray";
  const std::string end = "      </" + prefix;
  std::string text;
  for (const std::string name : { "Points", "PointData", "Cells", "CellData" })
  {
    if (!offsets && name == "Cells")
    {
      continue;
    }
    const char* const ids = name == "PointData" ? pointIdsName
      : name == "CellData"                      ? cellIdsName
                                                : nullptr;
    text.append(begin).append(name);
    if (ids)
    {
      text.append(" GlobalIds=\"").append(ids).append("\"");
    }
    text += ">\n";
    for (std::size_t a = 0; a < arrays.size(); ++a)
    {
      if (name == sectionOf(arrays[a].Role))
      {
        text.append(array).append(describe(arrays[a]));
        text += offsets
          ? " format=\"appended\" offset=\"" + std::to_string((*offsets)[a] - 8) + "\"/>\n"
          : "/>\n";
      }
    }
    text.append(end).append(name).append(">\n");
  }
  return text;
}

/// The XML header without its padding; array offsets are relative to the appended data.
std::string headerText(const PartitionedMesh& mesh, std::size_t number, const PieceSummary& piece,
  const PieceLayout& layout)
{
  std::string header = startOf("UnstructuredGrid");
  header += "  <!-- Piece " + std::to_string(number) + " of " + std::to_string(mesh.Pieces.size()) +
    " of a partitioned mesh; ../index.json tells more. -->\n";
  header += "  <UnstructuredGrid>\n    <Piece NumberOfPoints=\"" +
    std::to_string(storedTuples(mesh, piece, true)) + "\" NumberOfCells=\"" +
    std::to_string(storedTuples(mesh, piece, false)) + "\">\n";
  header += sections(layout.Arrays, &layout.Offsets);
  header += "    </Piece>\n  </UnstructuredGrid>\n  <AppendedData encoding=\"raw\">\n";
  return header;
}

/// What makes the file one of HDF5, too: its arrays without their values, each named by its index.
/// `base`: the position of this part in the file. Before the layout has offsets, the result has the
/// right size only.
std::string hdfPartOf(const PartitionedMesh& mesh, const PieceSummary& piece,
  const PieceLayout& layout, std::uint64_t base)
{
  HdfObjects objects;
  std::vector<HdfLink> links;
  for (std::size_t a = 0; a < layout.Arrays.size(); ++a)
  {
    const PieceArray& array = layout.Arrays[a];
    const HdfShape shape =
      hdfShapeOf(array, std::uint64_t(storedTuples(mesh, piece, array.ofPoints())));
    const HdfAddress data = layout.Offsets.empty() ? 0 : layout.Offsets[a];
    links.push_back({ hdfNameOf(a), objects.addArray(shape, data) });
  }
  const HdfAddress root = objects.addGroup(links);
  std::string part = objects.take();
  const std::string superblock = HdfObjects::superblock(base, base + layout.End, root);
  return part.replace(0, superblock.size(), superblock);
}

} // namespace

std::string hdfNameOf(std::size_t array)
{
  return std::to_string(array);
}

HdfShape hdfShapeOf(const PieceArray& array, std::uint64_t tuples)
{
  const auto components = std::uint64_t(array.Components);
  if (array.Role == PieceRole::Connectivity)
  {
    return { array.Type, { tuples * components } };
  }
  return components == 1 ? HdfShape{ array.Type, { tuples } }
                         : HdfShape{ array.Type, { tuples, components } };
}

std::vector<std::int64_t> PieceTable::partStarts(
  const PartitionedMesh& mesh, const PieceSummary& piece, bool ofPoints) const
{
  // Backwards: the first part is what the others leave.
  const std::vector<SharedGroup>& groups = ofPoints ? this->PointGroups : this->CellGroups;
  std::vector<std::int64_t> starts{ ofPoints ? piece.Points : piece.Cells };
  for (auto group = groups.rbegin(); group != groups.rend(); ++group)
  {
    starts.push_back(starts.back() - group->Count);
  }
  starts.push_back(0);
  std::reverse(starts.begin(), starts.end());
  if (mesh.Duplicated)
  {
    starts.push_back(storedTuples(mesh, piece, ofPoints));
  }
  return starts;
}

Bytes packTable(const PieceTable& table)
{
  SaveArchive archive;
  archive(table.HeaderBytes, table.HeaderChecksum);
  saveGroups(archive, table.PointGroups);
  saveGroups(archive, table.CellGroups);
  archive(std::uint64_t(table.Offsets.size()));
  for (std::size_t a = 0; a < table.Offsets.size(); ++a)
  {
    archive(table.Offsets[a]);
    archive.raw(table.Checksums[a].data(), table.Checksums[a].size() * sizeof(std::uint64_t));
  }
  saveGroups(archive, table.BorrowedPoints);
  saveGroups(archive, table.BorrowedCells);
  return archive.take();
}

PieceTable readPieceTable(const PartitionedMesh& mesh, std::size_t number)
{
  const PieceSummary& piece = mesh.Pieces[number];
  Bytes bytes(std::size_t(piece.TableBytes));
  InputFile(mesh.tablesPath()).read(piece.TableOffset, bytes.data(), bytes.size());
  TableReader in(mesh, number, bytes);
  if (checksumOf(bytes.data(), bytes.size()) != piece.TableChecksum)
  {
    in.fail("does not have the checksum that the index gives");
  }
  const auto pieces = std::int64_t(mesh.Pieces.size());
  const auto self = std::int64_t(number);
  PieceTable table;
  table.HeaderBytes = std::uint64_t(in.number(std::int64_t(piece.FileBytes), "header size"));
  table.HeaderChecksum = in.word();
  table.PointGroups = takeGroups(in, pieces, self, piece.Points);
  table.CellGroups = takeGroups(in, pieces, self, piece.Cells);
  takeArrays(in, mesh, piece, table);
  table.BorrowedPoints = takeBorrowed(in, pieces, self);
  table.BorrowedCells = takeBorrowed(in, pieces, self);
  in.requireEnd();
  return table;
}

std::size_t findArray(const std::vector<PieceArray>& arrays, PieceRole role)
{
  const auto found = std::find_if(
    arrays.begin(), arrays.end(), [role](const PieceArray& array) { return array.Role == role; });
  return std::size_t(found - arrays.begin());
}

std::size_t findArrayOf(const std::vector<PieceArray>& arrays, std::int64_t attribute)
{
  const auto found = std::find_if(arrays.begin(), arrays.end(),
    [attribute](const PieceArray& array) { return array.Attribute == attribute; });
  return std::size_t(found - arrays.begin());
}

void fillShapes(
  const PieceArray& array, int cellSize, std::int64_t first, std::int64_t count, char* to)
{
  constexpr int vtkTriangle = 5;
  constexpr int vtkTetra = 10;
  if (array.Role == PieceRole::Types)
  {
    std::memset(to, cellSize == 3 ? vtkTriangle : vtkTetra, std::size_t(count));
    return;
  }
  const auto fillAs = [&](auto end)
  {
    for (std::int64_t cell = first; cell < first + count; ++cell, to += sizeof(end))
    {
      end = decltype(end)((cell + 1) * cellSize);
      std::memcpy(to, &end, sizeof(end));
    }
  };
  array.Type == Scalar::Int64 ? fillAs(std::int64_t(0)) : fillAs(std::int32_t(0));
}

const char* const pointIdsName = "GlobalPointIds";
const char* const cellIdsName = "GlobalCellIds";
const char* const ghostsName = "vtkGhostType";
const char* const pieceFooter = "\n  </AppendedData>\n</VTKFile>\n";

std::string storedName(const StoredArray& array)
{
  return array.Step < 0 ? array.Name : array.Name + " step " + std::to_string(array.Step);
}

std::string repeatedName(const std::vector<StoredArray>& arrays)
{
  std::set<std::pair<bool, std::string>> names{ { true, pointIdsName }, { true, ghostsName },
    { false, cellIdsName }, { false, ghostsName } };
  const auto found = std::find_if(arrays.begin(), arrays.end(),
    [&](const StoredArray& array)
    { return !names.emplace(array.OfPoints, storedName(array)).second; });
  return found == arrays.end() ? "" : storedName(*found);
}

bool hasWideIds(const PartitionedMesh& mesh, const PieceSummary& piece)
{
  constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
  return storedTuples(mesh, piece, true) > most ||
    storedTuples(mesh, piece, false) > most / mesh.CellSize;
}

std::vector<PieceArray> pieceArrays(const PartitionedMesh& mesh, const PieceSummary& piece)
{
  const Scalar local = hasWideIds(mesh, piece) ? Scalar::Int64 : Scalar::Int32;
  std::vector<PieceArray> arrays{
    { PieceRole::Points, "Points", mesh.PointType, 3, -1 },
    { PieceRole::PointIds, pointIdsName, Scalar::Int64, 1, -1 },
    { PieceRole::PointGhosts, ghostsName, Scalar::UInt8, 1, -1 },
  };
  const auto addData = [&](bool ofPoints)
  {
    for (std::size_t i = 0; i < mesh.Arrays.size(); ++i)
    {
      const StoredArray& data = mesh.Arrays[i];
      if (data.OfPoints == ofPoints)
      {
        arrays.push_back({ ofPoints ? PieceRole::PointData : PieceRole::CellData, storedName(data),
          data.Type, data.Components, std::int64_t(i) });
      }
    }
  };
  addData(true);
  arrays.push_back({ PieceRole::Connectivity, "connectivity", local, mesh.CellSize, -1 });
  arrays.push_back({ PieceRole::Offsets, "offsets", local, 1, -1 });
  arrays.push_back({ PieceRole::Types, "types", Scalar::UInt8, 1, -1 });
  arrays.push_back({ PieceRole::CellIds, cellIdsName, Scalar::Int64, 1, -1 });
  if (mesh.Duplicated)
  {
    arrays.push_back({ PieceRole::CellGhosts, ghostsName, Scalar::UInt8, 1, -1 });
  }
  addData(false);
  return arrays;
}

std::int64_t storedTuples(const PartitionedMesh& mesh, const PieceSummary& piece, bool ofPoints)
{
  return ofPoints ? piece.Points + piece.GhostPoints
                  : piece.Cells + (mesh.Duplicated ? piece.BorrowedCells : 0);
}

PieceLayout layOutPiece(const PartitionedMesh& mesh, std::size_t number, const PieceSummary& piece,
  const PieceSummary* room)
{
  PieceLayout layout;
  layout.Arrays = pieceArrays(mesh, piece);
  // Each array starts at a multiple of 8, relative to the appended data, after its size.
  std::uint64_t at = hdfPartOf(mesh, piece, layout, 0).size();
  for (const PieceArray& array : layout.Arrays)
  {
    at += 8;
    layout.Offsets.push_back(at);
    layout.End = at +
      std::uint64_t(storedTuples(mesh, room ? *room : piece, array.ofPoints())) *
        array.tupleBytes();
    at = (layout.End + 7) / 8 * 8;
  }
  std::string& header = layout.Header;
  header = headerText(mesh, number, piece, layout);
  // HDF5 looks for its part of a file at these positions. It begins after the underscore.
  const std::size_t size = room ? headerText(mesh, number, *room, layout).size() : header.size();
  std::size_t base = 512;
  while (base < size + 1)
  {
    base *= 2;
  }
  header.append(base - 1 - header.size(), ' ');
  header += '_' + hdfPartOf(mesh, piece, layout, base);
  for (std::uint64_t& offset : layout.Offsets)
  {
    offset += base;
  }
  layout.End += base;
  return layout;
}

std::string pvtuText(const PartitionedMesh& mesh)
{
  std::string text = startOf("PUnstructuredGrid");
  text += "  <PUnstructuredGrid GhostLevel=\"" + std::string(mesh.Duplicated ? "1" : "0") + "\">\n";
  text += sections(pieceArrays(mesh, PieceSummary()), nullptr);
  for (std::size_t i = 0; i < mesh.Pieces.size(); ++i)
  {
    text += "    <Piece Source=\"" + pieceName(i) + "\"/>\n";
  }
  return text + "  </PUnstructuredGrid>\n</VTKFile>\n";
}

} // namespace tipp
