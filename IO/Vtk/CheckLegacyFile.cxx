// SPDX-License-Identifier: BSD-3-Clause
#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Files/TextFile.h"
#include "Vtk/ReadDataSet.h"
#include "Vtk/VtkMessages.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
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
    else if (isCells(key))
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

  static bool isCells(const std::string& key)
  {
    return key == "cells" || key == "vertices" || key == "lines" || key == "polygons" ||
      key == "triangle_strips";
  }

  static bool isType(const std::string& word)
  {
    const std::array<const char*, 18> types = { "bit", "char", "signed_char", "unsigned_char",
      "short", "unsigned_short", "int", "unsigned_int", "long", "unsigned_long", "vtktypeint64",
      "vtktypeuint64", "vtkidtype", "float", "double", "string", "utf8_string", "variant" };
    return std::find(types.begin(), types.end(), word) != types.end();
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

} // namespace

void checkLegacyFile(const std::string& path)
{
  LegacyCheck(path).run();
}

} // namespace tipp
