// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTIPPRemap
 * @brief   averages the arrays of a surface over the cells of another one, exactly
 *
 * vtkTIPPRemap has a target and a source, surfaces that are compared in the x-y plane. Its output
 * has the points and cells of the target, the first input, and as cell data, in doubles, the mean
 * of each of the source's arrays over the part of each cell that the source covers: of cell data,
 * and of point data, which are linear in each triangle. The sum of mean, area and covered share
 * over all cells is the integral over the source where the target covers it, up to rounding. The
 * cell array "CoveredShare" is the share of each cell that the source covers, from 0 to 1; it is
 * above 1, with a warning, where cells of the source overlap, each of which counts. Cells that are
 * not covered have the NullValue.
 *
 * Whether two cells meet is decided exactly. The target is a vtkPointSet. The source is one, too,
 * or a composite data set of these. Of a cell array and a point array with the same name, the cell
 * array is averaged. The result does not depend on the number of threads.
 *
 * @warning It does not work in parallel over ranks: each rank requests the whole inputs.
 *
 * @sa
 * vtkRangeResampleFilter vtkTIPPCutFill
 */

#ifndef vtkTIPPRemap_h
#define vtkTIPPRemap_h

#include "vtkDataSetAlgorithm.h"
#include "vtkTIPPFiltersModule.h" // For export macro
#include "vtkTIPPSetGet.h"        // For property macros

#include <cmath>  // For NullValue
#include <string> // For AddArray
#include <vector> // For AddArray

class vtkAlgorithmOutput;
class vtkPointSet;

class VTKTIPPFILTERS_EXPORT vtkTIPPRemap : public vtkDataSetAlgorithm
{
public:
  static vtkTIPPRemap* New();
  vtkTypeMacro(vtkTIPPRemap, vtkDataSetAlgorithm)
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The mesh with the values, the second input.
   */
  void SetSourceData(vtkDataObject* source) { this->SetInputData(1, source); }
  void SetSourceConnection(vtkAlgorithmOutput* source) { this->SetInputConnection(1, source); }
  ///@}

  ///@{
  /**
   * The names of the arrays to average. None by default: all arrays of numbers.
   */
  vtkTIPPNameListMacro(Array);
  ///@}

  ///@{
  /**
   * The mean in cells that are not covered. NaN by default.
   */
  vtkSetMacro(NullValue, double);
  vtkGetMacro(NullValue, double);
  ///@}

  ///@{
  /**
   * The number of OpenMP threads. 0, the default: OMP_NUM_THREADS, or as many as the processors
   * that the process may use.
   */
  vtkTIPPClampedMacro(NumberOfThreads, int, 0, 4096);
  ///@}

protected:
  vtkTIPPRemap();
  ~vtkTIPPRemap() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkTIPPRemap(const vtkTIPPRemap&) = delete;
  void operator=(const vtkTIPPRemap&) = delete;

  void Execute(vtkPointSet* target, vtkDataObject* source, vtkPointSet* output);

  std::vector<std::string> Arrays;
  double NullValue = std::nan("");
  int NumberOfThreads = 0;
};

#endif
