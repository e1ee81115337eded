// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDataSetRows_h
#define tippDataSetRows_h

#include "Ranks/Communicator.h"

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <cstddef>
#include <vector>

class vtkPointSet;
class vtkPolyData;

namespace tipp
{

///@{
/// Packs a data set into a message, and unpacks it. Throws std::runtime_error on failure.
Bytes packDataSet(vtkPolyData* data);
vtkSmartPointer<vtkPolyData> unpackDataSet(const Bytes& bytes);
///@}

/// A point of one of several data sets.
struct DataSetRow
{
  std::size_t Set;
  vtkIdType Row;
};

/// Copies rows of data sets in the order of `rows`. The result has the point arrays that all data
/// sets have, without global ids, and coordinates in double precision.
vtkSmartPointer<vtkPolyData> copyRows(
  const std::vector<vtkSmartPointer<vtkPointSet>>& from, const std::vector<DataSetRow>& rows);

} // namespace tipp

#endif
