// SPDX-License-Identifier: BSD-3-Clause
#include "Refinement/PlaneValues.h"

#include "Files/Formats.h"
#include "Files/IOError.h"
#include "Predicates/SensibleRange.h"
#include "Raster/RasterValues.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

namespace tipp
{
namespace
{

/// The pixels around a coordinate along one axis: between the centres of these two it is at this
/// fraction. Beyond the first or last centre, it is at that.
struct PixelPair
{
  std::int64_t First;
  std::int64_t Second;
  double Fraction;
};

PixelPair pixelsAt(double coordinate, double firstCentre, double pixel, std::int64_t count)
{
  // With this order of arguments NaN becomes 0.
  const double position =
    std::min(std::max(0.0, (coordinate - firstCentre) / pixel), double(count - 1));
  const auto first = std::int64_t(position);
  return { first, std::min(first + 1, count - 1), position - double(first) };
}

/// The values of a raster's window, of which two rows at a time are in memory.
class WindowRows
{
public:
  WindowRows(RasterValues& raster, std::int64_t column, std::int64_t columns)
    : Raster(raster)
    , Column(column)
    , Columns(columns)
  {
  }

  /// Returns a row of the raster within the window. It is valid until two others have been read.
  const double* row(std::int64_t row)
  {
    if (this->Latest.Row != row)
    {
      std::swap(this->Latest, this->Other);
    }
    if (this->Latest.Row != row)
    {
      this->Latest.Values.resize(std::size_t(this->Columns));
      this->Raster.read({ this->Column, row, this->Columns, 1 }, this->Latest.Values.data());
      this->Latest.Row = row;
    }
    return this->Latest.Values.data();
  }

private:
  struct Row
  {
    std::int64_t Row = -1;
    std::vector<double> Values;
  };

  RasterValues& Raster;
  std::int64_t Column;
  std::int64_t Columns;
  Row Latest;
  Row Other;
};

/// The mean of the values with these weights, without those that are not finite; NaN if there are
/// no others.
double meanOf(const double (&values)[4], const double (&weights)[4])
{
  double sum = 0;
  double weight = 0;
  for (std::size_t i = 0; i < 4; ++i)
  {
    if (std::isfinite(values[i]) && weights[i] > 0)
    {
      sum += weights[i] * values[i];
      weight += weights[i];
    }
  }
  return weight > 0 ? sum / weight : std::numeric_limits<double>::quiet_NaN();
}

class RasterPlane : public PlaneValues
{
public:
  RasterPlane(std::string path, std::unique_ptr<RasterValues> raster)
    : Path(std::move(path))
    , Raster(std::move(raster))
    , Grid(this->Raster->grid())
  {
  }

  Box2 box() const override
  {
    return { { this->Grid.West, this->Grid.South },
      { gridPosition(this->Grid.West, this->Grid.Pixel[0], 2 * this->Grid.Columns),
        this->Grid.north() } };
  }

  double least(const Box2& domain, const Report& report) override
  {
    const std::int64_t column = this->across(domain.Min.x).First;
    const std::int64_t columns = this->across(domain.Max.x).Second + 1 - column;
    const std::int64_t bottom = this->up(domain.Min.y).First;
    const std::int64_t rows = this->up(domain.Max.y).Second + 1 - bottom;
    WindowRows window(*this->Raster, column, columns);
    double least = std::numeric_limits<double>::infinity();
    for (std::int64_t row = 0; row < rows; ++row)
    {
      const double* const values = window.row(bottom + row);
      for (std::int64_t i = 0; i < columns; ++i)
      {
        least = std::isfinite(values[i]) ? std::min(least, values[i]) : least;
      }
      requireWanted(report, double(row + 1) / double(rows));
    }
    return least;
  }

  std::vector<double> sample(const SizeLattice& lattice, int threads, const Report& report) override
  {
    std::vector<double> values = this->interpolated(lattice, partOf(report, 0, 0.9));
    this->fillGaps(lattice, threads, partOf(report, 0.9, 1), values);
    return values;
  }

private:
  static void requireWanted(const Report& report, double done)
  {
    if (report && !report(done))
    {
      throw WorkAborted();
    }
  }

