// SPDX-License-Identifier: BSD-3-Clause
// Writes known points as a table with the vices of tables as they are found, and reads them again.
// The table may be refused; but if it is read, all its points must be right, and a height may only
// be missing where its field holds none.
#include "Files/IOError.h"
#include "FuzzDriver.h"
#include "Points/ReadPoints.h"
#include "ScratchFile.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

namespace
{

using namespace tipp;

struct Column
{
  enum Kind
  {
    X,
    Y,
    Z,
    Id,
    Code,
    Value
  };
  Kind Is;
  std::string Name;
  std::vector<std::string> Fields;
};

/// A table with its truth.
struct Table
{
  std::string Text;
  std::vector<double> XYZ; ///< z is NaN if its field holds no number
  bool HasHeights = true;
};

class TableMaker
{
public:
  explicit TableMaker(std::mt19937_64& random)
    : Random(random)
  {
  }

  Table make()
  {
    this->chooseStyle();
    this->makeColumns();
    Table table;
    table.Text = this->text();
    table.XYZ = this->XYZ;
    table.HasHeights = this->HasHeights;
    return table;
  }

private:
  std::size_t below(std::size_t count) { return std::size_t(this->Random() % count); }
  bool oneIn(std::size_t count) { return this->below(count) == 0; }

  template <typename List>
  std::string anyOf(const List& list)
  {
    return list[this->below(std::size(list))];
  }

  void chooseStyle()
  {
    this->Rows = 1 + this->below(9);
    this->Delimiter = ",;\t "[this->below(4)];
    this->HasCommas = this->Delimiter != ',' && this->oneIn(4);
    this->Decimals = int(this->below(5));
    this->HasHeights = !this->oneIn(8);
    this->IsQuoted = this->oneIn(8);
    this->HasNames = !this->oneIn(5);
    this->LineEnd = this->oneIn(6) ? "\r\n" : this->oneIn(20) ? "\r" : "\n";
  }

  std::string number(double value, double& read)
  {
    char text[64];
    const bool hasExponent = this->oneIn(12);
    std::snprintf(text, sizeof text, hasExponent ? "%.*e" : "%.*f",
      hasExponent ? 10 + this->Decimals : this->Decimals, value);
    read = std::strtod(text, nullptr);
    std::string result = text;
    for (char& c : result)
    {
      c = c == '.' && this->HasCommas                    ? ','
        : c == 'e' && !this->HasCommas && this->oneIn(2) ? 'D'
                                                         : c;
    }
    return value > 0 && this->oneIn(30) ? "+" + result : result;
  }

  /// A field of the heights; sets `read` to NaN if it is no number.
  std::string height(double value, double& read)
  {
    const char* const words[] = { "NULL", "None", "n/a", "#N/A", "*", "\\N", "1.#QNAN", "nan", "NA",
      "-1.#IND", "-", "****" };
    const char* const texts[] = { "12.3m", "bad", "1.2.3", "5'", "1 m", "~5", "1/2", "12:30" };
    if (this->HasMissing && this->oneIn(4))
    {
      read = std::nan("");
      return this->Delimiter != ' ' && this->oneIn(3) ? ""
        : this->Delimiter != ' ' && this->oneIn(4)    ? this->anyOf(texts)
                                                      : this->anyOf(words);
    }
    return this->number(value, read);
  }

  std::string code()
  {
    const char* const codes[] = { "EP", "TOP", "pipe", "tree 5", "", "7", "B2", "W-1" };
    const char* const difficult[] = { "\"5\"\" pipe, north\"", "\"a;b\"", "\"a, b\"", "\"x\ty\"",
      "\"\"", "\"say \"\"no\"\"\"" };
    std::string code = this->anyOf(codes);
    if (this->Delimiter == ' ')
    {
      return code.empty() || code.find(' ') != std::string::npos ? "none" : code;
    }
    return this->oneIn(6) ? this->anyOf(difficult) : code;
  }

