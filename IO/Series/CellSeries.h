// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCellSeries_h
#define tippCellSeries_h

#include "Series/CutCells.h"
#include "Series/MeshSeries.h"

#include <cstddef>
#include <cstdint>
#include <memory>
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
  SeriesNodes readTriangles(const TakeTriangles& take) final;
  std::vector<double> readNodes() final;
  void read(std::size_t variable, std::size_t step, std::vector<double>& values) final;
  void readAt(std::size_t variable, std::size_t step, const std::vector<std::int32_t>& at,
    std::vector<double>& values) final;

protected:
  explicit CellSeries(bool wrap)
    : Wrap(wrap)
  {
  }

  virtual std::unique_ptr<CellBlocks> openCells() = 0;
  /// Reads a variable's values at the nodes or cells of the file.
  virtual void readStored(std::size_t variable, std::size_t step, std::vector<double>& values) = 0;
  /// Reads a variable's values at some of them, at ascending indices that are all in the file.
  virtual void readSome(std::size_t variable, std::size_t step, const std::vector<std::int32_t>& at,
    std::vector<double>& values);

  /// Must be called last by the constructor of a class that derives from this one, with the number
  /// of nodes and cells in the file.
  void setSize(std::int64_t nodes, std::int64_t cells);

private:
  void prepare();
  /// Takes note of what cutting all cells has shown.
  void finishCutting(CellCutter& cutter);

  const bool Wrap;
  std::int64_t FileNodes = 0;
  std::int64_t FileCells = 0;
  bool IsCut = false;                ///< LeftOut has the cells that are left out
  bool IsPrepared = false;           ///< Parents is known
  std::optional<SeriesMesh> Ready;   ///< cut, and not yet returned by readMesh()
  std::vector<std::int64_t> Parents; ///< the stored cell of each triangle; empty: its own index
  std::vector<std::int64_t> Copies;
};

} // namespace tipp

#endif
