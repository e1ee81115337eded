// SPDX-License-Identifier: BSD-3-Clause
#include "Vtk/DataSets.h"

#include "Files/Formats.h"
#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Files/TextFile.h"
#include "Files/VtkXml.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <iterator>
#include <limits>
#include <optional>
#include <string_view>
#include <tuple>
#include <vector>

namespace tipp
{
namespace
{

constexpr const char* advice = "; copy or write it again.";
using Words = std::vector<std::string_view>;

bool isBlank(char letter)
{
  return letter == ' ' || letter == '\t' || letter == '\r' || letter == '\n';
}

bool isOneOf(const std::string& word, std::initializer_list<const char*> words)
{
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// The words of a line that may be a header; none if the line is too long, as in binary data.
Words wordsOf(std::string_view line)
{
  Words words;
  if (line.size() > 512)
  {
    return words;
  }
  splitFields(line, ' ', words);
  words.resize(std::min<std::size_t>(words.size(), 6));
  return words;
}

/// Checks a legacy file (.vtk).
class LegacyCheck
{
public:
  explicit LegacyCheck(const std::string& path)
    : Path(path)
  {
    const InputFile file(path);
    this->Text.resize(file.size());
    file.read(0, this->Text.data(), this->Text.size());
  }

  void run()
  {
    const std::string_view text = this->Text;
    for (std::size_t at = 0, line = 0; at < text.size(); ++line)
    {
      const std::size_t end = std::min(text.find('\n', at), text.size());
      const Words words = wordsOf(text.substr(at, end - at));
      this->At = std::min(end + 1, text.size());
      if (line == 2)
      {
        this->Binary = !words.empty() && lowerCase(words[0]) == "binary";
      }
      if (line > 2 && words.size() > 1)
      {
        this->take(lowerCase(words[0]), words);
      }
      at = this->At;
    }
  }

private:
  [[noreturn]] void fail(const std::string& problem) const
  {
    throw IOError(this->Path, problem + advice);
  }

  /// The count in a word of the line; each item has `each` values.
  double count(const Words& words, std::size_t index, double each = 1) const
  {
    const std::optional<std::int64_t> value = index < words.size()
      ? wholeNumber<std::int64_t>(words[index])
      : std::make_optional<std::int64_t>(0);
    // VTK reports words that are not numbers.
    if (value && (*value < 0 || double(*value) * each > double(this->Text.size())))
    {
      this->fail("gives '" + shownText(std::string(words[index])) + "' after '" +
        shownText(std::string(words[index > 0 ? index - 1 : 0])) + "', which its " +
        std::to_string(this->Text.size()) + " bytes cannot hold");
    }
    return value ? double(*value) : 0;
  }

  void take(const std::string& key, const Words& words)
  {
    // For each key the word with the count, and the number of values of each item.
    const std::tuple<const char*, std::size_t, double> counts[] = { { "points", 1, 3 },
      { "cell_types", 1, 1 }, { "x_coordinates", 1, 1 }, { "y_coordinates", 1, 1 },
      { "z_coordinates", 1, 1 }, { "scalars", 3, this->Tuples },
      { "color_scalars", 2, this->Tuples }, { "texture_coordinates", 2, this->Tuples },
      { "field", 2, 1 }, { "lookup_table", 2, 1 } };
    const auto known = std::find_if(std::begin(counts), std::end(counts),
      [&key](const auto& entry) { return key == std::get<0>(entry); });
    if (known != std::end(counts))
    {
      this->count(words, std::get<1>(*known), std::get<2>(*known));
    }
    else if (isOneOf(key, { "cells", "vertices", "lines", "polygons", "triangle_strips" }))
    {
      const double cells = this->count(words, 1);
      const double size = this->count(words, 2);
      this->walk(key, std::int64_t(cells), std::int64_t(size));
    }
    else if (key == "point_data" || key == "cell_data")
    {
      this->Tuples = std::max(this->count(words, 1), 1.0);
    }
    else if (key == "dimensions")
    {
      this->takeDimensions(words);
    }
    else if (words.size() == 4 && isType(lowerCase(words[3])))
    {
      const double components = this->count(words, 1);
      this->count(words, 2, std::max(components, 1.0));
    }
  }

  static bool isType(const std::string& word)
  {
    return isOneOf(word,
      { "bit", "char", "signed_char", "unsigned_char", "short", "unsigned_short", "int",
        "unsigned_int", "long", "unsigned_long", "vtktypeint64", "vtktypeuint64", "vtkidtype",
        "float", "double", "string", "utf8_string", "variant" });
  }

  void takeDimensions(const Words& words) const
  {
    double points = 1;
    for (std::size_t axis = 1; axis < words.size() && axis < 4; ++axis)
    {
      const std::optional<std::int64_t> value = wholeNumber<std::int64_t>(words[axis]);
      if (value && (*value < 0 || *value > std::numeric_limits<int>::max()))
      {
        points = HUGE_VAL;
      }
      points *= value ? double(*value) : 1;
    }
    // Larger products of dimensions would overflow.
    if (points > 1e18)
    {
      this->fail("gives DIMENSIONS that are no number of points");
    }
  }

  /// Before version 5 cells are a list of numbers: for each cell a count, and that many ids.
  void walk(const std::string& key, std::int64_t cells, std::int64_t size)
  {
    const std::string_view rest = std::string_view(this->Text).substr(this->At);
    const Words next = wordsOf(rest.substr(0, std::min(rest.find('\n'), rest.size())));
    if (!next.empty() && lowerCase(next[0]) == "offsets")
    {
      return;
    }
    std::int64_t taken = 0;
    for (std::int64_t cell = 0; cell < cells; ++cell)
    {
      const std::optional<std::int64_t> corners = this->takeNumber();
      taken += corners ? *corners + 1 : 0;
      if (!corners || *corners < 0 || taken > size || !this->skipNumbers(*corners))
      {
        this->fail("gives " + std::to_string(cells) + " " + key + " in " + std::to_string(size) +
          " numbers, but number " + std::to_string(cell) + " does not fit into these");
      }
    }
  }

  std::optional<std::int64_t> takeNumber()
  {
    if (this->Binary)
    {
      if (this->Text.size() - this->At < 4)
      {
        return std::nullopt;
      }
      std::uint32_t value = 0;
      for (int i = 0; i < 4; ++i)
      {
        value = value << 8 | static_cast<unsigned char>(this->Text[this->At++]);
      }
      return std::int32_t(value);
    }
    const std::size_t size = this->Text.size();
    while (this->At < size && isBlank(this->Text[this->At]))
    {
      ++this->At;
    }
    const std::size_t begin = this->At;
    while (this->At < size && !isBlank(this->Text[this->At]))
    {
      ++this->At;
    }
    return wholeNumber<std::int64_t>(std::string_view(this->Text).substr(begin, this->At - begin));
  }

  bool skipNumbers(std::int64_t count)
  {
    if (this->Binary)
    {
      const bool whole = (this->Text.size() - this->At) / 4 >= std::size_t(count);
      this->At += whole ? 4 * std::size_t(count) : 0;
      return whole;
    }
    for (std::int64_t i = 0; i < count; ++i)
    {
      if (!this->takeNumber())
      {
        return false;
      }
    }
    return true;
  }

  std::string Path;
  std::string Text;
  std::size_t At = 0;
  bool Binary = false;
  double Tuples = 1; ///< number of tuples of the data that follow
};

using Tag = XmlScanner::Tag;

/// The maximum compression ratio of VTK's compressors except lzma.
constexpr double compression = 1100;

std::optional<std::int64_t> parseCount(std::string text)
{
  text.erase(0, text.find_first_not_of(" \t\r\n"));
  text.erase(text.find_last_not_of(" \t\r\n") + 1);
  return wholeNumber<std::int64_t>(text);
}

/// Checks a file of VTK's XML formats.
class XmlCheck
{
public:
  explicit XmlCheck(const std::string& path)
    : File(path)
    , Room(double(this->File.size()))
  {
  }

  void run()
  {
    const XmlHead head = readXmlHead(this->File, this->File.size());
    const std::string& text = head.Text;
    XmlScanner scanner(text);
    for (Tag tag; scanner.next(tag);)
    {
      this->take(tag);
      if (this->isEncodedArray(tag))
      {
        const std::size_t begin = scanner.position();
        this->requireWhole(this->Data.isWholeText(
          std::string_view(text).substr(begin, text.find('<', begin) - begin)));
      }
    }
    if (scanner.failed())
    {
      throw IOError(this->File.path(),
        "cannot be read as a VTK file (it is not well-formed XML at byte " +
          std::to_string(scanner.position()) + "); check that it is whole.");
    }
    if (text.size() < this->File.size())
    {
      this->requireWhole(head.DataStart > 0 &&
        this->Data.areWhole(this->File, head.DataStart, head.Encoding == "base64", this->Offsets));
    }
  }

private:
  void requireWhole(bool isWhole) const
  {
    if (!isWhole)
    {
      this->fail("has arrays that are damaged or not all there");
    }
  }

  static bool has(const Tag& tag, const char* key, const char* value)
  {
    const std::string* const given = tag.find(key);
    return given && *given == value;
  }

  bool isEncodedArray(const Tag& tag) const
  {
    return tag.What == Tag::Open && (tag.Name == "DataArray" || tag.Name == "Array") &&
      has(tag, "format", "binary");
  }

  [[noreturn]] void fail(const std::string& problem) const
  {
    throw IOError(this->File.path(), problem + advice);
  }

  [[noreturn]] void failAt(const std::string& key, const std::string& value) const
  {
    this->fail("gives " + key + "=\"" + shownText(value) + "\", which its " +
      std::to_string(this->File.size()) + " bytes cannot hold");
  }

  void take(const Tag& tag)
  {
    if (tag.What == Tag::Close)
    {
      return;
    }
    if (tag.Name == "VTKFile")
    {
      const std::string* const compressor = tag.find("compressor");
      this->Data.IsCompressed = compressor && !compressor->empty();
      this->Room *= this->Data.IsCompressed ? compression : 1;
      this->Data.IsBigEndian = has(tag, "byte_order", "BigEndian");
      this->Data.HeaderBytes = has(tag, "header_type", "UInt64") ? 8 : 4;
    }
    else if (tag.Name == "Piece")
    {
      this->takePiece(tag);
    }
    else if (tag.find("WholeExtent"))
    {
      this->Whole = this->pointsOf(tag, "WholeExtent");
    }
    else if (tag.Name == "DataArray" || tag.Name == "Array" || tag.Name == "PDataArray")
    {
      this->takeArray(tag);
    }
    else
    {
      this->Section = tag.Name;
    }
  }

  void takePiece(const Tag& tag)
  {
    if (const std::string* const source = tag.find("Source"))
    {
      const std::string path =
        (std::filesystem::path(this->File.path()).parent_path() / *source).string();
      // The reader reports a missing file.
      if (std::filesystem::is_regular_file(path) && extensionOf(path).substr(0, 2) != ".p")
      {
        checkVtkFile(path);
      }
      return;
    }
    this->Points = std::max(this->takeCount(tag, "NumberOfPoints"),
      std::max(this->Whole, tag.find("Extent") ? this->pointsOf(tag, "Extent") : 0));
    this->Cells = this->takeCount(tag, "NumberOfCells");
    for (const char* const kind :
      { "NumberOfVerts", "NumberOfLines", "NumberOfStrips", "NumberOfPolys" })
    {
      this->Cells += this->takeCount(tag, kind);
    }
  }

  double takeCount(const Tag& tag, const char* key) const
  {
    const std::string* const text = tag.find(key);
    const std::optional<std::int64_t> count = text ? parseCount(*text) : 0;
    if (!count || *count < 0 || double(*count) > this->Room)
    {
      this->failAt(key, *text);
    }
    return double(*count);
  }

  /// The number of points of an image, which has no array for them.
  double pointsOf(const Tag& tag, const char* key) const
  {
    const std::string& text = *tag.find(key);
    std::string line = text;
    std::replace(line.begin(), line.end(), '\n', ' ');
    std::vector<std::string_view> words;
    splitFields(line, ' ', words);
    std::array<double, 6> extent{};
    bool isValid = words.size() >= extent.size();
    for (std::size_t i = 0; isValid && i < extent.size(); ++i)
    {
      const std::optional<std::int64_t> value = parseCount(std::string(words[i]));
      isValid = value && std::fabs(double(*value)) <= std::numeric_limits<int>::max();
      extent[i] = isValid ? double(*value) : 0;
    }
    double points = 1;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double length = extent[2 * axis + 1] - extent[2 * axis] + 1;
      points *= std::max(length, 0.0);
      isValid = isValid && length <= std::numeric_limits<int>::max();
    }
    // Larger products of dimensions would overflow.
    if (!isValid || points > 1e18)
    {
      this->fail(
        std::string("gives ") + key + "=\"" + shownText(text) + "\", which is no range of points");
    }
    return points;
  }

  void takeArray(const Tag& tag)
  {
    double components = 1;
    if (const std::string* const text = tag.find("NumberOfComponents"))
    {
      const std::optional<std::int64_t> given = parseCount(*text);
      if (!given || *given < 0 || *given > std::numeric_limits<int>::max())
      {
        this->failAt("NumberOfComponents", *text);
      }
      components = std::max(double(*given), 1.0);
      const bool ofPoints = this->Section == "Points" || this->Section == "PPoints";
      if (ofPoints && *given != 3)
      {
        this->fail(
          "gives NumberOfComponents=\"" + shownText(*text) + "\" for its points, which have 3");
      }
    }
    if (tag.Name == "PDataArray")
    {
      this->require(components, tag);
      return;
    }
    double tuples = this->takeCount(tag, "NumberOfTuples");
    const double offset = this->takeCount(tag, "offset");
    if (has(tag, "format", "appended"))
    {
      this->Offsets.push_back(std::uint64_t(offset));
    }
    if (this->Section == "PointData" || this->Section == "Points")
    {
      tuples = std::max(this->Points, 1.0);
    }
    else if (this->Section == "CellData")
    {
      tuples = std::max(this->Cells, 1.0);
    }
    this->require(tuples * components, tag);
  }

  void require(double values, const Tag& tag) const
  {
    if (values > this->Room)
    {
      const std::string* const name = tag.find("Name");
      this->fail("gives array '" + (name ? shownText(*name) : "") + "' more values than its " +
        std::to_string(this->File.size()) + " bytes can hold");
    }
  }

  const InputFile File;
  double Room; ///< the most one-byte values that the file can hold
  double Whole = 0;
  double Points = 0;
  double Cells = 0;
  std::string Section;
  XmlDataCheck Data;
  std::vector<std::uint64_t> Offsets; ///< offsets of the arrays in the appended data
};

} // namespace

void checkVtkFile(const std::string& path)
{
  const std::string extension = extensionOf(path);
  if (extension == ".vtk")
  {
    LegacyCheck(path).run();
  }
  // The names of VTK's XML kinds, and no others here, contain "vt": .vtu, .pvtu ...
  else if (extension != ".vtkhdf" && isOpenedBy(path, Opener::Vtk) &&
    extension.find("vt") != std::string::npos)
  {
    XmlCheck(path).run();
  }
}

} // namespace tipp
