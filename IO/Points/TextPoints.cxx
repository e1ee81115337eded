// SPDX-License-Identifier: BSD-3-Clause
#include "Points/TextPoints.h"

#include "Files/Extension.h"
#include "Points/TextRows.h"

#include <utility>

namespace tipp
{
namespace
{

struct NumericColumn
{
  TextRows::Column Column;
  std::vector<double> Values;
  bool HasNumber = false;
};

/// False if the row's value is neither a number nor missing.
bool addValue(const TextRows& rows, NumericColumn& column)
{
  double value = 0;
  const TextRows::Value kind = rows.value(column.Column, value);
  column.HasNumber = column.HasNumber || kind == TextRows::Value::Number;
  column.Values.push_back(value);
  return kind != TextRows::Value::Text;
}

} // namespace

bool isTextPath(const std::string& path)
{
  const std::string extension = extensionOf(path);
  return path == "-" || extension == ".csv" || extension == ".tsv" || extension == ".txt" ||
    extension == ".xyz" || extension == ".pts" || extension == ".gz" || extension == ".xz" ||
    extension == ".zst";
}

PointTable readTextPoints(const std::string& path, const PointOptions& options)
{
  TextRows rows(path, options);
  PointTable table;
  const auto expected = std::size_t(rows.expectedRows());
  table.XY.reserve(2 * expected);
  std::vector<NumericColumn> columns;
  for (const TextRows::Column& column : rows.further())
  {
    columns.push_back({ column, {} });
    columns.back().Values.reserve(expected);
  }
  while (rows.next())
  {
    table.XY.push_back(rows.x());
    table.XY.push_back(rows.y());
    for (std::size_t i = 0; i < columns.size();)
    {
      if (addValue(rows, columns[i]))
      {
        ++i;
      }
      else
      {
        columns.erase(columns.begin() + std::ptrdiff_t(i));
      }
    }
  }
  for (NumericColumn& column : columns)
  {
    if (column.HasNumber)
    {
      table.Columns.push_back({ std::move(column.Column.Name), std::move(column.Values) });
    }
  }
  return table;
}

} // namespace tipp
