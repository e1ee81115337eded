// SPDX-License-Identifier: BSD-3-Clause
#include "Flat/RawVtkFile.h"

#include "Files/IOError.h"
#include "Files/TextFile.h"
#include "Files/VtkXml.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>
#include <type_traits>
#include <utility>

namespace tipp
{

std::string otherVtkAdvice([[maybe_unused]] const std::string& path)
{
#ifdef TIPP_WITHOUT_VTK
  return "with PyVista, pyvista.read('" + path + "') reads it.";
#else
  return "'tipp flatten' makes a flat mesh of it.";
#endif
}

namespace
{

using Tag = XmlScanner::Tag;

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
    const std::string extension = extensionOf(file.path());
    this->Header.Kind = extension == ".vtp" ? "PolyData"
      : extension == ".vti"                 ? "ImageData"
                                            : "UnstructuredGrid";
  }

  RawVtkFile read()
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
    this->fail(problem + "; " + otherVtkAdvice(this->File.path()));
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
    else if (tag.Name == this->Header.Kind)
    {
      this->takeGrid(tag);
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

  bool isSection(const std::string& name)
  {
    return name == "PointData" || name == "CellData" || name == "Points" || this->cellsOf(name);
  }

  /// The cells of a section; null if it has none.
  RawCells* cellsOf(const std::string& section)
  {
    RawVtkFile& h = this->Header;
    const bool isPolyData = h.Kind == "PolyData";
    return section == (isPolyData ? "Polys" : "Cells") ? &h.Cells
      : isPolyData && section == "Verts"               ? &h.Vertices
      : isPolyData && section == "Lines"               ? &h.Lines
                                                       : nullptr;
  }

  template <std::size_t N, typename Number>
  void takeNumbers(const Tag& tag, const char* name, std::array<Number, N>& numbers) const
  {
    const std::string* const text = tag.find(name);
    std::istringstream words(text ? *text : "");
    for (Number& number : numbers)
    {
      std::string word;
      double value = 0;
      words >> word;
      const bool isNumber = parseNumber(word, value) && std::isfinite(value) &&
        (std::is_floating_point_v<Number> || std::fabs(value) <= 0x7fffffff);
      if (!isNumber)
      {
        this->fail(
          "gives no " + std::to_string(N) + " numbers as " + name + "; copy or write it again.");
      }
      number = Number(value);
    }
  }

  void takeGrid(const Tag& tag)
  {
    RawVtkFile& h = this->Header;
    if (tag.find("TimeValues"))
    {
      this->fail("holds several time steps; write one file a step, or a folder of .npy arrays.");
    }
    if (h.Kind != "ImageData")
    {
      return;
    }
    const std::string* const direction = tag.find("Direction");
    if (direction && *direction != "1 0 0 0 1 0 0 0 1")
    {
      this->refuse("holds an image whose axes are turned");
    }
    this->takeNumbers(tag, "WholeExtent", h.Extent);
    this->takeNumbers(tag, "Origin", h.Origin);
    this->takeNumbers(tag, "Spacing", h.Spacing);
  }

  void takeFile(const Tag& tag)
  {
    const std::string* const type = tag.find("type");
    const std::string* const order = tag.find("byte_order");
    const std::string* const count = tag.find("header_type");
    const std::string* const compressor = tag.find("compressor");
    if (!type || *type != this->Header.Kind)
    {
      this->refuse("is not a VTK XML file of " + this->kindInWords());
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

  std::string kindInWords() const
  {
    return this->Header.Kind == "PolyData" ? "a surface"
      : this->Header.Kind == "ImageData"   ? "an image"
                                           : "an unstructured grid";
  }

  /// The number of points or cells that the piece has, at most as many as the file has bytes.
  std::int64_t countOf(const Tag& tag, const char* name) const
  {
    const auto count = parse<std::int64_t>(tag.find(name));
    // Each element takes one byte or more, which bounds the count by the file's size.
    const auto size = std::int64_t(std::min<std::uint64_t>(
      this->File.size(), std::uint64_t(std::numeric_limits<std::int64_t>::max())));
    if (!count || *count < 0 || *count > size)
    {
      this->fail("gives no number of points or of cells that its size can hold; copy or write it "
                 "again.");
    }
    return *count;
  }

  void takePiece(const Tag& tag)
  {
    RawVtkFile& h = this->Header;
    if (h.Kind == "ImageData")
    {
      this->takeImagePiece(tag);
    }
    else
    {
      const bool isPolyData = h.Kind == "PolyData";
      h.PointCount = this->countOf(tag, "NumberOfPoints");
      h.Cells.Count = this->countOf(tag, isPolyData ? "NumberOfPolys" : "NumberOfCells");
      h.Vertices.Count = isPolyData ? this->countOf(tag, "NumberOfVerts") : 0;
      h.Lines.Count = isPolyData ? this->countOf(tag, "NumberOfLines") : 0;
      if (isPolyData && this->countOf(tag, "NumberOfStrips") > 0)
      {
        this->refuse("holds triangle strips");
      }
    }
    if (this->Pieces++ > 0)
    {
      this->refuse("holds several pieces");
    }
  }

  void takeImagePiece(const Tag& tag)
  {
    RawVtkFile& h = this->Header;
    std::array<std::int64_t, 6> extent = {};
    this->takeNumbers(tag, "Extent", extent);
    if (extent != h.Extent)
    {
      this->refuse("holds a part of an image");
    }
    double points = 1;
    double cells = 1;
    for (std::size_t i = 0; i < 6; i += 2)
    {
      const std::int64_t size = std::max<std::int64_t>(extent[i + 1] - extent[i] + 1, 0);
      points *= double(size);
      cells *= double(std::max<std::int64_t>(size - 1, 1));
    }
    if (points > double(std::int64_t(1) << 40))
    {
      this->fail("gives an image of " + shortText(points) +
        " points, more than a computer holds; copy or write it again.");
    }
    h.PointCount = std::int64_t(points);
    h.Cells.Count = points > 0 ? std::int64_t(cells) : 0;
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
    if (!type && (this->Section == "Points" || this->cellsOf(this->Section)))
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
    RawVtkFile& h = this->Header;
    if (this->Section == "PointData")
    {
      this->keepData(array, h.PointCount, h.PointData);
      return;
    }
    if (this->Section == "CellData")
    {
      this->keepCellData(array);
      return;
    }
    RawCells* const cells = this->cellsOf(this->Section);
    RawArray* const part = !cells    ? &h.Points
      : array.Name == "connectivity" ? &cells->Ids
      : array.Name == "offsets"      ? &cells->Offsets
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
    const std::int64_t tuples = cells ? cells->Count : h.PointCount;
    this->requireTuples(array, cells && part == &cells->Ids ? array.Tuples : tuples);
    *part = array;
  }

  void keepData(const RawArray& array, std::int64_t tuples, std::vector<RawArray>& data) const
  {
    if (std::any_of(data.begin(), data.end(),
          [&array](const RawArray& other) { return other.Name == array.Name; }))
    {
      this->fail("holds two arrays of the name '" + array.Name + "'; rename one of them.");
    }
    this->requireTuples(array, tuples);
    data.push_back(array);
  }

  /// Keeps what an array has for Cells: in a .vtp file, vertices and lines come first.
  void keepCellData(const RawArray& array)
  {
    RawVtkFile& h = this->Header;
    const std::int64_t others = h.Vertices.Count + h.Lines.Count;
    this->keepData(array, others + h.Cells.Count, h.CellData);
    RawArray& kept = h.CellData.back();
    kept.Offset += std::uint64_t(others) * kept.tupleBytes();
    kept.Tuples = h.Cells.Count;
  }

  void requireTuples(const RawArray& array, std::int64_t tuples) const
  {
    if (array.Tuples != tuples)
    {
      this->fail("holds array '" + array.Name + "' with " + std::to_string(array.Tuples) +
        " tuples where " + std::to_string(tuples) + " are due; copy or write it again.");
    }
  }

  /// Whether all arrays of some cells are there.
  static bool areWhole(const RawCells& cells)
  {
    return cells.Count == 0 || (!cells.Ids.Path.empty() && !cells.Offsets.Path.empty());
  }

  void requireWhole() const
  {
    const RawVtkFile& h = this->Header;
    const bool isGrid = h.Kind == "UnstructuredGrid";
    const bool hasCells = h.Kind == "ImageData" ? true
      : isGrid ? !h.Cells.Ids.Path.empty() && !h.Cells.Offsets.Path.empty() && !h.Types.Path.empty()
               : areWhole(h.Cells) && areWhole(h.Lines);
    const bool hasPoints =
      !h.Points.Path.empty() || h.Kind == "ImageData" || (!isGrid && h.PointCount == 0);
    if (!this->HasFile || this->Pieces != 1 || !hasPoints || !hasCells)
    {
      this->fail("lacks a part of " + this->kindInWords() +
        ": its points or its cells; copy or write it again.");
    }
  }

  const InputFile& File;
  RawVtkFile Header;
  std::uint64_t DataStart = 0;
  std::size_t CountSize = 4;
  std::string Section;
  int Pieces = 0;
  bool HasFile = false;
};

} // namespace

void requirePositions(const RawVtkFile& file, const std::string& path)
{
  const RawArray& points = file.Points;
  const bool isPosition =
    points.Components == 3 && (points.Type == Scalar::Float32 || points.Type == Scalar::Float64);
  if (!points.Path.empty() && !isPosition)
  {
    throw IOError(path,
      "holds points that are not three coordinates of Float32 or Float64; " + otherVtkAdvice(path));
  }
}

RawVtkFile openRawVtkFile(const InputFile& file)
{
  return HeaderReader(file).read();
}

} // namespace tipp
