// SPDX-License-Identifier: BSD-3-Clause
#include "Files/IOError.h"
#include "Points/FilePoints.h"
#include "Points/TextRows.h"

#include <optional>

namespace tipp
{
namespace
{

/// Which of the further columns hold numbers, or nothing, all along, and a number at least. A pass
/// over the file, which finds whatever is wrong with it, too.
std::vector<TextRows::Column> findNumericColumns(TextRows rows)
{
  std::vector<TextRows::Column> columns = rows.further();
  std::vector<char> hasNumber(columns.size(), 0);
  while (rows.next())
  {
    rows.x();
    rows.y();
    for (std::size_t i = 0; i < columns.size();)
    {
      double value = 0;
      const TextRows::Value kind = rows.value(columns[i], value);
      if (kind == TextRows::Value::Text)
      {
        columns.erase(columns.begin() + std::ptrdiff_t(i));
        hasNumber.erase(hasNumber.begin() + std::ptrdiff_t(i));
        continue;
      }
      hasNumber[i++] |= kind == TextRows::Value::Number ? 1 : 0;
    }
  }
  std::vector<TextRows::Column> numeric;
  for (std::size_t i = 0; i < columns.size(); ++i)
  {
    if (hasNumber[i] != 0)
    {
      numeric.push_back(columns[i]);
    }
  }
  return numeric;
}

class TextFilePoints : public FilePoints
{
public:
  TextFilePoints(const std::string& path, const PointOptions& options)
    : Path(path)
    , Options(options)
    , Numeric(findNumericColumns(TextRows(path, options)))
  {
  }

  bool next(PointBlock& block, std::size_t most) override
  {
    if (!this->Rows)
    {
      this->Rows.emplace(this->Path, this->Options);
      this->AtEnd = false;
    }
    block.Columns.resize(this->Numeric.size());
    std::size_t count = 0;
    for (; count < most && !this->AtEnd; ++count)
    {
      this->AtEnd = !this->Rows->next();
      if (this->AtEnd)
      {
        break;
      }
      block.XY.push_back(this->Rows->x());
      block.XY.push_back(this->Rows->y());
      for (std::size_t i = 0; i < this->Numeric.size(); ++i)
      {
        block.Columns[i].push_back(this->valueOf(this->Numeric[i]));
      }
    }
    return count > 0;
  }

  void rewind() override
  {
    this->Rows.reset(); // opened again when it is wanted: there may be many files
  }

  std::vector<std::string> columns() const override
  {
    std::vector<std::string> names;
    for (const TextRows::Column& column : this->Numeric)
    {
      names.push_back(column.Name);
    }
    return names;
  }

private:
  double valueOf(const TextRows::Column& column) const
  {
    double value = 0;
    if (column.Index >= this->Rows->width() ||
      this->Rows->value(column, value) == TextRows::Value::Text)
    {
      throw IOError(this->Path, "has been changed meanwhile; start again.");
    }
    return value;
  }

  const std::string Path;
  const PointOptions Options;
  const std::vector<TextRows::Column> Numeric;
  std::optional<TextRows> Rows;
  bool AtEnd = false;
};

} // namespace

std::unique_ptr<FilePoints> streamTextPoints(const std::string& path, const PointOptions& options)
{
  return std::make_unique<TextFilePoints>(path, options);
}

} // namespace tipp
