// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippQueries_h
#define tippQueries_h

#include "Query/ZoneShape.h"
#include "Resident/ResidentMesh.h"
#include "vtkTIPPFiltersModule.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace tipp
{

class Communicator;

// The queries of a mesh, except for ResidentMesh::answer() and answerOnRanks(). All ids are global
// ids. In a stored mesh, the id arrays of pieces are searched for them, and each is read at most
// once per call. Results do not depend on pieces and threads. Every function may throw IOError, for
// example for an id that the mesh does not have, and WorkAborted.
//
// `ranks` are the ranks that share the mesh, as for answerOnRanks(); null: this process alone. With
// ranks, the functions are collective; call them within Communicator::together(). Each rank passes
// its own points or ids, possibly none, and gets the results for them: unless stated otherwise,
// what one process would get that has the whole mesh. All ranks pass the same arrays, component,
// levels, spacing and region.

/// Lists of global ids in one array: list i is Ids[Starts[i]] ... Ids[Starts[i + 1] - 1].
struct IdLists
{
  std::vector<std::int64_t> Starts = { 0 };
  std::vector<std::int64_t> Ids;

  /// Appends list i of `from`.
  void append(const IdLists& from, std::size_t i)
  {
    this->Ids.insert(
      this->Ids.end(), from.Ids.begin() + from.Starts[i], from.Ids.begin() + from.Starts[i + 1]);
    this->endList();
  }
  /// Ends a list: it has the ids that were appended since the previous list ended.
  void endList() { this->Starts.push_back(std::int64_t(this->Ids.size())); }
};

template <typename Archive>
void serialize(Archive& archive, IdLists& lists)
{
  archive(lists.Starts, lists.Ids);
}

// Topological queries with ranks: parts in memory need global ids of points and cells; only hidden
// cells may occur in several parts, and a face may have at most two cells. A rank may have no
// cells.

/// The neighbour ids of cells: for each cell, and each of its corners, the cell across the face
/// opposite to this corner. -1 if there is none; the lowest id if there are several.
VTKTIPPFILTERS_EXPORT std::vector<std::int64_t> neighborsOf(
  const ResidentMesh& mesh, const std::vector<std::int64_t>& cells, Communicator* ranks = nullptr);

/// For each point, the cells that have it as a corner, in ascending order.
VTKTIPPFILTERS_EXPORT IdLists starsOf(
  const ResidentMesh& mesh, const std::vector<std::int64_t>& points, Communicator* ranks = nullptr);

/// For each point, the points that can be reached over 1 to k edges, in ascending order and without
/// the point itself.
VTKTIPPFILTERS_EXPORT IdLists ringsOfPoints(const ResidentMesh& mesh,
  const std::vector<std::int64_t>& points, int k, Communicator* ranks = nullptr);

/// For each cell, the cells that can be reached in 1 to k steps, where a step leads to a cell with
/// a common point. In ascending order and without the cell itself.
VTKTIPPFILTERS_EXPORT IdLists ringsOfCells(const ResidentMesh& mesh,
  const std::vector<std::int64_t>& cells, int k, Communicator* ranks = nullptr);

/// The border of a mesh of triangles as closed lines.
struct BoundaryLoops
{
  IdLists Points;                ///< point ids of each loop, starting with its lowest edge
  std::vector<Point3> Positions; ///< position of each of Points.Ids
};

/// The border of a mesh: the edges that only one triangle has. The mesh is on the left of each
/// loop, so outer borders are counter-clockwise, and borders of holes are clockwise. If borders
/// touch at a point, they stay separate loops. Loops are sorted by their lowest edges. With ranks,
/// the first one gets the whole border, and others get none.
VTKTIPPFILTERS_EXPORT BoundaryLoops boundaryOf(
  const ResidentMesh& mesh, Communicator* ranks = nullptr);

/// The connected components of a mesh. Cells are connected by common faces.
struct Components
{
  std::vector<std::int64_t> OfCells; ///< component of each cell, by global id; -1: a hidden cell
  std::vector<std::int64_t> Sizes;   ///< cells of each component; sorted by their lowest cells
  /// Only with ranks: the ids of this rank's cells, ascending, whose components OfCells has.
  std::vector<std::int64_t> Cells;
};

/// Computes the components. Needs 8 bytes of memory per cell of the mesh. With ranks, each gets the
/// components of its own cells, and all get the sizes.
VTKTIPPFILTERS_EXPORT Components componentsOf(
  const ResidentMesh& mesh, Communicator* ranks = nullptr);

/// The location in a mesh that is nearest to each point.
struct ClosestLocations
{
  std::vector<std::int64_t>
    Cells;                    ///< global ids; -1 if the mesh has no cell or the point is not finite
  std::vector<Point3> Points; ///< z is 0 for triangles; NaN if there is none
  std::vector<double> Distances; ///< 0 for points in the mesh; infinite if there is none
};

/// Finds the location in the mesh that is nearest to each point. Triangles are searched in x and y.
/// A point in the mesh is its own nearest location, in the cell of ResidentMesh::answer(). For
/// other points, the nearest cell is determined exactly; of equally near cells, the one with the
/// lowest id. Cells without area or volume are ignored.
VTKTIPPFILTERS_EXPORT ClosestLocations closestTo(const ResidentMesh& mesh, const Point3* points,
  std::int64_t count, Communicator* ranks = nullptr);

/// Computes the contour lines of a point array on a mesh of triangles, linear in each triangle. A
/// point is above a level if its value is not lower than the level. Triangles with a NaN value have
/// no lines. The higher side is on the left. Lines are joined across pieces. They are sorted by
/// level, in the order of `levels`. With ranks, the first one gets all lines, and others get none;
/// parts in memory need global point ids.
VTKTIPPFILTERS_EXPORT Contours contoursOf(const ResidentMesh& mesh, const std::string& array,
  int component, const std::vector<double>& levels, Communicator* ranks = nullptr);

/// The lowest and the highest finite value of a point array, on every rank; low > high if there is
/// none.
VTKTIPPFILTERS_EXPORT std::pair<double, double> rangeOf(
  const ResidentMesh& mesh, const std::string& array, int component, Communicator* ranks = nullptr);

/// Points along a polyline over a mesh, and the mesh's values there.
struct Profile
{
  std::vector<double> Distances; ///< distance from the start of the polyline, in its units
  std::vector<Point3> Points;    ///< z is 0 for triangles
  /// Cells and values at the points. In an exact profile, which has a point at every border of a
  /// cell, cells and cell values are those between a point and the next; -1 if there is no cell.
  MeshAnswer Answer;
};

/// Samples a mesh at the corners of a polyline, and every `spacing` along it. If `spacing` is 0,
/// samples it exactly where it crosses edges of triangles or faces of tetrahedra instead. Each rank
/// has its own polyline.
VTKTIPPFILTERS_EXPORT Profile profileOf(const ResidentMesh& mesh,
  const std::vector<Point3>& polyline, double spacing, const std::vector<std::string>& arrays,
  Communicator* ranks = nullptr);

/// Paths of steepest descent: line i has the points Starts[i] ... Starts[i + 1] - 1. It has no
/// points if it starts outside the mesh.
struct Descents
{
  std::vector<std::int64_t> Starts = { 0 };
  std::vector<Point3> Points;
  std::vector<double> Values;     ///< of the array; they decrease along each line
  std::vector<std::int64_t> Pits; ///< global id of the mesh point where a line ends; -1: none
};

template <typename Archive>
void serialize(Archive& archive, Descents& descents)
{
  archive(descents.Starts, descents.Points, descents.Values, descents.Pits);
}

/// Follows the steepest descent of a point array, linear in each triangle, from each point. A path
/// goes down a triangle, or along an edge if both sides descend towards it or it is on the border.
/// It ends where nothing descends: at a mesh point, or in a level triangle or edge. Slopes and
/// crossings are rounded. Of equal slopes, edges are preferred to triangles, then the lowest id.
/// The rank with the cells follows each path. Several ranks need a stored mesh.
VTKTIPPFILTERS_EXPORT Descents descentsOf(const ResidentMesh& mesh,
  const std::vector<Point3>& points, const std::string& array, int component,
  Communicator* ranks = nullptr);

/// Statistics of an array, one value per zone.
struct ZoneStatistics
{
  std::vector<std::int64_t> Cells; ///< number of cells with an area in the zone
  std::vector<double> Area;        ///< area of the mesh in the zone
  std::vector<double> Low;         ///< NaN if the mesh has no area in the zone
  std::vector<double> High;
  std::vector<double> Mean;
  std::vector<double> Sum;   ///< integral over the zone
  std::vector<double> Above; ///< volume above the level
};

template <typename Archive>
void serialize(Archive& archive, ZoneStatistics& of)
{
  archive(of.Cells, of.Area, of.Low, of.High, of.Mean, of.Sum, of.Above);
}

/// Integrates a component of an array over the parts of triangles in each zone. Point arrays are
/// linear in each triangle. Cells with a value that is not finite are left out. The volume above a
/// level is the integral of (value - level) where this is positive. Reads the pieces that meet
/// zones. Sums are rounded only once, so they are the same bits for any pieces, threads and ranks.
/// With ranks, each gets the statistics for the zones and the level of the first rank. In parts in
/// memory, only hidden cells may occur several times.
VTKTIPPFILTERS_EXPORT ZoneStatistics statisticsOf(const ResidentMesh& mesh,
  const std::vector<Zone>& zones, const std::string& array, int component, double level = 0,
  Communicator* ranks = nullptr);

/// A closed box or zone.
struct Region
{
  Box3 Box;      ///< z only for tetrahedra
  Zone Polygons; ///< for tetrahedra, columns with any z; if empty, the region is Box
};

/// The global ids of the cells that meet the region or, if `whole`, lie inside it, ascending.
/// Several ranks need a stored mesh. The first one gets the ids; others get none.
VTKTIPPFILTERS_EXPORT std::vector<std::int64_t> cellsIn(
  const ResidentMesh& mesh, const Region& region, bool whole, Communicator* ranks = nullptr);

/// The global ids of the mesh points in the region, ascending. Several ranks need a stored mesh.
/// The first one gets the ids; others get none.
VTKTIPPFILTERS_EXPORT std::vector<std::int64_t> pointsIn(
  const ResidentMesh& mesh, const Region& region, Communicator* ranks = nullptr);

} // namespace tipp

#endif
