// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippMeshSeries_h
#define tippMeshSeries_h

#include "Arrays/Scalar.h"
#include "Series/SeriesNodes.h"
#include "vtkTIPPIOModule.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace tipp
{

/// A quantity that a model wrote at the nodes or cells of its mesh.
struct SeriesVariable
{
  std::string Name;
  std::string LongName; ///< as in the file, or empty
  std::string Units;    ///< as in the file, or empty
  Scalar Type = Scalar::Float64;
  bool OnCells = false; ///< one value per triangle; otherwise one per node
  bool Varies = false;  ///< has values of its own for each time step
  /// The vector of which this is a component, if the file has vectors; their components follow each
  /// other. Empty otherwise.
  std::string Vector = {};
  /// What stands for NaN where the values are written to other files, if the format has a mark that
  /// its users know, such as -99999 of ADCIRC.
  double Mark = std::numeric_limits<double>::quiet_NaN();
  std::string StandardName = {}; ///< of CF, as in the file, or empty
};

/// A variable that a MeshSeries does not offer, or cells that are left out of its mesh.
struct SeriesLeftOut
{
  std::string Name;
  std::string Reason; ///< continues a sentence about it, such as "has the dimension 'siglay'"
};

/// The triangles of a model's mesh. Other cells are cut into triangles.
struct SeriesMesh
{
  std::vector<double> XY;              ///< x and y of the nodes, interleaved
  std::vector<std::int64_t> Triangles; ///< three node indices, from 0, per triangle; all are valid
  /// The index of the file's cell that each triangle is a part of; empty: the cells are triangles.
  std::vector<std::int64_t> OriginalCells;
};

/// Consecutive triangles of a model's mesh.
struct SeriesTriangles
{
  std::vector<std::int64_t> Nodes; ///< three node indices, from 0, per triangle; all are valid
  std::int64_t FirstCell = 0;      ///< the file's cell that is the first triangle
  /// The file's cell that each triangle is a part of; empty: each is the next cell of the file.
  std::vector<std::int64_t> Cells;

  std::int64_t cell(std::size_t triangle) const
  {
    return this->Cells.empty() ? this->FirstCell + std::int64_t(triangle) : this->Cells[triangle];
  }
};

/// Receives triangles of a mesh whose nodes up to now are known.
using TakeTriangles =
  std::function<void(const SeriesNodes& nodes, const SeriesTriangles& triangles)>;

/// The output of a model: a mesh of triangles in the plane, and variables of which each time step
/// is read when it is asked for.
class VTKTIPPIO_EXPORT MeshSeries
{
public:
  virtual ~MeshSeries() = default;

  /// Reads the mesh. Throws IOError.
  virtual SeriesMesh readMesh() = 0;

  /// Reads the mesh a block of triangles after the other, in the order of readMesh(), so that it
  /// need not be in memory as a whole. Returns the nodes. Throws IOError.
  virtual SeriesNodes readTriangles(const TakeTriangles& take);

  /// Reads x and y of the nodes alone, interleaved, also where cells could not be cut. Throws
  /// IOError.
  virtual std::vector<double> readNodes() { return this->readMesh().XY; }

  /// Reads a variable's values at a time step: one per node, or per triangle of readMesh(). NaN
  /// where the model has no value: at dry nodes, and where the file has its fill value. `step` is
  /// ignored if the variable does not vary. Throws IOError.
  virtual void read(std::size_t variable, std::size_t step, std::vector<double>& values) = 0;

  /// Reads a variable's values at some nodes or cells of the file: at ascending indices, which may
  /// repeat, as SeriesNodes::stored() and SeriesTriangles give them. Otherwise as read().
  virtual void readAt(std::size_t variable, std::size_t step, const std::vector<std::int32_t>& at,
    std::vector<double>& values);

  std::string Path; ///< the file, for messages
  std::string Kind; ///< the convention of the file, such as "UGRID"
  std::int64_t Nodes = 0;
  std::vector<SeriesVariable> Variables;
  std::vector<double> Times; ///< of the steps, ascending; empty if no variable varies
  /// The unit and origin of Times in the manner of CF, such as "seconds since 2008-09-01"; empty if
  /// the file does not say.
  std::string TimeUnits;
  std::string Calendar; ///< in the manner of CF; empty: the standard one
  /// What the file has and Variables lacks. readMesh() adds cells.
  std::vector<SeriesLeftOut> LeftOut;
  /// The reference system as GDAL reads it, such as "EPSG:4326"; empty if the file does not say.
  std::string Crs;
};

/// How openMeshSeries() reads a file.
struct SeriesOptions
{
  /// More files, with values at the nodes or cells of the mesh in the first one.
  std::vector<std::string> Values;
  /// Whether longitudes are moved by 360 degrees where cells cross the 180th meridian.
  bool Wrap = false;
};

/// Opens the output of a model by the extension of its name. Throws IOError for anything else, with
/// the reason.
VTKTIPPIO_EXPORT std::unique_ptr<MeshSeries> openMeshSeries(
  const std::string& path, const SeriesOptions& options = {});

/// Whether openMeshSeries() opens the file, by its extension, and for .vtkhdf because it has time
/// steps.
VTKTIPPIO_EXPORT bool isMeshSeries(const std::string& path);

/// Returns the index of the variable with this name. Throws IOError if there is none, with the
/// reason if it is left out.
VTKTIPPIO_EXPORT std::size_t findSeriesVariable(const MeshSeries& series, const std::string& name);

} // namespace tipp

#endif