  PixelPair across(double x) const
  {
    return pixelsAt(x, this->Grid.firstCentre().x, this->Grid.Pixel[0], this->Grid.Columns);
  }
  PixelPair up(double y) const
  {
    return pixelsAt(y, this->Grid.firstCentre().y, this->Grid.Pixel[1], this->Grid.Rows);
  }

  /// Returns the values at the nodes, NaN at nodes without one. One thread reads, since GDAL's data
  /// sets are not for several.
  std::vector<double> interpolated(const SizeLattice& lattice, const Report& report)
  {
    std::vector<PixelPair> pixels;
    pixels.reserve(std::size_t(lattice.columns()));
    for (int column = 0; column < lattice.columns(); ++column)
    {
      pixels.push_back(this->across(lattice.at(column, 0).x));
    }
    const std::int64_t west = pixels.front().First;
    WindowRows window(*this->Raster, west, pixels.back().Second + 1 - west);
    std::vector<double> values(lattice.nodes());
    for (int row = 0; row < lattice.rows(); ++row)
    {
      const PixelPair rows = this->up(lattice.at(0, row).y);
      const double* const low = window.row(rows.First);
      const double* const high = window.row(rows.Second);
      for (int column = 0; column < lattice.columns(); ++column)
      {
        const auto [first, second, u] = pixels[std::size_t(column)];
        const double v = rows.Fraction;
        const double four[4] = { low[first - west], low[second - west], high[first - west],
          high[second - west] };
        const double weights[4] = { (1 - u) * (1 - v), u * (1 - v), (1 - u) * v, u * v };
        values[lattice.index(column, row)] = meanOf(four, weights);
      }
      requireWanted(report, double(row + 1) / lattice.rows());
    }
    return values;
  }

  void fillGaps(const SizeLattice& lattice, int threads, const Report& report,
    std::vector<double>& values) const
  {
    const auto isMissing = [&](int column, int row)
    {
      return column >= 0 && column < lattice.columns() && row >= 0 && row < lattice.rows() &&
        std::isnan(values[lattice.index(column, row)]);
    };
    // The nearest node with a value is beside one without.
    std::vector<Point2> positions;
    std::vector<double> given;
    bool isComplete = true;
    for (int row = 0; row < lattice.rows(); ++row)
    {
      for (int column = 0; column < lattice.columns(); ++column)
      {
        const bool isGap = isMissing(column, row);
        isComplete = isComplete && !isGap;
        if (!isGap &&
          (isMissing(column - 1, row) || isMissing(column + 1, row) || isMissing(column, row - 1) ||
            isMissing(column, row + 1)))
        {
          positions.push_back(lattice.at(column, row));
          given.push_back(values[lattice.index(column, row)]);
        }
      }
    }
    if (!isComplete && positions.empty())
    {
      const Box2 domain{ lattice.at(0, 0), lattice.at(lattice.columns() - 1, lattice.rows() - 1) };
      throw IOError(this->Path,
        "has no value in the domain, " + inWords(inSpace(domain)) + "; give another raster.");
    }
    if (!isComplete)
    {
      takeNearest(lattice, positions, given, threads, report, values);
    }
  }

  std::string Path;
  std::unique_ptr<RasterValues> Raster;
  RasterGrid Grid;
};

} // namespace

std::unique_ptr<PlaneValues> openRasterPlane(
  const std::string& path, const PlaneValuesOptions& options)
{
  if (!options.Column.empty())
  {
    throw IOError(
      path, "is a raster of one band and has no columns; leave out '" + options.Column + "'.");
  }
  return std::make_unique<RasterPlane>(path,
    isOpenedBy(path, Opener::Npy) ? openNpyRaster(path, *options.RasterBounds)
                                  : openRasterValues(path));
}

} // namespace tipp
