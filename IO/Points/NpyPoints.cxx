// SPDX-License-Identifier: BSD-3-Clause
#include "Points/NpyPoints.h"

#include "Files/IOError.h"
#include "Npy/NpyFile.h"
#include "Points/ColumnChoice.h"

#include <algorithm>

namespace tipp
{
namespace
{

template <typename Scalar>
void readRows(NpyReader& reader, const ColumnChoice& choice, std::size_t rows, PointTable& table)
{
  constexpr std::size_t chunkRows = 1 << 15;
  const auto columns = std::size_t(reader.columns());
  const std::size_t further = 3 - choice.X - choice.Y; // only used with three columns
  std::vector<Scalar> chunk(columns * std::min(chunkRows, rows));
  for (std::size_t first = 0; first < rows; first += chunkRows)
  {
    const std::size_t size = std::min(chunkRows, rows - first);
    reader.read(chunk.data(), size * columns * sizeof(Scalar));
    for (std::size_t i = 0; i < size; ++i)
    {
      const Scalar* const row = &chunk[i * columns];
      table.XY[2 * (first + i)] = row[choice.X];
      table.XY[2 * (first + i) + 1] = row[choice.Y];
      if (columns == 3)
      {
        table.Columns[0].Values[first + i] = row[further];
      }
    }
  }
}

} // namespace

PointTable readNpyPoints(const std::string& path, const PointOptions& options, int part, int parts)
{
  NpyReader reader(path);
  if ((reader.columns() != 2 && reader.columns() != 3) || !reader.isFloat())
  {
    throw IOError(path, "does not hold points; save n x 2 or n x 3 numbers of float64 or float32.");
  }
  std::vector<std::string> names{ "x", "y", "z" };
  names.resize(std::size_t(reader.columns()));
  const ColumnChoice choice = chooseColumns(path, names, names.size(), options);

  const auto rowBefore = [&](int p)
  { return reader.rows() / parts * p + reader.rows() % parts * p / parts; };
  const auto rows = std::size_t(rowBefore(part + 1) - rowBefore(part));
  reader.skipRows(rowBefore(part));
  PointTable table;
  table.XY.resize(2 * rows);
  if (names.size() == 3)
  {
    table.Columns.push_back({ names[3 - choice.X - choice.Y], std::vector<double>(rows) });
  }
  const bool asStored =
    reader.type() == NpyReader::Type::Float64 && names.size() == 2 && choice.X == 0;
  if (asStored)
  {
    reader.read(table.XY.data(), table.XY.size() * sizeof(double));
  }
  else if (reader.type() == NpyReader::Type::Float64)
  {
    readRows<double>(reader, choice, rows, table);
  }
  else
  {
    readRows<float>(reader, choice, rows, table);
  }
  return table;
}

} // namespace tipp
