// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippReadConstraintFile_h
#define tippReadConstraintFile_h

#include "Points/ReadPoints.h"
#include "Predicates/Geometry.h"
#include "vtkTIPPIOModule.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

class vtkDataSet;

namespace tipp
{

/// Segments and polygons read from a file.
struct ConstraintTable
{
  std::vector<double>
    XY; ///< x and y of the file's own points; empty: ids refer to the points to triangulate
  std::vector<double> Height; ///< z per point of XY, if the file has three coordinates
  std::vector<std::array<std::int64_t, 2>> Edges; ///< point ids
  std::size_t PolygonBegin = 0; ///< edges from this index on belong to closed polygons
  std::vector<double> Holes;    ///< x and y of points in holes

  std::vector<Point2> holes() const
  {
    std::vector<Point2> points;
    for (std::size_t i = 0; i < this->Holes.size(); i += 2)
    {
      points.push_back({ this->Holes[i], this->Holes[i + 1] });
    }
    return points;
  }
};

/// Reads constraints by the file's extension:
/// .poly (Triangle: vertices, in this file or in the .node file beside it, segments and holes);
/// .csv, .txt (one segment per line: x and y, or x, y and z of both ends, or two ids of points
/// counted from 0); .14, .grd (ADCIRC: the boundaries of the grid); .gpkg, .shp, .geojson, .json,
/// .fgb (lines and polygons of a GIS); any VTK file (its lines, and its polygons as polygons).
/// `wrap`: PointOptions::Wrap. Throws IOError, also if the file has neither lines nor polygons nor
/// holes.
VTKTIPPIO_EXPORT ConstraintTable readConstraintFile(const std::string& path, int wrap = 0);

/// Reads the segments of a text file (.csv, .txt) block by block.
class VTKTIPPIO_EXPORT SegmentRows
{
public:
  static bool isFor(const std::string& path);

  /// Opens the file. `wrap`: PointOptions::Wrap. The constructor and next() throw IOError.
  explicit SegmentRows(const std::string& path, int wrap = 0);

  /// Replaces the content of `table` by the next segments, at most `most`. Their ids are indices in
  /// the table's own points, if it has any. Returns false at the end.
  bool next(ConstraintTable& table, std::size_t most = 16384);

  /// A text that identifies the file across runs: name, size and time.
  std::string identity() const { return this->Rows->identity(); }

private:
  void takeIds(const PointBlock& block, ConstraintTable& table) const;

  std::string Path;
  int Wrap;
  std::unique_ptr<PointStream> Rows;
  bool IsEmpty = true; ///< no segment has been read so far
};

///@{
/// The lines and polygons of a VTK file or data set; the table always has heights. The first throws
/// IOError.
ConstraintTable readVtkConstraints(const std::string& path);
VTKTIPPIO_EXPORT ConstraintTable constraintsOf(vtkDataSet* data);
///@}

} // namespace tipp

#endif
