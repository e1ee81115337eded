// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTIPPRangeReader
 * @brief   vtkPartitionedUnstructuredReader with a range that ParaView's box widget can hold
 *
 * ParaView's box widget has a corner and lengths instead of bounds, and a check box that enables
 * it. The properties here set Bounds of vtkPartitionedUnstructuredReader; do not set Bounds as
 * well.
 *
 * @sa
 * vtkPartitionedUnstructuredReader
 */

#ifndef vtkTIPPRangeReader_h
#define vtkTIPPRangeReader_h

#include "vtkPartitionedUnstructuredReader.h"
#include "vtkTIPPRangeReaderModule.h" // For export macro

class VTKTIPPRANGEREADER_EXPORT vtkTIPPRangeReader : public vtkPartitionedUnstructuredReader
{
public:
  static vtkTIPPRangeReader* New();
  vtkTypeMacro(vtkTIPPRangeReader, vtkPartitionedUnstructuredReader)
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Whether only the box is read. Off by default: the whole mesh is read.
   */
  void SetUseRange(bool use);
  vtkGetMacro(UseRange, bool);
  ///@}

  ///@{
  /**
   * The box's corner with the lowest coordinates, in the mesh's units. (0, 0, 0) by default.
   */
  void SetRangePosition(double x, double y, double z);
  vtkGetVector3Macro(RangePosition, double);
  ///@}

  ///@{
  /**
   * The box's side lengths, in the mesh's units. (1, 1, 1) by default. With a negative length the
   * box extends in the opposite direction.
   */
  void SetRangeScale(double x, double y, double z);
  vtkGetVector3Macro(RangeScale, double);
  ///@}

protected:
  vtkTIPPRangeReader() = default;
  ~vtkTIPPRangeReader() override = default;

private:
  vtkTIPPRangeReader(const vtkTIPPRangeReader&) = delete;
  void operator=(const vtkTIPPRangeReader&) = delete;

  void UpdateBounds();

  bool UseRange = false;
  double RangePosition[3] = { 0, 0, 0 };
  double RangeScale[3] = { 1, 1, 1 };
};

#endif
