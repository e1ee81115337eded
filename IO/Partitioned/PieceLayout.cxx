// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioned/PieceLayout.h"

#include <limits>

namespace tipp
{

const char* const pointIdsName = "GlobalPointIds";
const char* const cellIdsName = "GlobalCellIds";
const char* const ghostsName = "vtkGhostType";
const char* const pieceFooter = "\n  </AppendedData>\n</VTKFile>\n";

namespace
{

constexpr const char* fileStart =
  "<?xml version=\"1.0\"?>\n<VTKFile type=\"%TYPE\" version=\"1.0\" "
  "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n";

std::string startOf(const std::string& type)
{
  std::string text = fileStart;
  return text.replace(text.find("%TYPE"), 5, type);
}

std::string escaped(const std::string& text)
{
  std::string out;
  for (const char c : text)
  {
    if (c == '&' || c == '<' || c == '>' || c == '"' || static_cast<unsigned char>(c) < 0x20)
    {
      out += "&#" + std::to_string(int(static_cast<unsigned char>(c))) + ";";
    }
    else
    {
      out += c;
    }
  }
  return out;
}

/// The attributes that describe an array both in a piece and in the .pvtu.
std::string describe(const PieceArray& array)
{
  // VTK's connectivity has one component.
  const int components = array.Role == PieceRole::Connectivity ? 1 : array.Components;
  std::string text = std::string(" type=\"") + scalarName(array.Type) + "\" Name=\"" +
    escaped(array.Name) + "\" NumberOfComponents=\"" + std::to_string(components) + "\"";
  // VTK accepts global ids only in arrays of vtkIdType.
  const bool ids = array.Role == PieceRole::PointIds || array.Role == PieceRole::CellIds;
  return ids ? text + " IdType=\"1\"" : text;
}

std::string section(const std::string& name, const std::vector<std::string>& arrays)
{
  const std::string indent = "      ";
  std::string attributes;
  if (name == "PointData" || name == "PPointData")
  {
    attributes = std::string(" GlobalIds=\"") + pointIdsName + "\"";
  }
  if (name == "CellData" || name == "PCellData")
  {
    attributes = std::string(" GlobalIds=\"") + cellIdsName + "\"";
  }
  std::string text = indent + "<" + name + attributes + ">\n";
  for (const std::string& array : arrays)
  {
    text += indent;
    text += "  ";
    text += array;
  }
  return text + indent + "</" + name + ">\n";
}

bool isIn(const std::string& name, PieceRole role)
{
  switch (role)
  {
    case PieceRole::Points:
      return name == "Points";
    case PieceRole::PointIds:
    case PieceRole::PointGhosts:
    case PieceRole::PointData:
      return name == "PointData";
    case PieceRole::Connectivity:
    case PieceRole::Offsets:
    case PieceRole::Types:
      return name == "Cells";
    default:
      return name == "CellData";
  }
}

std::string pieceSections(const PieceLayout& layout)
{
  std::string text;
  for (const std::string name : { "Points", "PointData", "Cells", "CellData" })
  {
    std::vector<std::string> lines;
    for (std::size_t a = 0; a < layout.Arrays.size(); ++a)
    {
      const PieceArray& array = layout.Arrays[a];
      if (isIn(name, array.Role))
      {
        lines.push_back("<DataArray" + describe(array) + " format=\"appended\" offset=\"" +
          std::to_string(layout.Offsets[a] - 8) + "\"/>\n");
      }
    }
    text += section(name, lines);
  }
  return text;
}

/// The XML before the padding; offsets are relative to the appended data.
std::string headerText(const PartitionedMesh& mesh, std::size_t number, const PieceSummary& piece,
  const PieceLayout& layout)
{
  const std::int64_t cells = piece.Cells + (mesh.Duplicated ? piece.BorrowedCells : 0);
  std::string header = startOf("UnstructuredGrid");
  header += "  <!-- Piece " + std::to_string(number) + " of " + std::to_string(mesh.Pieces.size()) +
    " of a partitioned mesh; ../index.json tells more. -->\n";
  header += "  <UnstructuredGrid>\n    <Piece NumberOfPoints=\"" +
    std::to_string(piece.Points + piece.GhostPoints) + "\" NumberOfCells=\"" +
    std::to_string(cells) + "\">\n";
  header += pieceSections(layout);
  header += "    </Piece>\n  </UnstructuredGrid>\n  <AppendedData encoding=\"raw\">\n";
  return header;
}

} // namespace

std::string storedName(const StoredArray& array)
{
  return array.Step < 0 ? array.Name : array.Name + " step " + std::to_string(array.Step);
}

bool hasWideIds(const PartitionedMesh& mesh, const PieceSummary& piece)
{
  constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
  const std::int64_t cells = piece.Cells + (mesh.Duplicated ? piece.BorrowedCells : 0);
  return piece.Points + piece.GhostPoints > most || cells > most / mesh.CellSize;
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

std::int64_t storedTuples(
  const PartitionedMesh& mesh, const PieceSummary& piece, const PieceArray& array)
{
  if (array.ofPoints())
  {
    return piece.Points + piece.GhostPoints;
  }
  return piece.Cells + (mesh.Duplicated ? piece.BorrowedCells : 0);
}

PieceLayout layOutPiece(const PartitionedMesh& mesh, std::size_t number, const PieceSummary& piece,
  const PieceSummary* room)
{
  PieceLayout layout;
  layout.Arrays = pieceArrays(mesh, piece);
  // Each array starts at a multiple of 8, relative to the appended data, after its size.
  std::uint64_t at = 0;
  for (const PieceArray& array : layout.Arrays)
  {
    at += 8;
    layout.Offsets.push_back(at);
    layout.End =
      at + std::uint64_t(storedTuples(mesh, room ? *room : piece, array)) * array.tupleBytes();
    at = (layout.End + 7) / 8 * 8;
  }
  std::string& header = layout.Header;
  header = headerText(mesh, number, piece, layout);
  // The data begin after the underscore, at a multiple of 8 in the file.
  const std::size_t size = room ? headerText(mesh, number, *room, layout).size() : header.size();
  header.append(size + 7 - size % 8 - header.size(), ' ');
  header += '_';
  for (std::uint64_t& offset : layout.Offsets)
  {
    offset += header.size();
  }
  layout.End += header.size();
  return layout;
}

std::string pvtuText(const PartitionedMesh& mesh)
{
  std::string text = startOf("PUnstructuredGrid");
  text += "  <PUnstructuredGrid GhostLevel=\"" + std::string(mesh.Duplicated ? "1" : "0") + "\">\n";
  const std::vector<PieceArray> arrays = pieceArrays(mesh, PieceSummary());
  for (const std::string name : { "Points", "PointData", "CellData" })
  {
    std::vector<std::string> lines;
    for (const PieceArray& array : arrays)
    {
      if (isIn(name, array.Role))
      {
        lines.push_back("<PDataArray" + describe(array) + "/>\n");
      }
    }
    text += section("P" + name, lines);
  }
  for (std::size_t i = 0; i < mesh.Pieces.size(); ++i)
  {
    text += "    <Piece Source=\"" + pieceName(i) + "\"/>\n";
  }
  return text + "  </PUnstructuredGrid>\n</VTKFile>\n";
}

} // namespace tipp
