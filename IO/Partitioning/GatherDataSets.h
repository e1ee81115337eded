// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippGatherDataSets_h
#define tippGatherDataSets_h

#include "vtkSmartPointer.h"

class vtkDataObject;
class vtkDataSet;
class vtkMultiProcessController;

namespace tipp
{

/// Merges all ranks' data sets, or those in vtkPartitionedDataSets, into one on the first rank;
/// returns null on the others. Points of different data sets with equal coordinates are merged.
/// Throws IOError, on all ranks, if there is no data set at all.
vtkSmartPointer<vtkDataSet> gatherDataSets(
  vtkDataObject* data, vtkMultiProcessController* controller);

} // namespace tipp

#endif