  void makeColumns()
  {
    this->HasMissing = this->oneIn(3);
    const char* const pairs[][2] = { { "x", "y" }, { "X", "Y" }, { "Easting", "Northing" },
      { "E", "N" }, { "POINT_X", "POINT_Y" }, { "lon", "lat" }, { "Longitude", "Latitude" },
      { "RD_X", "RD_Y" }, { "easting_m", "northing_m" }, { "decimalLongitude", "decimalLatitude" },
      { "X (m)", "Y (m)" }, { "x coord", "y coord" } };
    const char* const heights[] = { "z", "Z", "Elevation", "height", "ELEV", "h", "Depth", "alt",
      "z_m", "Height [m]" };
    const char* const ids[] = { "id", "ID", "Point", "OBJECTID", "fid", "Pt No", "nr", "" };
    const char* const codes[] = { "code", "Description", "remark", "name" };
    const char* const values[] = { "q", "intensity", "sigma", "R", "time" };
    const auto& pair = pairs[this->below(std::size(pairs))];
    Column x{ Column::X, pair[0], {} };
    Column y{ Column::Y, pair[1], {} };
    Column z{ Column::Z, this->anyOf(heights), {} };
    Column id{ Column::Id, this->anyOf(ids), {} };
    this->HasEmptyName = id.Name.empty() && this->Delimiter != ' ';
    id.Name += id.Name.empty() && this->Delimiter == ' ' ? "id" : "";
    Column code{ Column::Code, this->anyOf(codes), {} };
    Column value{ Column::Value, this->anyOf(values), {} };
    std::size_t last = this->below(200);
    for (std::size_t i = 0; i < this->Rows; ++i)
    {
      double truth[3];
      double ignored;
      x.Fields.push_back(this->number(500000 + double(this->below(100000)) / 100, truth[0]));
      y.Fields.push_back(this->number(4000000 + double(this->below(100000)) / 100, truth[1]));
      z.Fields.push_back(this->height(double(this->below(20000)) / 100 - 50, truth[2]));
      last += this->oneIn(4) ? 1 + this->below(5) : 1;
      id.Fields.push_back((this->oneIn(3) && this->IsQuoted ? "P" : "") + std::to_string(last));
      code.Fields.push_back(this->code());
      value.Fields.push_back(this->number(double(this->below(1000)) / 10, ignored));
      this->XYZ.insert(this->XYZ.end(), { truth[0], truth[1], truth[2] });
    }
    const bool isSwapped = this->HasNames && this->oneIn(3);
    this->Columns = isSwapped ? std::vector<Column>{ y, x } : std::vector<Column>{ x, y };
    if (this->HasHeights)
    {
      this->Columns.push_back(z);
    }
    if (this->oneIn(2))
    {
      this->Columns.insert(this->Columns.begin(), id);
    }
    // Without names, further columns come after the heights.
    if (this->oneIn(3) && (this->HasNames || this->HasHeights))
    {
      this->Columns.push_back(value);
    }
    if (this->oneIn(3) && (this->HasNames || this->HasHeights))
    {
      this->Columns.push_back(code);
    }
    if (this->HasNames && this->oneIn(5))
    {
      std::shuffle(this->Columns.begin(), this->Columns.end(), this->Random);
    }
  }

  std::string joined(const std::vector<std::string>& fields, char delimiter) const
  {
    std::string line;
    for (std::size_t i = 0; i < fields.size(); ++i)
    {
      line += (i == 0 ? "" : std::string(1, delimiter)) + fields[i];
    }
    return line;
  }

  std::string quoted(const std::string& field) const
  {
    return this->IsQuoted && (field.empty() || field[0] != '"') ? "\"" + field + "\"" : field;
  }

  std::string header()
  {
    std::vector<std::string> names;
    for (const Column& column : this->Columns)
    {
      names.push_back(this->quoted(column.Name));
    }
    const bool isPlain = !this->IsShort && !this->HasLongTexts && !this->HasTrailing &&
      this->Columns.back().Is != Column::Code && !this->HasEmptyName &&
      !(this->Columns.back().Is == Column::Z && this->HasMissing);
    if (isPlain && this->oneIn(20))
    {
      names.erase(names.begin() + std::ptrdiff_t(this->below(names.size())));
    }
    else if (isPlain && this->oneIn(30))
    {
      names.insert(names.begin() + std::ptrdiff_t(this->below(names.size() + 1)), "extra");
    }
    char delimiter = this->oneIn(8) ? ",;\t "[this->below(4)] : this->Delimiter;
    delimiter = this->HasEmptyName && delimiter == ' ' ? this->Delimiter : delimiter;
    std::string line = this->joined(names, delimiter);
    line += this->oneIn(10) && delimiter != ' ' ? std::string(1, delimiter) : "";
    line += this->oneIn(25) ? " # made by a program" : "";
    const char* const marks[] = { "# ", "#", "// ", "//", "% ", "! ", "; " };
    return this->oneIn(6) && !this->HasEmptyName ? this->anyOf(marks) + line : line;
  }

  std::string row(std::size_t i)
  {
    std::vector<std::string> fields;
    for (const Column& column : this->Columns)
    {
      fields.push_back(this->quoted(column.Fields[i]));
    }
    if (this->IsShort && this->Columns.back().Is == Column::Code)
    {
      fields.pop_back();
    }
    // A field too many or too few cannot be found where the last texts are left out, too.
    if (!this->IsShort && !this->HasLongTexts && !this->HasTrailing && this->Rows > 2 &&
      !this->IsDamaged && this->oneIn(80))
    {
      this->IsDamaged = true;
      const auto at = fields.begin() + std::ptrdiff_t(this->below(fields.size()));
      if (this->oneIn(2))
      {
        fields.erase(at);
      }
      else
      {
        fields.insert(at, "9");
      }
    }
    std::string line = this->joined(fields, this->Delimiter);
    if (this->HasLongTexts && this->Columns.back().Is == Column::Code && !this->IsQuoted)
    {
      line += std::string(1, this->Delimiter) + " north" + std::string(1, this->Delimiter) + "5";
    }
    line += this->HasTrailing ? std::string(1, this->Delimiter) : "";
    line += this->oneIn(60) ? " # checked" : "";
    return line;
  }

