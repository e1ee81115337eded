// SPDX-License-Identifier: BSD-3-Clause
#include "Points/ReadPoints.h"

#include "Files/IOError.h"
#include "Files/TextFile.h"
#include "Points/TableRows.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <optional>
#include <utility>

namespace tipp
{
namespace
{

/// A column that may hold numbers, with what has been found in it.
struct SurveyedColumn
{
  TableRows::Column Column;
  bool IsHeight = false;
  std::vector<double> Values = {};
  std::int64_t Numbers = 0;
  std::int64_t Missing = 0; ///< words for missing values, and texts
  std::int64_t Texts = 0;
  std::int64_t Sentinels = 0;    ///< numbers such as -9999
  std::string FirstMissing = {}; ///< with its line
  std::string FirstText = {};
  std::int64_t FirstTextLine = 0;
  bool IsText = false; ///< too many texts: its values are not kept
};

/// Reads all rows, and thereby finds all errors in the file.
class TableSurvey
{
public:
  /// The values of `Columns` and `XY` stay empty unless `keepsValues`.
  TableSurvey(const std::string& path, const PointOptions& options, bool keepsValues)
    : Path(path)
    , Options(options)
    , Rows(path, options)
    , KeepsValues(keepsValues)
  {
    const std::size_t expected = keepsValues ? std::size_t(this->Rows.expectedRows()) : 0;
    this->XY.reserve(2 * expected);
    for (const TableRows::Column& column : this->Rows.further())
    {
      this->Columns.push_back({ column, this->Columns.size() == this->Rows.height() });
      this->Columns.back().Values.reserve(expected);
    }
    this->readRows();
    this->finish();
  }

  std::vector<double> XY;
  std::vector<SurveyedColumn> Columns; ///< those that hold numbers
  /// The index in Columns of the heights if they need a copy named z; Columns' size: they do not.
  std::size_t Copied = 0;
  TableReport Report;

private:
  void keep(double value, std::vector<double>& values) const
  {
    if (this->KeepsValues)
    {
      values.push_back(value);
    }
  }

  void readRows()
  {
    std::optional<PointNumberTest> test = this->Rows.numberTest();
    while (this->Rows.next())
    {
      this->addCoordinates();
      for (SurveyedColumn& column : this->Columns)
      {
        if (column.IsText)
        {
          continue;
        }
        double value = 0;
        const FieldKind kind = this->Rows.value(column.Column, value);
        if (kind == FieldKind::Number)
        {
          ++column.Numbers;
        }
        else
        {
          this->note(kind, column);
        }
        if (column.IsHeight && std::fabs(value) >= leastMark && isNoDataMark(value) &&
          value != this->Options.NoData)
        {
          ++column.Sentinels;
        }
        this->keep(value, column.Values);
      }
      this->Rows.requireOneKindOfDecimals();
      if (test)
      {
        this->Rows.add(*test);
      }
    }
    if (test && test->holdsNumbers())
    {
      this->Rows.failForNumbers();
    }
    this->Rows.requireClearCommas();
  }

  void addCoordinates()
  {
    const double x = this->Rows.x();
    const double y = this->Rows.y();
    if ((std::isnan(x) || std::isnan(y)) && this->Rows.lacksCoordinate())
    {
      this->FirstNotFinite = this->NotFinite == 0 ? this->Rows.lineNumber() : this->FirstNotFinite;
      ++this->NotFinite;
    }
    this->keep(x, this->XY);
    this->keep(y, this->XY);
  }

  /// Notes a field that is not a number.
  void note(FieldKind kind, SurveyedColumn& column)
  {
    if (kind == FieldKind::Empty)
    {
      return;
    }
    const std::string shown = "'" + TableRows::shown(this->Rows.field(column.Column)) +
      "' in line " + std::to_string(this->Rows.lineNumber());
    column.FirstMissing = column.Missing++ == 0 ? shown : column.FirstMissing;
    if (kind == FieldKind::Text)
    {
      column.FirstText = column.Texts == 0 ? shown : column.FirstText;
      if (++column.Texts > fewTexts)
      {
        this->setText(column);
      }
    }
  }

