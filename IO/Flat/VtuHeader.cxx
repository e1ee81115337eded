// SPDX-License-Identifier: BSD-3-Clause
#include "Flat/VtuHeader.h"

#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Flat/XmlScanner.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <optional>

namespace tipp
{
namespace
{

using Tag = XmlScanner::Tag;

constexpr const char* flatten = "; 'tipp flatten' makes a flat mesh of it.";

template <typename Value>
std::optional<Value> parse(const std::string* text)
{
  Value value{};
  if (!text)
  {
    return std::nullopt;
  }
  const char* const end = text->data() + text->size();
  const auto [stop, error] = std::from_chars(text->data(), end, value);
  return error == std::errc() && stop == end ? std::make_optional(value) : std::nullopt;
}

/// The XML text up to the appended data, and the offset of these in the file.
struct XmlPart
{
  std::string Text;
  std::size_t AppendedTag = 0; ///< offset of the tag in the text
  std::uint64_t DataStart = 0;
};

XmlPart readXmlPart(const InputFile& file)
{
  constexpr std::uint64_t limit = std::uint64_t(64) << 20;
  constexpr std::uint64_t step = 1 << 16;
  XmlPart part;
  std::size_t tag = std::string::npos;
  for (std::uint64_t at = 0; at < std::min(file.size(), limit);)
  {
    const auto bytes = std::size_t(std::min(file.size() - at, std::max(step, at)));
    const std::size_t searched = part.Text.size() - std::min<std::size_t>(part.Text.size(), 64);
    part.Text.resize(part.Text.size() + bytes);
    file.read(at, part.Text.data() + at, bytes);
    at += bytes;
    tag = tag == std::string::npos ? part.Text.find("<AppendedData", searched) : tag;
    if (tag == std::string::npos)
    {
      continue;
    }
    const std::size_t mark = part.Text.find('_', std::min(part.Text.find('>', tag), at));
    if (mark != std::string::npos)
    {
      part.DataStart = mark + 1;
      part.AppendedTag = tag;
      part.Text.resize(mark);
      return part;
    }
    // The tag or the '_' may lie in the bytes that follow, but not far away.
    if (at - tag > 4096)
    {
      break;
    }
  }
  throw IOError(file.path(), std::string("has no appended data") + flatten);
}

class HeaderReader
{
public:
  HeaderReader(const InputFile& file, VtuHeader& header)
    : File(file)
    , Header(header)
  {
  }

  void read()
  {
    const XmlPart part = readXmlPart(this->File);
    this->DataStart = part.DataStart;
    // Checked first: in an encoded file the byte counts are meaningless.
    this->requireRaw(part.Text.substr(part.AppendedTag));
    XmlScanner scanner(part.Text);
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
  }

private:
  [[noreturn]] void fail(const std::string& problem) const
  {
    throw IOError(this->File.path(), problem);
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
      this->fail(std::string("is not a VTK XML file of an unstructured grid") + flatten);
    }
    if (!order || *order != "LittleEndian")
    {
      this->fail(std::string("does not say that it is little-endian") + flatten);
    }
    if (compressor && !compressor->empty())
    {
      this->fail(std::string("is compressed, so that it cannot be read in place") + flatten);
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
      this->fail(std::string("holds several pieces") + flatten);
    }
    this->Header.Points = *points;
    this->Header.Cells = *cells;
  }

  void requireRaw(const std::string& appendedTag) const
  {
    XmlScanner scanner(appendedTag);
    Tag tag;
    const std::string* const encoding = scanner.next(tag) ? tag.find("encoding") : nullptr;
    if (!encoding || *encoding != "raw")
    {
      this->fail(std::string("has appended data that are encoded, not raw") + flatten);
    }
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
      this->fail("holds array '" + name + "' outside its appended data" + flatten);
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
    RawArray array;
    array.Name = name;
    array.Path = this->File.path();
    array.Type = type;
    array.Components = *components;
    array.Offset = this->DataStart + *offset + this->CountSize;
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
    if (this->Section == "Points")
    {
      this->keepOne(this->Header.Coordinates, array, this->Header.Points);
    }
    else if (this->Section == "PointData")
    {
      this->keepData(this->Header.PointData, array, this->Header.Points);
    }
    else if (this->Section == "CellData")
    {
      this->keepData(this->Header.CellData, array, this->Header.Cells);
    }
    else if (array.Name == "connectivity")
    {
      this->keepOne(this->Header.Connectivity, array, array.Tuples);
    }
    else if (array.Name == "offsets")
    {
      this->keepOne(this->Header.Offsets, array, this->Header.Cells);
    }
    else if (array.Name == "types")
    {
      this->keepOne(this->Header.Types, array, this->Header.Cells);
    }
  }

  void requireTuples(const RawArray& array, std::int64_t tuples) const
  {
    if (array.Tuples != tuples)
    {
      this->fail("holds array '" + array.Name + "' with " + std::to_string(array.Tuples) +
        " tuples where " + std::to_string(tuples) + " are due; copy or write it again.");
    }
  }

  void keepOne(RawArray& place, const RawArray& array, std::int64_t tuples) const
  {
    if (!place.Path.empty())
    {
      this->fail("holds two arrays where one of '" + array.Name + "' is due; write it again.");
    }
    this->requireTuples(array, tuples);
    place = array;
  }

  void keepData(std::vector<RawArray>& arrays, const RawArray& array, std::int64_t tuples) const
  {
    for (const RawArray& other : arrays)
    {
      if (other.Name == array.Name)
      {
        this->fail("holds two arrays of the name '" + array.Name + "'; rename one of them.");
      }
    }
    this->requireTuples(array, tuples);
    arrays.push_back(array);
  }

  void requireWhole() const
  {
    const VtuHeader& h = this->Header;
    if (!this->HasFile || this->Pieces != 1 || h.Coordinates.Path.empty() ||
      h.Connectivity.Path.empty() || h.Offsets.Path.empty() || h.Types.Path.empty())
    {
      this->fail("lacks a part of an unstructured grid: its points or its cells; copy "
                 "or write it again.");
    }
  }

  const InputFile& File;
  VtuHeader& Header;
  std::uint64_t DataStart = 0;
  std::size_t CountSize = 4;
  std::string Section;
  int Pieces = 0;
  bool HasFile = false;
};

} // namespace

VtuHeader readVtuHeader(const InputFile& file)
{
  VtuHeader header;
  HeaderReader(file, header).read();
  return header;
}

} // namespace tipp
