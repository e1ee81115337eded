// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPartitionDataSet_h
#define tippPartitionDataSet_h

#include "Partitioning/PartitionMesh.h"
#include "vtkTIPPIOModule.h"

#include "vtkSmartPointer.h"

#include <string>

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

/// Like partitionMesh(), for a flat mesh or any file that readDataSet() supports, which the first
/// rank reads. If it throws IOError on one rank, it throws on all.
VTKTIPPIO_EXPORT PartitionStatistics partitionInput(const std::string& input,
  const std::string& output, const PartitionOptions& options,
  vtkMultiProcessController* controller = nullptr);

/// Like partitionMesh(), for the first rank's data set (null on the others), which is first written
/// to a temporary flat mesh beside the output. `name` is the input's name in messages. Cells other
/// than triangles and tetrahedra are divided into these; ghosts and the ids of a partitioned mesh
/// are dropped.
VTKTIPPIO_EXPORT PartitionStatistics partitionDataSet(vtkDataSet* data, const std::string& name,
  const std::string& output, const PartitionOptions& options,
  vtkMultiProcessController* controller = nullptr);

} // namespace tipp

#endif
