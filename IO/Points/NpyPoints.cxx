// SPDX-License-Identifier: BSD-3-Clause
#include "Points/NpyPoints.h"

#include "Files/IOError.h"

#include <algorithm>

namespace tipp
{

NpyPointRows::NpyPointRows(const std::string& path, const PointOptions& options)
  : Reader(path)
  , Width(std::size_t(std::max<std::int64_t>(this->Reader.columns(), 0)))
{
  if ((this->Width != 2 && this->Width != 3) || !this->Reader.isFloat())
  {
    throw IOError(path, "does not hold points; save n x 2 or n x 3 numbers of float64 or float32.");
  }
  std::vector<std::string> names{ "x", "y", "z" };
  names.resize(this->Width);
  this->Choice = chooseColumns(path, names, this->Width, options);
  if (this->Width == 3)
  {
    this->Further.push_back(names[3 - this->Choice.X - this->Choice.Y]);
  }
}

void NpyPointRows::read(std::size_t count, double* xy, double* further)
{
  if (this->Reader.type() == NpyReader::Type::Float32)
  {
    this->readRows<float>(count, xy, further);
  }
  else if (this->Width == 2 && this->Choice.X == 0)
  {
    this->Reader.read(xy, 2 * count * sizeof(double)); // as stored
  }
  else
  {
    this->readRows<double>(count, xy, further);
  }
}

template <typename Scalar>
void NpyPointRows::readRows(std::size_t count, double* xy, double* further)
{
  constexpr std::size_t rowsAtOnce = 1 << 15;
  const std::size_t third = 3 - this->Choice.X - this->Choice.Y; // only used with three columns
  std::vector<Scalar> rows(this->Width * std::min(rowsAtOnce, count));
  for (std::size_t first = 0; first < count; first += rowsAtOnce)
  {
    const std::size_t size = std::min(rowsAtOnce, count - first);
    this->Reader.read(rows.data(), size * this->Width * sizeof(Scalar));
    for (std::size_t i = 0; i < size; ++i)
    {
      const Scalar* const row = &rows[i * this->Width];
      xy[2 * (first + i)] = row[this->Choice.X];
      xy[2 * (first + i) + 1] = row[this->Choice.Y];
      if (further)
      {
        further[first + i] = row[third];
      }
    }
  }
}

PointTable readNpyPoints(const std::string& path, const PointOptions& options, int part, int parts)
{
  NpyPointRows file(path, options);
  const auto rowBefore = [&](int p)
  { return file.rows() / parts * p + file.rows() % parts * p / parts; };
  const auto rows = std::size_t(rowBefore(part + 1) - rowBefore(part));
  file.skip(rowBefore(part));
  PointTable table;
  table.XY.resize(2 * rows);
  for (const std::string& name : file.further())
  {
    table.Columns.push_back({ name, std::vector<double>(rows) });
  }
  file.read(
    rows, table.XY.data(), table.Columns.empty() ? nullptr : table.Columns[0].Values.data());
  return table;
}

} // namespace tipp
