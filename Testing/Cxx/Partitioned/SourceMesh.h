// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSourceMesh_h
#define tippSourceMesh_h

#include "CellSets.h"

#include <cstdint>
#include <string>
#include <vector>

namespace tipp
{
namespace test
{

/// A mesh in memory with values at its points and a label for each cell.
struct SourceMesh
{
  int CellSize = 3;
  int Components = 2; ///< coordinates per point
  std::vector<double> Coordinates;
  std::vector<std::int64_t> Cells; ///< CellSize point ids per cell
  std::vector<float> Values;       ///< two values per point
  std::vector<std::int16_t> Labels;
  std::vector<double> Times;
  std::vector<double> Series; ///< one value per point, for one time step after the other

  std::size_t points() const { return this->Coordinates.size() / std::size_t(this->Components); }
  std::size_t cells() const { return this->Cells.size() / std::size_t(this->CellSize); }
};

/// Makes a mesh from a set of cells: equal corners become one point. Points and cells are numbered
/// at random. One additional point belongs to no cell.
SourceMesh makeSource(const CellSet& cells, unsigned seed = 1);

/// Adds a point array with `steps` time steps.
void addSeries(SourceMesh& mesh, int steps);

/// Writes a folder of .npy arrays, independently of the code under test.
void writeFlat(const SourceMesh& mesh, const std::string& folder);

} // namespace test
} // namespace tipp

#endif
