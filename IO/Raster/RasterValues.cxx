// SPDX-License-Identifier: BSD-3-Clause
#include "Raster/RasterValues.h"

#include "Arrays/Scalar.h"
#include "Files/IOError.h"
#include "Npy/NpyFile.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace tipp
{

RasterValues::~RasterValues() = default;

namespace
{

RasterGrid gridWithin(const Box2& bounds, const NpyReader& reader, const std::string& path)
{
  RasterGrid grid;
  grid.West = bounds.Min.x;
  grid.South = bounds.Min.y;
  grid.Columns = reader.columns();
  grid.Rows = reader.rows();
  if (grid.Columns == 0 || grid.Rows == 0)
  {
    throw IOError(path, "has no pixels; save an array of rows x columns.");
  }
  grid.Pixel = { bounds.width(0) / double(grid.Columns), bounds.width(1) / double(grid.Rows) };
  grid.North = bounds.Max.y;
  if (!isFinite(bounds) || !(grid.Pixel[0] > 0) || !(grid.Pixel[1] > 0) ||
    !std::isfinite(grid.Pixel[0]) || !std::isfinite(grid.Pixel[1]))
  {
    throw IOError(path,
      "is a raster whose bounds are no box with a width and a height; give finite numbers, each "
      "lower bound first.");
  }
  return grid;
}

class NpyRaster : public RasterValues
{
public:
  NpyRaster(const std::string& path, const Box2& bounds)
    : NpyRaster(std::make_unique<NpyReader>(path), path, bounds)
  {
  }

  void read(const RasterWindow& window, double* values) override
  {
    withScalar(this->Reader->type(),
      [&](auto kind)
      {
        std::vector<decltype(kind)> row(std::size_t(this->grid().Columns));
        for (std::int64_t i = 0; i < window.Rows; ++i)
        {
          this->Reader->seekRow(window.Row + i);
          this->Reader->read(row.data(), row.size() * sizeof(kind));
          std::transform(row.begin() + window.Column, row.begin() + window.Column + window.Columns,
            values + i * window.Columns, [](auto value) { return double(value); });
        }
      });
  }

private:
  NpyRaster(std::unique_ptr<NpyReader> reader, const std::string& path, const Box2& bounds)
    : RasterValues(gridWithin(bounds, *reader, path))
    , Reader(std::move(reader))
  {
  }

  std::unique_ptr<NpyReader> Reader;
};

} // namespace

std::unique_ptr<RasterValues> openNpyRaster(const std::string& path, const Box2& bounds)
{
  return std::make_unique<NpyRaster>(path, bounds);
}

} // namespace tipp
