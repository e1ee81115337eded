// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTIPPCutFill
 * @brief   computes cut and fill volumes between two surfaces, exactly
 *
 * vtkTIPPCutFill compares two surfaces whose heights are the z of their points, linear in each
 * triangle: the surface before, the first input, and the surface after, the second one. The two
 * sets of triangles are overlaid exactly. In each common part of two triangles the difference of
 * the heights is linear, so its integrals have no error but rounding. Other cells are cut into
 * triangles.
 *
 * The output is a vtkTable of one row with columns of doubles, in the units of the coordinates:
 * - Cut: the volume below the surface before and above the one after, at least 0
 * - Fill: the volume above the surface before and below the one after, at least 0
 * - Net: Fill minus Cut
 * - Area: the area in the x-y plane that both surfaces cover, to which the volumes belong
 * - OnlyBefore, OnlyAfter: the area that only one of them covers
 *
 * Cells with a corner that is not finite are left out, and cells of a surface that overlap all
 * count; warnings say so. Surfaces without a common area are an error. The result does not depend
 * on the number of threads.
 *
 * @warning It does not work in parallel over ranks: each rank requests the whole inputs.
 *
 * @sa
 * vtkTIPPRemap
 */

#ifndef vtkTIPPCutFill_h
#define vtkTIPPCutFill_h

#include "vtkTIPPFiltersModule.h" // For export macro
#include "vtkTIPPSetGet.h"        // For property macros
#include "vtkTableAlgorithm.h"

class vtkAlgorithmOutput;
class vtkPointSet;

class VTKTIPPFILTERS_EXPORT vtkTIPPCutFill : public vtkTableAlgorithm
{
public:
  static vtkTIPPCutFill* New();
  vtkTypeMacro(vtkTIPPCutFill, vtkTableAlgorithm)
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The surface after, the second input: a vtkPointSet, or a composite data set of these whose
   * parts do not overlap.
   */
  void SetSourceData(vtkDataObject* source) { this->SetInputData(1, source); }
  void SetSourceConnection(vtkAlgorithmOutput* source) { this->SetInputConnection(1, source); }
  ///@}

  ///@{
  /**
   * Whether only what is inside Bounds is compared. Off by default.
   */
  vtkTIPPSwitchMacro(UseBounds, bool);
  ///@}

  ///@{
  /**
   * The range as (xmin, xmax, ymin, ymax), in the units of the points. (0, 1, 0, 1) by default. It
   * is an error if it does not meet the surface before, or is more than ten times as long.
   */
  vtkSetVector4Macro(Bounds, double);
  vtkGetVector4Macro(Bounds, double);
  ///@}

  ///@{
  /**
   * The number of OpenMP threads. 0, the default: OMP_NUM_THREADS, or as many as the processors
   * that the process may use.
   */
  vtkTIPPClampedMacro(NumberOfThreads, int, 0, 4096);
  ///@}

protected:
  vtkTIPPCutFill();
  ~vtkTIPPCutFill() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkTIPPCutFill(const vtkTIPPCutFill&) = delete;
  void operator=(const vtkTIPPCutFill&) = delete;

  void Execute(vtkPointSet* before, vtkDataObject* after, vtkTable* output);

  bool UseBounds = false;
  double Bounds[4] = { 0, 1, 0, 1 };
  int NumberOfThreads = 0;
};

#endif
