// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDataSetRows_h
#define tippDataSetRows_h

#include "Ranks/Communicator.h"
#include "Triangulation/Triangulate.h"

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <cstddef>
#include <vector>

class vtkPolyData;

namespace tipp
{

///@{
/// A data set as a message. Throws std::runtime_error if it cannot be packed, or read.
Bytes packDataSet(vtkPolyData* data);
vtkSmartPointer<vtkPolyData> unpackDataSet(const Bytes& bytes);
///@}

/// A point of one of several data sets.
struct DataSetRow
{
  PointId To; ///< its order among the rows of all sets
  std::size_t Set;
  vtkIdType Row;
};

/// The rows of data sets, in the order of `rows`, with the point data that all data sets have; no
/// global ids, and coordinates in double precision.
vtkSmartPointer<vtkPolyData> copyRows(
  const std::vector<vtkSmartPointer<vtkPolyData>>& from, const std::vector<DataSetRow>& rows);

} // namespace tipp

#endif
