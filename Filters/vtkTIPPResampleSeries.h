// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTIPPResampleSeries
 * @brief   samples time steps of the output of a model on a regular grid
 *
 * vtkTIPPResampleSeries does what `tipp resample --step` does, and keeps the maps in memory. The
 * triangles of the samples are found once; then the steps are read and sampled one after another.
 * FileName is the output of a model, as vtkPartitionedUnstructuredReader reads it, or a flat or
 * partitioned mesh of triangles, with time steps or without.
 *
 * The output is a vtkTable with a row for each sample, x fastest, from the lowest y on. Each column
 * is an array of floats: with one component if it does not vary in time, and otherwise with a
 * component for each chosen step. NaN stands for no value: outside of the mesh, and in triangles
 * with a dry corner.
 *
 * Its field data have the grid, "Origin", "Spacing" and "Dimensions" (2 numbers each), the chosen
 * steps, "Steps" and "Times", and texts as the file states them, in the manner of CF: "TimeUnits",
 * "Calendar", "ReferenceSystem" (WKT, or else as in the file) and, for each column, "LongNames",
 * "StandardNames", "Units" and "Varies". Texts are empty where the file says nothing.
 *
 * @warning It does not work in parallel over ranks.
 *
 * @sa
 * vtkPartitionedUnstructuredReader vtkRangeResampleFilter
 */

#ifndef vtkTIPPResampleSeries_h
#define vtkTIPPResampleSeries_h

#include "vtkTIPPFiltersModule.h" // For export macro
#include "vtkTIPPSetGet.h"        // For property macros
#include "vtkTableAlgorithm.h"

#include <string> // For names
#include <vector> // For names

class VTKTIPPFILTERS_EXPORT vtkTIPPResampleSeries : public vtkTableAlgorithm
{
public:
  static vtkTIPPResampleSeries* New();
  vtkTypeMacro(vtkTIPPResampleSeries, vtkTableAlgorithm)
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The output of a model, or a flat or partitioned mesh of triangles. None by default.
   */
  vtkTIPPFilePathMacro(FileName);
  ///@}

  ///@{
  /**
   * Of the output of a model: more files, with values at the nodes or cells of the mesh in
   * FileName. None by default.
   */
  vtkTIPPNameListMacro(ValuesFileName);
  ///@}

  ///@{
  /**
   * Of the output of a model in degrees: whether cells that cross the meridian at which longitudes
   * jump are on either side of it. Off by default: then such cells are an error.
   */
  vtkTIPPSwitchMacro(Wrap, bool);
  ///@}

  ///@{
  /**
   * Whether only what is inside Bounds is sampled. Off by default: then the grid is that of the
   * mesh's bounding box.
   */
  vtkTIPPSwitchMacro(UseBounds, bool);
  ///@}

  ///@{
  /**
   * The range as (xmin, xmax, ymin, ymax), both ends included, in the units of the mesh. (0, 1, 0,
   * 1) by default. It is an error if it does not meet the mesh.
   */
  vtkSetVector4Macro(Bounds, double);
  vtkGetVector4Macro(Bounds, double);
  ///@}

  ///@{
  /**
   * The number of samples along x and y; 0: spaced as along the other axis. (256, 0) by default.
   */
  vtkSetVector2Macro(SamplingDimensions, int);
  vtkGetVector2Macro(SamplingDimensions, int);
  ///@}

  ///@{
  /**
   * The distance of samples along x and y, which is used instead of SamplingDimensions if one is
   * above 0. (0, 0) by default.
   */
  vtkSetVector2Macro(Delta, double);
  vtkGetVector2Macro(Delta, double);
  ///@}

  ///@{
  /**
   * The time steps: a number, counted from 0, "all", or "FIRST:LAST:STRIDE", where each may be left
   * out, and LAST is included. None by default: all.
   */
  vtkTIPPStringMacro(Steps);
  ///@}

  ///@{
  /**
   * The names of the arrays to sample. An empty list by default: all, or with reductions those that
   * vary in time.
   */
  vtkTIPPNameListMacro(Array);
  ///@}

  ///@{
  /**
   * Maps that are made of all chosen steps: "max", "min", "mean", "time-of-max" or "above:LEVEL".
   * None by default.
   */
  vtkTIPPNameListMacro(Reduction);
  ///@}

  ///@{
  /**
   * With Reductions: whether the steps are in the output, too. Off by default.
   */
  vtkTIPPSwitchMacro(WithSteps, bool);
  ///@}

  ///@{
  /**
   * The array with the depth of the ground, positive down: water ends in partly wet triangles where
   * the level is not above the ground. None by default.
   */
  vtkTIPPStringMacro(Waterline);
  ///@}

  ///@{
  /**
   * The coordinate reference system, such as "EPSG:32617", instead of the one that the file states.
   * None by default.
   */
  vtkTIPPStringMacro(ReferenceSystem);
  ///@}

  ///@{
  /**
   * Whether NoDataValue counts as no value, such as -99999 at dry nodes. Off by default.
   */
  vtkTIPPSwitchMacro(UseNoDataValue, bool);
  vtkSetMacro(NoDataValue, double);
  vtkGetMacro(NoDataValue, double);
  ///@}

  ///@{
  /**
   * The number of OpenMP threads. 0, the default: OMP_NUM_THREADS, or as many as the processors
   * that the process may use.
   */
  vtkTIPPClampedMacro(NumberOfThreads, int, 0, 4096);
  ///@}

protected:
  vtkTIPPResampleSeries();
  ~vtkTIPPResampleSeries() override = default;

  int RequestData(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkTIPPResampleSeries(const vtkTIPPResampleSeries&) = delete;
  void operator=(const vtkTIPPResampleSeries&) = delete;

  void Execute(vtkTable* output);

  std::string FileName;
  std::vector<std::string> ValuesFileNames;
  bool Wrap = false;
  bool UseBounds = false;
  double Bounds[4] = { 0, 1, 0, 1 };
  int SamplingDimensions[2] = { 256, 0 };
  double Delta[2] = { 0, 0 };
  std::string Steps;
  std::vector<std::string> Arrays;
  std::vector<std::string> Reductions;
  bool WithSteps = false;
  std::string Waterline;
  std::string ReferenceSystem;
  bool UseNoDataValue = false;
  double NoDataValue = -99999;
  int NumberOfThreads = 0;
};

#endif