  /// Gives up a column of text, unless it is needed. Throws IOError.
  void setText(SurveyedColumn& column)
  {
    const std::string& name = column.Column.Name;
    const bool isAsked = this->Options.Columns && this->Options.wants(name);
    const bool isHeight =
      column.IsHeight && (this->Options.wants("z") || this->Options.wants(name));
    const bool isNeeded = (isHeight && (this->Rows.isNamed() || column.Numbers > 0)) ||
      (isAsked && !column.IsHeight) || (this->Options.AsIs && column.Numbers > 0);
    if (isNeeded)
    {
      throw IOError(this->Path,
        "has text that is not a number in column '" + shownText(name) + "', first " +
          column.FirstText + "; correct it, or choose another column" +
          (column.IsHeight ? " with --z." : "."));
    }
    column.IsText = true;
    std::vector<double>().swap(column.Values);
  }

  void finish()
  {
    for (SurveyedColumn& column : this->Columns)
    {
      const bool areFew = 2 * column.Texts <= column.Numbers;
      if (column.Texts > 0 && !areFew && !column.IsText)
      {
        this->setText(column);
      }
    }
    this->report();
    this->Columns.erase(std::remove_if(this->Columns.begin(), this->Columns.end(),
                          [this](const SurveyedColumn& column)
                          {
                            // All heights of segments may be missing; their columns are told by
                            // their number.
                            const bool isNeeded = this->Options.AsIs && column.Missing > 0;
                            return column.IsText || (column.Numbers == 0 && !isNeeded);
                          }),
      this->Columns.end());
    this->offerHeightsAsZ();
  }

  /// Heights under another name than z are read under both.
  void offerHeightsAsZ()
  {
    const auto height = std::find_if(this->Columns.begin(), this->Columns.end(),
      [](const SurveyedColumn& column) { return column.IsHeight; });
    this->Copied = this->Columns.size();
    if (height == this->Columns.end() || height->Column.Name == "z")
    {
      return;
    }
    for (SurveyedColumn& column : this->Columns)
    {
      column.Column.Name += column.Column.Name == "z" ? "_2" : "";
    }
    if (lowerCase(height->Column.Name) == "z")
    {
      height->Column.Name = "z";
      return;
    }
    this->Copied = std::size_t(height - this->Columns.begin());
  }

  void report()
  {
    this->Report.Path = this->Path;
    this->Report.Columns = this->Rows.describe();
    this->Report.IsObvious = this->Rows.areObvious();
    if (this->NotFinite > 0)
    {
      this->warn(counted(this->NotFinite, "point has", "points have") +
        " no x or y; the first is in line " + std::to_string(this->FirstNotFinite) + ".");
    }
    for (const std::string& name : this->Rows.changedNames())
    {
      if (!name.empty())
      {
        this->remark("several columns are named '" + shownText(name) +
          "'; the later ones get _2, _3 and so on.");
      }
    }
    for (const SurveyedColumn& column : this->Columns)
    {
      this->report(column);
    }
  }

  void report(const SurveyedColumn& column)
  {
    const std::string name = "column '" + shownText(column.Column.Name) + "'";
    if (column.IsText && column.Numbers > 0)
    {
      this->warn(name + " holds text, such as " + column.FirstText + ", and is left out.");
    }
    else if (column.IsText || (column.Numbers == 0 && column.Missing > 0))
    {
      this->remark(name + " holds no numbers and is left out.");
    }
    else if (column.Numbers == 0)
    {
      column.IsHeight ? this->warn(name + " is empty, so there are no heights.")
                      : this->remark(name + " is empty and is left out.");
    }
    else if (column.Missing > 0)
    {
      const std::string sentence = counted(column.Missing, "value", "values") + " in " + name +
        " " + (column.Missing == 1 ? "is" : "are") + " missing, first " + column.FirstMissing + ".";
      column.IsHeight || column.Texts > 0 ? this->warn(sentence) : this->remark(sentence);
    }
    if (column.Sentinels > 0)
    {
      this->warn(counted(column.Sentinels, "height", "heights") + " in " + name +
        " look like the mark of a missing one, such as -9999; give --input-nodata with the value.");
    }
  }

