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

/// A mesh in memory with a value at each point and a label at each cell.
struct SourceMesh
{
  int CellSize = 3;
  int Components = 2; ///< of a point
  std::vector<double> Coordinates;
  std::vector<std::int64_t> Cells; ///< CellSize ids each
  std::vector<float> Values;       ///< two a point
  std::vector<std::int16_t> Labels;
  std::vector<double> Times;
  std::vector<double> Series; ///< a value a point, step after step

  std::size_t points() const { return this->Coordinates.size() / std::size_t(this->Components); }
  std::size_t cells() const { return this->Cells.size() / std::size_t(this->CellSize); }
};

/// The cells of a set with their corners made one where they are equal; points and cells are
/// numbered at random. One point more belongs to no cell.
SourceMesh makeSource(const CellSet& cells, unsigned seed = 1);

/// Adds `steps` steps of a value that varies in time.
void addSeries(SourceMesh& mesh, int steps);

/// Writes the folder of .npy arrays, without the code under test.
void writeFlat(const SourceMesh& mesh, const std::string& folder);

} // namespace test
} // namespace tipp

#endif
