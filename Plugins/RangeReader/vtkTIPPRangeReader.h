// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTIPPRangeReader
 * @brief   vtkPartitionedUnstructuredReader with a range that ParaView's box widget can hold
 *
 * The box widget has a corner and lengths where vtkPartitionedUnstructuredReader has Bounds, and
 * a switch says whether the box counts. The properties here set Bounds; setting Bounds as well
 * makes no sense.
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
   * Whether only the box is read. Off by default: all of the mesh.
   */
  void SetUseRange(bool use);
  vtkGetMacro(UseRange, bool);
  ///@}

  ///@{
  /**
   * The box's corner of least coordinates, (0, 0, 0) by default, in the mesh's units.
   */
  void SetRangePosition(double x, double y, double z);
  vtkGetVector3Macro(RangePosition, double);
  ///@}

  ///@{
  /**
   * The box's lengths, (1, 1, 1) by default, in the mesh's units. A negative one reaches the other
   * way.
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
