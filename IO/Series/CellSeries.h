// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCellSeries_h
#define tippCellSeries_h

#include "Series/CutCells.h"
#include "Series/MeshSeries.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace tipp
{

/// A MeshSeries of a file whose cells may be other than triangles. What reads the file derives from
/// it; this class cuts the cells and gives the triangles and the copies of nodes their values.
class CellSeries : public MeshSeries
{
public:
  SeriesMesh readMesh() final;
  std::vector<double> readNodes() final;
  void read(std::size_t variable, std::size_t step, std::vector<double>& values) final;

protected:
  explicit CellSeries(bool wrap)
    : Wrap(wrap)
  {
  }

  virtual CellMesh readCells() = 0;
  /// Reads a variable's values at the nodes or cells of the file.
  virtual void readStored(std::size_t variable, std::size_t step, std::vector<double>& values) = 0;

  /// Must be called last by the constructor of a class that derives from this one, with the number
  /// of nodes and cells in the file.
  void setSize(std::int64_t nodes, std::int64_t cells);

private:
  void prepare();

  const bool Wrap;
  std::int64_t FileNodes = 0;
  std::int64_t FileCells = 0;
  bool IsPrepared = false;
  std::optional<SeriesMesh> Ready;   ///< cut, and not yet returned by readMesh()
  std::vector<std::int64_t> Parents; ///< the stored cell of each triangle; empty: its own index
  std::vector<std::int64_t> Copies;
};

} // namespace tipp

#endif
