// SPDX-License-Identifier: BSD-3-Clause
#include "Vtk/ReadDataSet.h"

#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Files/TextFile.h"
#include "Files/VtkXml.h"
#include "Vtk/VtkMessages.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <vector>

namespace tipp
{
namespace
{

using Tag = XmlScanner::Tag;

constexpr const char* advised = "; copy or write it again.";

/// The maximum compression ratio of VTK's compressors except lzma.
constexpr double compression = 1100;

std::optional<std::int64_t> parseCount(std::string text)
{
  text.erase(0, text.find_first_not_of(" \t\r\n"));
  text.erase(text.find_last_not_of(" \t\r\n") + 1);
  return wholeNumber<std::int64_t>(text);
}

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

  static bool hasFormat(const Tag& tag, const char* format)
  {
    const std::string* const given = tag.find("format");
    return given && *given == format;
  }

  bool isEncodedArray(const Tag& tag) const
  {
    return tag.What == Tag::Open && (tag.Name == "DataArray" || tag.Name == "Array") &&
      hasFormat(tag, "binary");
  }

  [[noreturn]] void fail(const std::string& problem) const
  {
    throw IOError(this->File.path(), problem + advised);
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
      const std::string* const order = tag.find("byte_order");
      this->Data.IsBigEndian = order && *order == "BigEndian";
      const std::string* const header = tag.find("header_type");
      this->Data.HeaderBytes = header && *header == "UInt64" ? 8 : 4;
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
    if (hasFormat(tag, "appended"))
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
    checkLegacyFile(path);
  }
  // The names of VTK's XML kinds, and no others here, contain "vt": .vtu, .pvtu ...
  else if (isVtkFile(path) && extension.find("vt") != std::string::npos)
  {
    XmlCheck(path).run();
  }
}

} // namespace tipp
