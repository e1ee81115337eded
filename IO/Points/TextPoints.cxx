// SPDX-License-Identifier: BSD-3-Clause
#include "Points/TextPoints.h"

#include "Files/IOError.h"
#include "Files/TextFile.h"
#include "Points/ColumnChoice.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

namespace tipp
{
namespace
{

using Fields = std::vector<std::string_view>;

char findDelimiter(std::string_view line)
{
  for (const char candidate : { ';', ',', '\t' })
  {
    if (line.find(candidate) != std::string_view::npos)
    {
      return candidate;
    }
  }
  return ' ';
}

bool isMissing(std::string_view field)
{
  field = trimField(field);
  return field.empty() || field == "NA" || field == "N/A" || field == "null" || field == "-";
}

class TextPointReader
{
public:
  TextPointReader(const std::string& path, const std::string& text)
    : Path(path)
    , Lines(text)
  {
  }

  PointTable read(const PointOptions& options)
  {
    this->readStart();
    this->chooseColumns(options);
    const auto limit = std::size_t(this->Lines.remainingLines()) + 1;
    this->Table.XY.reserve(2 * limit);
    for (Further& further : this->Furthers)
    {
      further.Values.reserve(limit);
    }
    do
    {
      this->addRow();
    } while (this->nextLine());
    this->checkCount();
    this->keepNumericColumns();
    return std::move(this->Table);
  }

private:
  struct Further
  {
    std::size_t Index;
    std::string Name;
    std::vector<double> Values;
    bool HasNumber = false;
  };

  bool nextLine()
  {
    while (this->Lines.next(this->Line))
    {
      const std::size_t start = this->Line.find_first_not_of(" \t");
      if (start != std::string_view::npos && this->Line[start] != '#')
      {
        return true;
      }
    }
    return false;
  }

  void split()
  {
    // Files with blanks between columns may have one at the end of a line, too.
    const std::string_view line = this->Delimiter == ' ' ? this->Line : trimEnd(this->Line);
    splitFields(line, this->Delimiter, this->Row);
  }

  static std::string_view trimEnd(std::string_view line)
  {
    while (!line.empty() && line.back() == ' ')
    {
      line.remove_suffix(1);
    }
    return line;
  }

  // Stops with the first point's fields in Row.
  void readStart()
  {
    this->requireLine();
    this->Delimiter = findDelimiter(this->Line);
    this->split();
    std::int64_t count = 0;
    if (this->Row.size() == 1 && parseInteger(this->Row[0], count))
    {
      this->Count = count;
      this->requireLine();
    }
    else if (this->startsWithNames())
    {
      const std::string_view header = this->Line;
      this->requireLine();
      this->Delimiter = findDelimiter(this->Line);
      splitFields(header, this->Delimiter, this->Row);
      for (const std::string_view name : this->Row)
      {
        this->Names.emplace_back(trimField(name));
      }
    }
    this->Delimiter = findDelimiter(this->Line);
    this->split();
    if (this->Names.size() != this->Row.size())
    {
      this->Names.clear(); // a title
    }
  }

  // A point has two numbers at least; names may hold one, as a year.
  bool startsWithNames() const
  {
    double value;
    return std::count_if(this->Row.begin(), this->Row.end(),
             [&](std::string_view field) { return parseNumber(field, value); }) < 2;
  }

  void requireLine()
  {
    if (!this->nextLine())
    {
      throw IOError(this->Path, "holds no points; give a file with one point a line.");
    }
  }

  void chooseColumns(const PointOptions& options)
  {
    this->Width = this->Row.size();
    this->Choice = tipp::chooseColumns(this->Path, this->Names, this->Width, options);
    for (std::size_t i = 0; i < this->Width; ++i)
    {
      if (i != this->Choice.X && i != this->Choice.Y)
      {
        const std::string plain = this->Furthers.empty() ? "z" : "column" + std::to_string(i);
        const bool named = !this->Names.empty() && !this->Names[i].empty();
        this->Furthers.push_back({ i, named ? this->Names[i] : plain, {} });
      }
    }
  }

  void addRow()
  {
    this->split();
    if (this->Row.size() != this->Width)
    {
      throw IOError(this->Path, this->Lines.lineNumber(),
        "has " + std::to_string(this->Row.size()) + " columns where the first point has " +
          std::to_string(this->Width) + "; correct or remove the line.");
    }
    this->Table.XY.push_back(this->coordinate(this->Choice.X));
    this->Table.XY.push_back(this->coordinate(this->Choice.Y));
    for (std::size_t i = 0; i < this->Furthers.size();)
    {
      i += this->addValue(this->Furthers[i]) ? 1 : this->drop(i);
    }
  }

  double coordinate(std::size_t index) const
  {
    double value = 0;
    if (!parseNumber(this->Row[index], value))
    {
      constexpr std::size_t shown = 40;
      throw IOError(this->Path, this->Lines.lineNumber(),
        "'" + std::string(trimField(this->Row[index]).substr(0, shown)) +
          "' is not a number; correct the line or choose other columns for x and y.");
    }
    return value;
  }

  bool addValue(Further& further) const
  {
    double value = std::numeric_limits<double>::quiet_NaN();
    const std::string_view field = this->Row[further.Index];
    if (parseNumber(field, value))
    {
      further.HasNumber = true;
    }
    else if (!isMissing(field))
    {
      return false;
    }
    further.Values.push_back(value);
    return true;
  }

  std::size_t drop(std::size_t i)
  {
    this->Furthers.erase(this->Furthers.begin() + std::ptrdiff_t(i));
    return 0;
  }

  void checkCount() const
  {
    const auto points = std::int64_t(this->Table.size());
    if (this->Count && *this->Count != points)
    {
      throw IOError(this->Path,
        "announces " + std::to_string(*this->Count) + " points in its first line and holds " +
          std::to_string(points) + "; copy it again or correct the line.");
    }
  }

  void keepNumericColumns()
  {
    for (Further& further : this->Furthers)
    {
      if (further.HasNumber)
      {
        this->Table.Columns.push_back({ std::move(further.Name), std::move(further.Values) });
      }
    }
  }

  const std::string& Path;
  LineReader Lines;
  std::string_view Line;
  char Delimiter = ' ';
  Fields Row;
  std::size_t Width = 0;
  std::optional<std::int64_t> Count;
  std::vector<std::string> Names;
  ColumnChoice Choice;
  std::vector<Further> Furthers;
  PointTable Table;
};

} // namespace

PointTable readTextPoints(const std::string& path, const PointOptions& options)
{
  const std::string text = readTextFile(path);
  return TextPointReader(path, text).read(options);
}

} // namespace tipp
