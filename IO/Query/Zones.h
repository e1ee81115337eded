// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippZones_h
#define tippZones_h

#include "Query/ResidentMesh.h"
#include "Query/ZoneShape.h"
#include "vtkTIPPIOModule.h"

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace tipp
{

class Communicator;

/// What the zones have of a mesh, a value for each.
struct ZoneStatistics
{
  std::vector<std::int64_t> Cells; ///< of which the zone has an area
  std::vector<double> Area;        ///< of the mesh in the zone
  std::vector<double> Low;         ///< NaN if the zone has no area of the mesh
  std::vector<double> High;
  std::vector<double> Mean;
  std::vector<double> Sum;   ///< the integral over the zone
  std::vector<double> Above; ///< the volume above the level
};

template <typename Archive>
void serialize(Archive& archive, ZoneStatistics& of)
{
  archive(of.Cells, of.Area, of.Low, of.High, of.Mean, of.Sum, of.Above);
}

/// Integrates a component of an array over the parts of triangles in each zone, of points linearly.
/// Cells with a value that is not finite are left out. The volume above a level is the integral of
/// what the array exceeds it by. Reads the pieces that zones meet. The sums are rounded once, so
/// that they are the same, bit for bit, for any pieces and threads. Throws IOError and WorkAborted.
VTKTIPPIO_EXPORT ZoneStatistics statisticsOf(const ResidentMesh& mesh,
  const std::vector<Zone>& zones, const std::string& array, int component, double level = 0);

/// The statistics of the meshes of all ranks, as in answerOnRanks(), on every rank: bit for bit
/// those of the whole mesh in one process. The first rank's zones and level count; all give the
/// same array. No cell of parts in memory comes twice but where it is hidden. Collective; call it
/// within Communicator::together(). Throws IOError.
VTKTIPPIO_EXPORT ZoneStatistics statisticsOnRanks(Communicator& ranks, const ResidentMesh& mesh,
  const std::vector<Zone>& zones, const std::string& array, int component, double level = 0);

/// A box or a zone, with its border.
struct Region
{
  /// x min, x max, y min, y max, and of tetrahedra z min, z max.
  Bounds Box = {};
  Zone Polygons; ///< of x and y, over tetrahedra columns without an end; empty: the box
};

/// The cells that have a point of the region or, if `whole`, lie in it; ascending global ids.
VTKTIPPIO_EXPORT std::vector<std::int64_t> cellsIn(
  const ResidentMesh& mesh, const Region& region, bool whole);

/// The points of the mesh in the region; ascending global ids.
VTKTIPPIO_EXPORT std::vector<std::int64_t> pointsIn(const ResidentMesh& mesh, const Region& region);

///@{
/// The same of a stored mesh, whose pieces the ranks share out as in answerOnRanks(), on the first
/// rank; the others get none. All give the same region. Collective; call it within
/// Communicator::together().
VTKTIPPIO_EXPORT std::vector<std::int64_t> cellsOnRanks(
  Communicator& ranks, const ResidentMesh& mesh, const Region& region, bool whole);
VTKTIPPIO_EXPORT std::vector<std::int64_t> pointsOnRanks(
  Communicator& ranks, const ResidentMesh& mesh, const Region& region);
///@}

} // namespace tipp

#endif
