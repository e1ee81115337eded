// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPartitionMesh_h
#define tippPartitionMesh_h

#include "Flat/FlatMesh.h"
#include "Partitioned/PartitionedMesh.h"
#include "Partitioning/PartitionOptions.h"
#include "vtkTIPPIOModule.h"

#include <functional>
#include <string>
#include <vector>

// Declared alone: the wheel is built without VTK.
class vtkDataObject;
class vtkDataSet;
class vtkMultiProcessController;
template <class T>
class vtkSmartPointer;

namespace tipp
{

/// Partitions a flat mesh and writes it to `path`, within the memory limit. The files depend only
/// on the mesh, the tiling and DuplicateBorrowers, byte for byte. They are written to a hidden
/// folder beside `path`, which is moved to `path` once it is complete and synced; a partitioned
/// mesh at `path` is kept until then.
///
/// With a controller its ranks share the work; all must call this function and have access to the
/// same files. If it throws IOError on one rank, it throws on all.
///
/// A chunk of cells is loaded, classified and updated as in Algorithm 5 of the dissertation. But
/// instead of coordinates it loads the partition of each vertex, 4 bytes, and coordinates only of
/// cells whose vertices do not all lie inside one partition. One more pass distributes the points
/// to the pieces.
VTKTIPPIO_EXPORT PartitionStatistics partitionMesh(const FlatMesh& mesh, const std::string& path,
  const PartitionOptions& options = {}, vtkMultiProcessController* controller = nullptr);

/// Like partitionMesh(), for a mesh in memory: the first rank calls `make` and writes its result to
/// a temporary flat mesh beside the output. `name` is the input's name in messages. The ids of a
/// partitioned mesh are dropped. If it throws IOError on one rank, it throws on all.
VTKTIPPIO_EXPORT PartitionStatistics partitionInMemory(const std::function<FlatContent()>& make,
  const std::string& name, const std::string& output, const PartitionOptions& options,
  vtkMultiProcessController* controller = nullptr);

/// Lists the flat mesh's attributes in result.Arrays, one for each step of those that vary in time,
/// copies what the mesh says of its numbers, and returns their arrays in the same order. Throws
/// IOError if two names would be equal in the pieces.
std::vector<RawArray> describeArrays(const FlatMesh& mesh, PartitionedMesh& result);

/// Merges all ranks' data sets, or those in vtkPartitionedDataSets, into one on the first rank;
/// returns null on the others. Points of different data sets with equal coordinates are merged.
/// Throws IOError, on all ranks, if there is no data set at all.
vtkSmartPointer<vtkDataSet> gatherDataSets(
  vtkDataObject* data, vtkMultiProcessController* controller);

/// Like partitionMesh(), for a flat mesh, or the output of a model or any file that readDataSet()
/// supports, which the first rank reads. If it throws IOError on one rank, it throws on all.
VTKTIPPIO_EXPORT PartitionStatistics partitionInput(const std::string& input,
  const std::string& output, const PartitionOptions& options,
  vtkMultiProcessController* controller = nullptr);

/// partitionInput() for a file that VTK reads, after the output's path is checked. Throws IOError
/// in a build without VTK.
PartitionStatistics partitionVtkFile(const std::string& input, const std::string& output,
  const PartitionOptions& options, vtkMultiProcessController* controller);

/// Like partitionMesh(), for the first rank's data set (null on the others), which is first written
/// to a temporary flat mesh beside the output. `name` is the input's name in messages. Cells other
/// than triangles and tetrahedra are divided into these; ghosts and the ids of a partitioned mesh
/// are dropped.
VTKTIPPIO_EXPORT PartitionStatistics partitionDataSet(vtkDataSet* data, const std::string& name,
  const std::string& output, const PartitionOptions& options,
  vtkMultiProcessController* controller = nullptr);

} // namespace tipp

#endif
