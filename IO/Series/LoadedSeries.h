// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippLoadedSeries_h
#define tippLoadedSeries_h

#include "Models/ModelMesh.h"
#include "Series/CellSeries.h"

#include <cstddef>
#include <string>
#include <vector>

namespace tipp
{

/// A MeshSeries of small files, which are kept in memory.
class LoadedSeries : public CellSeries
{
public:
  /// Takes a mesh, with its columns as variables at nodes.
  LoadedSeries(
    const std::string& path, const std::string& kind, ModelMesh mesh, const SeriesOptions& options);

  /// Adds a variable with the values of all steps, each `components` values per node: several
  /// variables that are components of a vector, if there are more than one. Files of several steps
  /// must have equal times. Throws IOError with the path of the values.
  void addValues(const std::string& path, const SeriesVariable& variable, int components,
    std::vector<double> values, const std::vector<double>& times);

protected:
  std::unique_ptr<CellBlocks> openCells() override;
  void readStored(std::size_t variable, std::size_t step, std::vector<double>& values) override;

private:
  /// Where the values of a variable are in Values.
  struct Source
  {
    std::size_t Array = 0;
    std::size_t Component = 0;
    std::size_t Components = 1;
  };

  void addStatic(const std::string& name, std::vector<double> values, bool isOnCells);

  ModelMesh Mesh; ///< without the columns
  std::vector<std::vector<double>> Values;
  std::vector<Source> Sources;
};

} // namespace tipp

#endif
