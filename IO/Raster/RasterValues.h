// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRasterValues_h
#define tippRasterValues_h

#include "Predicates/Geometry.h"
#include "Raster/RasterFile.h"
#include "vtkTIPPIOModule.h"

#include <memory>
#include <string>

namespace tipp
{

/// The values of a raster of one band, read part by part, so that it may be larger than memory. Not
/// thread-safe.
class VTKTIPPIO_EXPORT RasterValues
{
public:
  virtual ~RasterValues();

  /// The pixel grid, in the units of the raster's reference system.
  const RasterGrid& grid() const { return this->Grid; }

  /// Reads a window of the grid: window.Columns x window.Rows values, row by row from the south.
  /// Pixels without a value are NaN. The window must lie in the grid. Throws IOError.
  virtual void read(const RasterWindow& window, double* values) = 0;

protected:
  explicit RasterValues(const RasterGrid& grid)
    : Grid(grid)
  {
  }

private:
  RasterGrid Grid;
};

/// Opens a north-up raster of one band with GDAL: a GeoTIFF or another format (Use::Rasters). A
/// band's scale and offset are applied. Throws IOError, always in a build without GDAL.
VTKTIPPIO_EXPORT std::unique_ptr<RasterValues> openRasterValues(const std::string& path);

/// Opens an .npy file of rows x columns numbers as a raster, as createRaster() writes it: the first
/// row is the lowest. The file does not say where it lies: `bounds` are the outer borders of its
/// pixels. Throws IOError.
VTKTIPPIO_EXPORT std::unique_ptr<RasterValues> openNpyRaster(
  const std::string& path, const Box2& bounds);

} // namespace tipp

#endif
