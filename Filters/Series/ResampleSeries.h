// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippResampleSeries_h
#define tippResampleSeries_h

#include "Parallel/ParallelFor.h"
#include "Predicates/Geometry.h"
#include "Resample/KeptSamples.h"
#include "Series/MeshSeries.h"
#include "Series/SeriesOutput.h"
#include "Series/SeriesReduction.h"
#include "vtkTIPPFiltersModule.h"

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace tipp
{

/// The grid to resample on.
struct SeriesRange
{
  std::optional<Box2> Bounds;                 ///< nullopt: those of the triangles
  std::array<int, 2> Dimensions = {};         ///< number of samples; see chosenDimensions()
  std::array<double, 2> Delta = { 0.0, 0.0 }; ///< distance of samples; 0: Dimensions applies
};

/// What resampleSeries() computes.
struct SeriesPlan
{
  std::vector<std::size_t> Variables;      ///< indices of MeshSeries::Variables
  std::vector<std::size_t> Steps;          ///< time steps, ascending
  bool WritesSteps = true;                 ///< whether the samples of each step are output
  std::vector<SeriesReduction> Reductions; ///< of each variable that varies
  /// A variable at nodes with the depth of the ground, positive down: water ends in partly wet
  /// triangles where the level is not above the ground (see KeptSamples::waterLevel()).
  std::optional<std::size_t> Depth;
  std::optional<double> NoData; ///< a value that counts as none, such as -99999
  int Threads = 1;
  Report Progress;
};

/// The samples of a grid in a series' mesh.
struct SeriesSamples
{
  Lattice Grid;
  KeptSamples Kept; ///< takes the values of Nodes, or of Cells
  ///@{ The nodes and cells of the file with the samples' values, for MeshSeries::readAt().
  std::vector<std::int32_t> Nodes;
  std::vector<std::int32_t> Cells;
  ///@}
};

/// Reads the mesh, block by block, and finds the triangles of the samples. Nothing if `progress`
/// stopped it. Throws IOError, std::runtime_error.
VTKTIPPFILTERS_EXPORT std::optional<SeriesSamples> findSamples(
  MeshSeries& series, const SeriesRange& range, int threads, const Report& progress = {});

/// Describes a box in words.
VTKTIPPFILTERS_EXPORT std::string textOf(const Box2& box);

/// The fields that resampleSeries() writes: for each variable those that vary by step, or the one
/// that does not, and its reductions.
VTKTIPPFILTERS_EXPORT SeriesDescription describeSeries(
  const MeshSeries& series, const SeriesPlan& plan, const Lattice& grid);

/// Wall-clock seconds of the parts of resampleSeries(); reading and writing take time beside the
/// others.
struct SeriesTimes
{
  double Reading = 0;
  double Sampling = 0;
  double Reducing = 0;
  double Writing = 0;
};

/// Resamples time steps, one after another: while one is sampled, the next is read and the one
/// before written. Does not close the output. Nothing if the report stopped it. Throws IOError.
VTKTIPPFILTERS_EXPORT std::optional<SeriesTimes> resampleSeries(
  MeshSeries& series, const SeriesSamples& samples, const SeriesPlan& plan, SeriesOutput& output);

} // namespace tipp

#endif