  void addLine(const std::string& line) { this->Text += line + this->LineEnd; }

  void addLinesAbove()
  {
    const char* const titles[] = { "Survey of the pit", "Job: 7", "# made by a program", "",
      "% note", "Export, 2020-05-01", "// end", "Project Alpha, phase 2, north" };
    for (std::size_t i = this->oneIn(4) ? 1 + this->below(2) : 0; i > 0; --i)
    {
      this->addLine(this->anyOf(titles));
    }
  }

  std::string text()
  {
    this->Text = this->oneIn(10) ? "\xef\xbb\xbf" : "";
    this->HasTrailing = this->oneIn(8);
    this->IsShort = this->oneIn(10);
    this->HasLongTexts = this->oneIn(10);
    this->addLinesAbove();
    if (this->HasNames)
    {
      this->addLine(this->header());
      if (this->oneIn(15))
      {
        this->addLine(
          this->joined(std::vector<std::string>(this->Columns.size(), "m"), this->Delimiter));
      }
    }
    if (this->oneIn(15))
    {
      this->addLine(std::to_string(this->Rows));
    }
    for (std::size_t i = 0; i < this->Rows; ++i)
    {
      this->addLine(this->row(i));
      if (this->oneIn(30))
      {
        this->addLine(this->oneIn(2) ? "# comment" : "");
      }
    }
    if (this->oneIn(20))
    {
      this->Text.erase(this->Text.size() - this->LineEnd.size());
    }
    return this->Text;
  }

  std::mt19937_64& Random;
  std::size_t Rows = 0;
  char Delimiter = ',';
  bool HasCommas = false;
  int Decimals = 0;
  bool HasHeights = true;
  bool HasMissing = false;
  bool IsQuoted = false;
  bool HasNames = true;
  bool HasTrailing = false;
  bool IsShort = false;
  bool IsDamaged = false; ///< a row has a field too many or too few
  bool HasEmptyName = false;
  bool HasLongTexts = false;
  std::string LineEnd;
  std::vector<Column> Columns;
  std::vector<double> XYZ;
  std::string Text;
};

/// A file in memory where there is a folder for such files.
PointTable readInBlocks(const std::string& path)
{
  const auto stream = openPointStream({ path });
  PointTable points;
  for (const std::string& name : stream->columns())
  {
    points.Columns.push_back({ name, {} });
  }
  stream->rewind();
  for (PointBlock block; stream->next(block, 2);)
  {
    append(block, points);
  }
  return points;
}

/// What is wrong with the points; empty: nothing.
std::string compare(const Table& table, const PointTable& points)
{
  if (3 * points.size() != table.XYZ.size())
  {
    return "another number of points";
  }
  const std::vector<std::string> names = points.names();
  const std::size_t z = findElevation(names);
  bool hasHeight = false;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const double* const truth = &table.XYZ[3 * i];
    if (points.XY[2 * i] != truth[0] || points.XY[2 * i + 1] != truth[1])
    {
      return "a wrong coordinate of point " + std::to_string(i);
    }
    hasHeight = hasHeight || !std::isnan(truth[2]);
    const bool isSame = z == names.size() || points.Columns[z].Values[i] == truth[2] ||
      (std::isnan(points.Columns[z].Values[i]) && std::isnan(truth[2]));
    if (table.HasHeights && !isSame)
    {
      return "a wrong height of point " + std::to_string(i);
    }
  }
  return !table.HasHeights && z < names.size()           ? "heights that are none"
    : table.HasHeights && hasHeight && z == names.size() ? "no heights"
                                                         : "";
}

std::int64_t cases = 0;
std::int64_t refused = 0;

bool passes(std::uint64_t seed, std::uint64_t number)
{
  static const test::ScratchFile file("table.csv");
  std::mt19937_64 random(seed * 1000003 + number);
  const Table table = TableMaker(random).make();
  const std::string path = file.write(table.Text);
  std::string problem;
  ++cases;
  try
  {
    problem = compare(table, readPoints(path));
    if (problem.empty() && number % 8 == 0)
    {
      problem = compare(table, readInBlocks(path));
    }
  }
  catch (const IOError& error)
  {
    ++refused;
    if (std::getenv("TIPP_SHOW_REFUSALS"))
    {
      std::printf("%s\n%s\n", error.what(), table.Text.c_str());
    }
  }
  if (!problem.empty())
  {
    std::printf("case %llu of seed %llu: %s in\n%s\n", static_cast<unsigned long long>(number),
      static_cast<unsigned long long>(seed), problem.c_str(), table.Text.c_str());
  }
  return problem.empty();
}

} // namespace

int main(int argc, char** argv)
{
  const int result = tipp::test::fuzz("fuzzTables", argc, argv, passes);
  std::printf("%lld of %lld tables were refused\n", static_cast<long long>(refused),
    static_cast<long long>(cases));
  return result;
}
