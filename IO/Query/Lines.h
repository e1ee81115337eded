// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippQueryLines_h
#define tippQueryLines_h

#include "Query/ResidentMesh.h"
#include "vtkTIPPIOModule.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace tipp
{

class Communicator;

/// Where an array of points has a level, as polylines: line i has the points Starts[i] ...
/// Starts[i + 1] - 1. The first point of a closed line is also its last.
struct Contours
{
  std::vector<std::int64_t> Starts = { 0 };
  std::vector<double> Levels; ///< of each line
  std::vector<Point3> Points;
};

/// The contours of a mesh of triangles, whose array of points is linear in each. A point counts as
/// above a level if its value is not lower; triangles with a corner that is NaN have no line. The
/// higher side is on the left. Lines are joined across pieces, bit for bit the same for any pieces
/// and threads; they are in the order of their levels, as given. Throws IOError.
VTKTIPPIO_EXPORT Contours contoursOf(const ResidentMesh& mesh, const std::string& array,
  int component, const std::vector<double>& levels);

/// The contours of the meshes of all ranks, as in answerOnRanks(), on the first rank; the others
/// get none. Parts in memory need global ids of points. Collective; call it within
/// Communicator::together(). Throws IOError.
VTKTIPPIO_EXPORT Contours contoursOnRanks(Communicator& ranks, const ResidentMesh& mesh,
  const std::string& array, int component, const std::vector<double>& levels);

/// The lowest and the highest finite value of an array of points; low > high if there is none.
/// Throws IOError.
VTKTIPPIO_EXPORT std::pair<double, double> rangeOf(
  const ResidentMesh& mesh, const std::string& array, int component);

/// Of the meshes of all ranks, as contoursOnRanks().
VTKTIPPIO_EXPORT std::pair<double, double> rangeOnRanks(
  Communicator& ranks, const ResidentMesh& mesh, const std::string& array, int component);

/// The description of an array of the points of a mesh of triangles, or also of its cells; null:
/// the elevation. Throws IOError if there is none, or no such component.
const StoredArray* fieldOf(
  const ResidentMesh& mesh, const std::string& array, int component, bool orOfCells = false);

/// A polyline over a mesh of triangles.
struct Profile
{
  std::vector<double> Distances; ///< from the beginning of the polyline, along x and y
  std::vector<Point3> Points;    ///< z is 0
  /// What the mesh has at the points. An exact profile has all cells' borders: there Cells and the
  /// values of cells are those up to the next point, -1 before a gap.
  MeshAnswer Answer;
};

/// Samples the mesh every `spacing` along a polyline of x and y, and at its corners; with spacing 0
/// at its corners and where it crosses an edge of the mesh, decided exactly. Throws IOError.
VTKTIPPIO_EXPORT Profile profileOf(const ResidentMesh& mesh, const std::vector<Point3>& polyline,
  double spacing, const std::vector<std::string>& arrays);

/// The profile of this rank's polyline over the meshes of all ranks, as in contoursOnRanks(). Every
/// rank has a polyline of its own, or an empty one; all give the same spacing and arrays.
VTKTIPPIO_EXPORT Profile profileOnRanks(Communicator& ranks, const ResidentMesh& mesh,
  const std::vector<Point3>& polyline, double spacing, const std::vector<std::string>& arrays);

/// The ways down from some points: line i has the points Starts[i] ... Starts[i + 1] - 1, none if
/// it begins outside of the mesh.
struct Descents
{
  std::vector<std::int64_t> Starts = { 0 };
  std::vector<Point3> Points;
  std::vector<double> Values;     ///< of the array, falling along each line
  std::vector<std::int64_t> Pits; ///< the point of the mesh that a line ends at; -1: none
};

template <typename Archive>
void serialize(Archive& archive, Descents& descents)
{
  archive(descents.Starts, descents.Points, descents.Values, descents.Pits);
}

/// Follows the steepest descent of an array of points, linear in each triangle: down a triangle, or
/// along an edge that both sides lead to, or that is the border. A line ends where no way leads
/// down, at a point of the mesh or in a level triangle or edge. Slopes and crossings are rounded;
/// of equal slopes edges come first, then the lowest id. The same for any pieces and threads.
/// Throws IOError and WorkAborted.
VTKTIPPIO_EXPORT Descents descentsOf(const ResidentMesh& mesh, const std::vector<Point3>& points,
  const std::string& array, int component);

/// The ways down from this rank's points over a stored mesh, whose pieces the ranks share out as in
/// answerOnRanks(): each way is followed where the cells are. Every rank has points of its own, or
/// none. Collective; call it within Communicator::together(). Throws IOError, also for parts in
/// memory.
VTKTIPPIO_EXPORT Descents descentsOnRanks(Communicator& ranks, const ResidentMesh& mesh,
  const std::vector<Point3>& points, const std::string& array, int component);

} // namespace tipp

#endif
