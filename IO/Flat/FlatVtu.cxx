// SPDX-License-Identifier: BSD-3-Clause
// Flat meshes in .vtu files.
#include "Flat/FlatMesh.h"

#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Files/TextFile.h"
#include "Files/VtkXml.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tipp
{
namespace
{

/// The content of the XML part of a .vtu file with appended raw data. Arrays are used in place:
/// their counts have been checked against the file's size and against the byte counts before the
/// data.
struct VtuHeader
{
  FlatMesh Mesh; ///< Cells is a plain list of ids until the header is checked
  std::int64_t Points = 0;
  std::int64_t Cells = 0;
  RawArray Offsets;
  RawArray Types;
};

using Tag = XmlScanner::Tag;

/// Returns what to do with a file of another kind.
std::string advice([[maybe_unused]] const std::string& path)
{
#ifdef TIPP_WITHOUT_VTK
  return "with PyVista, pyvista.read('" + path + "') reads it.";
#else
  return "'tipp flatten' makes a flat mesh of it.";
#endif
}

template <typename Value>
std::optional<Value> parse(const std::string* text)
{
  return text ? wholeNumber<Value>(*text) : std::nullopt;
}

class HeaderReader
{
public:
  explicit HeaderReader(const InputFile& file)
    : File(file)
  {
  }

  /// Throws IOError unless the file is one piece of appended, raw, uncompressed, little-endian
  /// data.
  VtuHeader read()
  {
    constexpr std::uint64_t mostText = std::uint64_t(64) << 20;
    const XmlHead head = readXmlHead(this->File, mostText);
    this->DataStart = head.DataStart;
    if (head.DataStart == 0)
    {
      this->refuse("has no appended data");
    }
    // Checked first: in an encoded file the byte counts are meaningless.
    if (head.Encoding != "raw")
    {
      this->refuse("has appended data that are encoded, not raw");
    }
    XmlScanner scanner(head.Text);
    for (Tag tag; scanner.next(tag);)
    {
      this->take(tag);
    }
    if (scanner.failed())
    {
      this->fail("is not well-formed XML at byte " + std::to_string(scanner.position()) +
        "; copy or write it again.");
    }
    this->requireWhole();
    return std::move(this->Header);
  }

private:
  [[noreturn]] void fail(const std::string& problem) const
  {
    throw IOError(this->File.path(), problem);
  }

  [[noreturn]] void refuse(const std::string& problem) const
  {
    this->fail(problem + "; " + advice(this->File.path()));
  }

  void take(const Tag& tag)
  {
    if (tag.What == Tag::Close)
    {
      this->Section = tag.Name == this->Section ? "" : this->Section;
    }
    else if (tag.Name == "VTKFile")
    {
      this->takeFile(tag);
    }
    else if (tag.Name == "UnstructuredGrid" && tag.find("TimeValues"))
    {
      this->fail("holds several time steps; write one file a step, or a folder of .npy arrays.");
    }
    else if (tag.Name == "Piece")
    {
      this->takePiece(tag);
    }
    else if (tag.What == Tag::Open && isSection(tag.Name))
    {
      this->Section = tag.Name;
    }
    else if ((tag.Name == "DataArray" || tag.Name == "Array") && !this->Section.empty())
    {
      this->takeArray(tag);
    }
  }

  static bool isSection(const std::string& name)
  {
    return name == "PointData" || name == "CellData" || name == "Points" || name == "Cells";
  }

  void takeFile(const Tag& tag)
  {
    const std::string* const type = tag.find("type");
    const std::string* const order = tag.find("byte_order");
    const std::string* const count = tag.find("header_type");
    const std::string* const compressor = tag.find("compressor");
    if (!type || *type != "UnstructuredGrid")
    {
      this->refuse("is not a VTK XML file of an unstructured grid");
    }
    if (!order || *order != "LittleEndian")
    {
      this->refuse("does not say that it is little-endian");
    }
    if (compressor && !compressor->empty())
    {
      this->refuse("is compressed; only uncompressed data can be read");
    }
    if (count && *count != "UInt32" && *count != "UInt64")
    {
      this->fail("has header_type '" + *count + "', which is neither UInt32 nor UInt64.");
    }
    this->CountSize = count && *count == "UInt64" ? 8 : 4;
    this->HasFile = true;
  }

  void takePiece(const Tag& tag)
  {
    const auto points = parse<std::int64_t>(tag.find("NumberOfPoints"));
    const auto cells = parse<std::int64_t>(tag.find("NumberOfCells"));
    // Each element takes one byte or more, which bounds the count by the file's size.
    const auto size = std::int64_t(std::min<std::uint64_t>(
      this->File.size(), std::uint64_t(std::numeric_limits<std::int64_t>::max())));
    if (!points || !cells || *points < 0 || *cells < 0 || *points > size || *cells > size)
    {
      this->fail("gives no number of points or of cells that its size can hold; copy or write it "
                 "again.");
    }
    if (this->Pieces++ > 0)
    {
      this->refuse("holds several pieces");
    }
    this->Header.Points = *points;
    this->Header.Cells = *cells;
  }

  std::optional<Scalar> scalarOf(const Tag& tag) const
  {
    const std::string* const type = tag.find("type");
    const std::optional<Scalar> scalar = type ? scalarFromName(*type) : std::nullopt;
    if (scalar)
    {
      return scalar;
    }
    if (type && *type == "String")
    {
      return std::nullopt;
    }
    this->fail("holds an array of type '" + (type ? *type : "") + "', which is no type of number.");
  }

  /// The array's position in the file; the byte count before its data gives the number of tuples.
  RawArray locate(const Tag& tag, Scalar type, const std::string& name) const
  {
    const std::string* const format = tag.find("format");
    if (!format || *format != "appended")
    {
      this->refuse("holds array '" + name + "' outside its appended data");
    }
    const auto offset = parse<std::uint64_t>(tag.find("offset"));
    const std::string* const given = tag.find("NumberOfComponents");
    const auto components = given ? parse<int>(given) : std::make_optional(1);
    constexpr int limit = std::numeric_limits<int>::max() / 8;
    const std::uint64_t room = this->File.size() - this->DataStart;
    if (!offset || *offset > room || room - *offset < this->CountSize || !components ||
      *components < 1 || *components > limit)
    {
      this->fail("holds array '" + name + "' with an offset or a number of components that its " +
        "size cannot hold; copy or write it again.");
    }
    RawArray array{ name, this->File.path(), this->DataStart + *offset + this->CountSize, type,
      *components, 0 };
    std::uint64_t bytes = 0;
    this->File.read(array.Offset - this->CountSize, &bytes, this->CountSize);
    if (bytes > this->File.size() - array.Offset || bytes % array.tupleBytes() != 0)
    {
      this->fail("holds array '" + name + "' with a count of " + std::to_string(bytes) +
        " bytes, more than the file has left or no whole number of tuples; copy or write it "
        "again.");
    }
    array.Tuples = std::int64_t(bytes / array.tupleBytes());
    return array;
  }

  void takeArray(const Tag& tag)
  {
    if (this->Pieces != 1)
    {
      this->fail("holds an array outside a piece; copy or write it again.");
    }
    const std::string* const given = tag.find("Name");
    const std::string name = given ? *given : "";
    const std::optional<Scalar> type = this->scalarOf(tag);
    if (!type && (this->Section == "Points" || this->Section == "Cells"))
    {
      this->fail("holds strings where its mesh should be; write it again.");
    }
    if (!type)
    {
      return;
    }
    if (tag.find("TimeStep"))
    {
      this->fail("holds several time steps; write one file a step, or a folder of .npy arrays.");
    }
    this->keep(this->locate(tag, *type, name));
  }

  void keep(const RawArray& array)
  {
    VtuHeader& h = this->Header;
    const bool ofPoints = this->Section == "PointData" || this->Section == "Points";
    const std::int64_t tuples = ofPoints ? h.Points : h.Cells;
    if (this->Section == "PointData" || this->Section == "CellData")
    {
      std::vector<RawArray>& data = ofPoints ? h.Mesh.PointData : h.Mesh.CellData;
      if (std::any_of(data.begin(), data.end(),
            [&array](const RawArray& other) { return other.Name == array.Name; }))
      {
        this->fail("holds two arrays of the name '" + array.Name + "'; rename one of them.");
      }
      this->requireTuples(array, tuples);
      data.push_back(array);
      return;
    }
    RawArray* const part = ofPoints  ? &h.Mesh.Points
      : array.Name == "connectivity" ? &h.Mesh.Cells
      : array.Name == "offsets"      ? &h.Offsets
      : array.Name == "types"        ? &h.Types
                                     : nullptr;
    if (!part)
    {
      return;
    }
    if (!part->Path.empty())
    {
      this->fail("holds two arrays where one of '" + array.Name + "' is due; write it again.");
    }
    this->requireTuples(array, part == &h.Mesh.Cells ? array.Tuples : tuples);
    *part = array;
  }

  void requireTuples(const RawArray& array, std::int64_t tuples) const
  {
    if (array.Tuples != tuples)
    {
      this->fail("holds array '" + array.Name + "' with " + std::to_string(array.Tuples) +
        " tuples where " + std::to_string(tuples) + " are due; copy or write it again.");
    }
  }

  void requireWhole() const
  {
    const VtuHeader& h = this->Header;
    if (!this->HasFile || this->Pieces != 1 || h.Mesh.Points.Path.empty() ||
      h.Mesh.Cells.Path.empty() || h.Offsets.Path.empty() || h.Types.Path.empty())
    {
      this->fail("lacks a part of an unstructured grid: its points or its cells; copy "
                 "or write it again.");
    }
  }

  const InputFile& File;
  VtuHeader Header;
  std::uint64_t DataStart = 0;
  std::size_t CountSize = 4;
  std::string Section;
  int Pieces = 0;
  bool HasFile = false;
};

// VTK_TRIANGLE and VTK_TETRA.
constexpr int triangleType = 5;
constexpr int tetrahedronType = 10;

/// Calls check(index, value) for each value of an array, which is read block by block.
template <typename Value, typename Check>
void forEach(const InputFile& file, const RawArray& array, const Check& check)
{
  constexpr std::int64_t block = 1 << 17;
  std::vector<Value> values(std::size_t(std::min(block, array.Tuples)));
  for (std::int64_t first = 0; first < array.Tuples; first += block)
  {
    const auto size = std::size_t(std::min(block, array.Tuples - first));
    file.read(
      array.Offset + std::uint64_t(first) * sizeof(Value), values.data(), size * sizeof(Value));
    for (std::size_t i = 0; i < size; ++i)
    {
      check(first + std::int64_t(i), values[i]);
    }
  }
}

/// Returns the number of points per cell; throws IOError unless all cells are triangles or all are
/// tetrahedra.
int checkTypes(const InputFile& file, const RawArray& types)
{
  if (scalarSize(types.Type) != 1 || types.Components != 1)
  {
    throw IOError(file.path(), "holds cell types that are not one byte each; write it again.");
  }
  int first = triangleType;
  forEach<std::uint8_t>(file, types,
    [&](std::int64_t cell, std::uint8_t type)
    {
      first = cell == 0 ? type : first;
      if (type != first || (type != triangleType && type != tetrahedronType))
      {
        throw IOError(file.path(),
          "holds a cell (cell " + std::to_string(cell) + ", " + cellTypeName(type) +
            ") where all must be triangles or all tetrahedra; " + advice(file.path()));
      }
    });
  return first == triangleType ? 3 : 4;
}

template <typename Value>
void checkOffsets(const InputFile& file, const RawArray& offsets, int cellSize)
{
  forEach<Value>(file, offsets,
    [&](std::int64_t cell, Value offset)
    {
      if (std::int64_t(offset) != (cell + 1) * cellSize)
      {
        throw IOError(file.path(),
          "gives cell " + std::to_string(cell) + " other than " + std::to_string(cellSize) +
            " vertices; copy or write it again.");
      }
    });
}

bool isId(const RawArray& array)
{
  return (array.Type == Scalar::Int32 || array.Type == Scalar::Int64) && array.Components == 1;
}

} // namespace

FlatMesh openFlatVtu(const std::string& path)
{
  const InputFile file(path);
  VtuHeader header = HeaderReader(file).read();
  FlatMesh& mesh = header.Mesh;
  mesh.Path = path;
  mesh.CellSize = checkTypes(file, header.Types);
  if (!isId(header.Offsets) || !isId(mesh.Cells))
  {
    throw IOError(
      path, "holds its cells as other than 32-bit or 64-bit signed integers; " + advice(path));
  }
  header.Offsets.Type == Scalar::Int32
    ? checkOffsets<std::int32_t>(file, header.Offsets, mesh.CellSize)
    : checkOffsets<std::int64_t>(file, header.Offsets, mesh.CellSize);
  if (mesh.Cells.Tuples != header.Cells * mesh.CellSize)
  {
    throw IOError(path,
      "holds " + std::to_string(mesh.Cells.Tuples) + " vertex ids for " +
        std::to_string(header.Cells) + " cells of " + std::to_string(mesh.CellSize) +
        "; copy or write it again.");
  }
  const RawArray& points = mesh.Points;
  if (points.Components != 3 || (points.Type != Scalar::Float32 && points.Type != Scalar::Float64))
  {
    throw IOError(
      path, "holds points that are not three coordinates of Float32 or Float64; " + advice(path));
  }
  mesh.Cells.Components = mesh.CellSize;
  mesh.Cells.Tuples = header.Cells;
  return std::move(mesh);
}

bool isFlatVtu(const std::string& path)
{
  try
  {
    const InputFile file(path);
    HeaderReader(file).read();
    return true;
  }
  catch (const IOError&)
  {
    return false;
  }
}

} // namespace tipp
