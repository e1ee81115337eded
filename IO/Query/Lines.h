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

/// Contour lines as polylines: line i has the points Starts[i] ... Starts[i + 1] - 1. The last
/// point of a closed line equals its first.
struct Contours
{
  std::vector<std::int64_t> Starts = { 0 };
  std::vector<double> Levels; ///< level of each line
  std::vector<Point3> Points;
};

// `ranks` are the ranks that share the mesh, as for answerOnRanks(); null: this process alone. With
// ranks, the functions are collective; call them within Communicator::together(). All ranks pass
// the same array, component, levels and spacing. They throw IOError and WorkAborted.

/// Computes the contour lines of a point array on a mesh of triangles, linear in each triangle. A
/// point is above a level if its value is not lower than the level. Triangles with a NaN value have
/// no lines. The higher side is on the left. Lines are joined across pieces, and are the same bits
/// for any pieces and threads. They are sorted by level, in the order of `levels`. With ranks, the
/// first one gets all lines, and others get none; parts in memory need global point ids.
VTKTIPPIO_EXPORT Contours contoursOf(const ResidentMesh& mesh, const std::string& array,
  int component, const std::vector<double>& levels, Communicator* ranks = nullptr);

/// The lowest and the highest finite value of a point array, on every rank; low > high if there is
/// none.
VTKTIPPIO_EXPORT std::pair<double, double> rangeOf(
  const ResidentMesh& mesh, const std::string& array, int component, Communicator* ranks = nullptr);

/// Describes an array at the points, with `orOfCells` also at the cells, of a mesh of triangles;
/// null for the elevation. Throws IOError if the mesh has no such array or component.
const StoredArray* fieldOf(
  const ResidentMesh& mesh, const std::string& array, int component, bool orOfCells = false);

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
/// has its own polyline, which may be empty.
VTKTIPPIO_EXPORT Profile profileOf(const ResidentMesh& mesh, const std::vector<Point3>& polyline,
  double spacing, const std::vector<std::string>& arrays, Communicator* ranks = nullptr);

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
/// Results do not depend on pieces and threads. Each rank has its own points, or none; the rank
/// with the cells follows each path. Several ranks need a stored mesh.
VTKTIPPIO_EXPORT Descents descentsOf(const ResidentMesh& mesh, const std::vector<Point3>& points,
  const std::string& array, int component, Communicator* ranks = nullptr);

} // namespace tipp

#endif
