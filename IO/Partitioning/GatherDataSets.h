// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippGatherDataSets_h
#define tippGatherDataSets_h

#include "vtkSmartPointer.h"

class vtkDataObject;
class vtkDataSet;
class vtkMultiProcessController;

namespace tipp
{

/// All ranks' data sets, or those of vtkPartitionedDataSets, as one on the first rank; null on the
/// others. Points at exactly the same place in different ones become one. Throws IOError, on all
/// ranks, if there is no data set at all.
vtkSmartPointer<vtkDataSet> gatherDataSets(
  vtkDataObject* data, vtkMultiProcessController* controller);

} // namespace tipp

#endif
