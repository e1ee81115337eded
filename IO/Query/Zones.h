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

// `ranks` are the ranks that share the mesh, as for answerOnRanks(); null: this process alone. With
// ranks, the functions are collective; call them within Communicator::together(). They throw
// IOError and WorkAborted.

/// Integrates a component of an array over the parts of triangles in each zone. Point arrays are
/// linear in each triangle. Cells with a value that is not finite are left out. The volume above a
/// level is the integral of (value - level) where this is positive. Reads the pieces that meet
/// zones. Sums are rounded only once, so they are the same bits for any pieces, threads and ranks.
/// With ranks, each gets the statistics for the zones and the level of the first rank; all pass the
/// same array. In parts in memory, only hidden cells may occur several times.
VTKTIPPIO_EXPORT ZoneStatistics statisticsOf(const ResidentMesh& mesh,
  const std::vector<Zone>& zones, const std::string& array, int component, double level = 0,
  Communicator* ranks = nullptr);

/// A closed box or zone.
struct Region
{
  /// x min, x max, y min, y max, and for tetrahedra z min, z max.
  Bounds Box = {};
  Zone Polygons; ///< for tetrahedra, columns with any z; if empty, the region is Box
};

/// The global ids of the cells that meet the region or, if `whole`, lie inside it, ascending.
/// Several ranks need a stored mesh, and pass the same region. The first one gets the ids; others
/// get none.
VTKTIPPIO_EXPORT std::vector<std::int64_t> cellsIn(
  const ResidentMesh& mesh, const Region& region, bool whole, Communicator* ranks = nullptr);

/// The same for the mesh points in the region.
VTKTIPPIO_EXPORT std::vector<std::int64_t> pointsIn(
  const ResidentMesh& mesh, const Region& region, Communicator* ranks = nullptr);

} // namespace tipp

#endif
