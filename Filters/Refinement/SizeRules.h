// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSizeRules_h
#define tippSizeRules_h

#include "Parallel/ParallelFor.h"
#include "Predicates/Geometry.h"
#include "Refinement/SizeLattice.h"
#include "vtkTIPPFiltersModule.h"

#include <array>
#include <vector>

namespace tipp
{

/// @name Rules that limit sizes
/// Each lowers the sizes at the nodes of a lattice, as lengths of its plane, to what the rule
/// allows. The names are those of OceanMesh2D (Roberts, Pringle and Westerink, OceanMesh2D 1.0,
/// 2019). The results do not depend on the number of threads. All throw WorkAborted if `report`
/// stops them.
///@{

/// dis: sizes grow with the distance to the nearest of the segments: least + dis * distance.
/// Distances are exact but for rounding. In the geographic plane they use the cosine of the node's
/// latitude. Segments with coordinates that are not finite are ignored.
VTKTIPPFILTERS_EXPORT void limitByDistance(const SizeLattice& lattice,
  const std::vector<std::array<Point2, 2>>& segments, double least, double dis, int threads,
  const Report& report, std::vector<double>& sizes);

/// The depth that counts where the sea is shallower, in metres; land has this depth, too.
constexpr double LeastDepth = 1;

/// Returns the size by which the wavelength of the M2 tide (12.42 hours) has `elements` edges in
/// water of this depth in metres: 12.42 * 3600 s * sqrt(9.81 m/s^2 * depth) / elements.
VTKTIPPFILTERS_EXPORT double sizeByWavelength(double depth, double elements);

/// wl: limits sizes by sizeByWavelength(). `depths` has one per node, in metres, positive down.
VTKTIPPFILTERS_EXPORT void limitByWavelength(const SizeLattice& lattice,
  const std::vector<double>& depths, double elements, int threads, const Report& report,
  std::vector<double>& sizes);

/// slp: limits sizes to 2 pi depth / (slp |grad depth|), so that a change of depth by itself spans
/// slp / (2 pi) edges. The gradient is that of central differences between neighbouring nodes,
/// one-sided at the lattice's border. Where the bottom is level there is no limit. `depths` as for
/// limitByWavelength().
VTKTIPPFILTERS_EXPORT void limitBySlope(const SizeLattice& lattice,
  const std::vector<double>& depths, double slp, int threads, const Report& report,
  std::vector<double>& sizes);

/// g: lowers sizes so that those at two nodes differ by at most g times their distance.
///
/// The size of a node becomes the least, over all nodes, of the size there plus the cost of a path
/// of horizontal, vertical and diagonal steps, as in a chamfer distance transform (Borgefors,
/// Distance transformations in digital images, 1986). Such paths are longer than the straight line,
/// by 8 % at most between square cells, so that g times their length would allow too much: the cost
/// is g times the length times the cosine of half the larger angle between steps, 0.92 for square
/// cells. Thus along the axes and diagonals sizes grow by 0.92 g. In the geographic plane the
/// lengths and angles are those at the step's latitude.
VTKTIPPFILTERS_EXPORT void limitGradation(
  const SizeLattice& lattice, double g, const Report& report, std::vector<double>& sizes);
///@}

} // namespace tipp

#endif