  static std::string counted(std::int64_t count, const char* one, const char* many)
  {
    return std::to_string(count) + " " + (count == 1 ? one : many);
  }

  void warn(std::string sentence) { this->Report.Warnings.push_back(std::move(sentence)); }
  void remark(std::string sentence) { this->Report.Remarks.push_back(std::move(sentence)); }

  static constexpr double leastMark = 9999;   ///< a quick test of what isNoDataMark() tests
  static constexpr std::int64_t fewTexts = 5; ///< texts that are missing values

  const std::string Path;
  const PointOptions Options;
  TableRows Rows;
  const bool KeepsValues;
  std::int64_t NotFinite = 0;
  std::int64_t FirstNotFinite = 0;
};

class TextFilePoints : public FilePoints
{
public:
  TextFilePoints(const std::string& path, const PointOptions& options)
    : Path(path)
    , Options(options)
  {
    TableSurvey survey(path, options, false);
    this->Report = std::move(survey.Report);
    this->Copied = survey.Copied;
    for (SurveyedColumn& column : survey.Columns)
    {
      this->Numeric.push_back({ std::move(column.Column), column.Texts > 0 });
    }
  }

  bool next(PointBlock& block, std::size_t most) override
  {
    if (!this->Rows)
    {
      this->Rows.emplace(this->Path, this->Options);
    }
    const bool isCopied = this->Copied < this->Numeric.size();
    block.Columns.resize(this->Numeric.size() + (isCopied ? 1 : 0));
    // The copy comes first among the columns that are read.
    std::vector<double>* const columns = block.Columns.data() + (isCopied ? 1 : 0);
    std::size_t count = 0;
    for (; count < most && this->Rows->next(); ++count)
    {
      block.XY.push_back(this->Rows->x());
      block.XY.push_back(this->Rows->y());
      for (std::size_t i = 0; i < this->Numeric.size(); ++i)
      {
        columns[i].push_back(this->valueOf(this->Numeric[i]));
      }
    }
    if (isCopied)
    {
      block.Columns[0] = columns[this->Copied];
    }
    return count > 0;
  }

  void rewind() override
  {
    this->Rows.reset(); // reopened when needed: there may be many files
  }

  std::vector<std::string> columns() const override
  {
    std::vector<std::string> names;
    if (this->Copied < this->Numeric.size())
    {
      names.emplace_back("z");
    }
    for (const NumericColumn& column : this->Numeric)
    {
      names.push_back(column.Column.Name);
    }
    return names;
  }

  std::vector<TableReport> reports() const override { return { this->Report }; }

private:
  struct NumericColumn
  {
    TableRows::Column Column;
    bool HasTexts; ///< a few, which are missing values
  };

  double valueOf(const NumericColumn& column)
  {
    double value = 0;
    if (column.Column.Index >= this->Rows->width() ||
      (this->Rows->value(column.Column, value) == FieldKind::Text && !column.HasTexts))
    {
      throw IOError(this->Path, "has been changed meanwhile; start again.");
    }
    return value;
  }

  const std::string Path;
  const PointOptions Options;
  std::vector<NumericColumn> Numeric;
  std::size_t Copied = 0;
  TableReport Report;
  std::optional<TableRows> Rows;
};

} // namespace

PointTable readTextPoints(const std::string& path, const PointOptions& options)
{
  TableSurvey survey(path, options, true);
  PointTable table;
  table.XY = std::move(survey.XY);
  if (survey.Copied < survey.Columns.size())
  {
    table.Columns.push_back({ "z", survey.Columns[survey.Copied].Values });
  }
  for (SurveyedColumn& column : survey.Columns)
  {
    table.Columns.push_back({ std::move(column.Column.Name), std::move(column.Values) });
  }
  table.Reports.push_back(std::move(survey.Report));
  return table;
}

std::unique_ptr<FilePoints> streamTextPoints(const std::string& path, const PointOptions& options)
{
  return std::make_unique<TextFilePoints>(path, options);
}

} // namespace tipp
