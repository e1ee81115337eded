// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPlaneValues_h
#define tippPlaneValues_h

#include "Parallel/ParallelFor.h"
#include "Predicates/Geometry.h"
#include "Refinement/SizeLattice.h"
#include "vtkTIPPFiltersModule.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tipp
{

/// Numbers that a file gives at places of the plane, such as sizes or depths, which become a
/// function of the plane by interpolation.
class VTKTIPPFILTERS_EXPORT PlaneValues
{
public:
  virtual ~PlaneValues();

  /// The box of the places with values.
  virtual Box2 box() const = 0;

  /// Returns the least of the values that sample() may use for a lattice over the domain. Infinite
  /// if there are none. Throws IOError, and WorkAborted if `report` stops it.
  virtual double least(const Box2& domain, const Report& report) = 0;

  /// Returns the values at the lattice's nodes, all of them finite. They do not depend on the
  /// number of threads. Throws IOError, also if there is no value to use, and WorkAborted if
  /// `report` stops it.
  virtual std::vector<double> sample(
    const SizeLattice& lattice, int threads, const Report& report) = 0;
};

/// Which values are read from a file, and where it lies if it does not say so.
struct PlaneValuesOptions
{
  /// The name of the points' column, or of the nodes' array. Empty: one of `Names`, in this order.
  std::string Column;
  std::vector<std::string> Names = {};
  /// An .npy file is a raster with these outer pixel borders; nullopt: it has points.
  std::optional<Box2> RasterBounds = {};
  int Threads = 0; ///< that read; 0: usualThreads()
};

/// Opens a file by its extension and content:
/// - a raster (.tif and the other formats of GDAL; .npy if it has bounds): bilinear between the
///   centres of pixels, and as at the nearest of these places beyond them. Pixels without a value
///   are left out of the mean of four; a node without any takes the value of the nearest node that
///   has one. It is read row by row, so that it may be larger than memory;
/// - a mesh of triangles (fort.14 or VTK): linear in the triangles, and outside as at the nearest
///   place of the mesh;
/// - points in any other format: as on the mesh of their Delaunay triangulation. Of points with the
///   same coordinates the first counts. If there are no triangles, a node takes the value of the
///   nearest point.
/// The nearest of several equally near ones is the first. Nearness is that of the coordinates, also
/// in degrees. Throws IOError if the file cannot be read, has no such column, or has a value of
/// points that is not finite.
VTKTIPPFILTERS_EXPORT std::unique_ptr<PlaneValues> openPlaneValues(
  const std::string& path, const PlaneValuesOptions& options);

/// Implement openPlaneValues() for a kind of file.
///@{
std::unique_ptr<PlaneValues> openRasterPlane(
  const std::string& path, const PlaneValuesOptions& options);
std::unique_ptr<PlaneValues> openPointPlane(
  const std::string& path, const PlaneValuesOptions& options);
///@}

/// Sets the values of nodes that are NaN to that of the nearest position; `given` has one value per
/// position, and there must be one. Throws WorkAborted if `report` stops it.
void takeNearest(const SizeLattice& lattice, const std::vector<Point2>& positions,
  const std::vector<double>& given, int threads, const Report& report, std::vector<double>& values);

} // namespace tipp

#endif
