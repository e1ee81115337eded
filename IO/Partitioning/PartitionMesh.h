// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPartitionMesh_h
#define tippPartitionMesh_h

#include "Flat/FlatMesh.h"
#include "Loading/VertexLoader.h"
#include "OpenCL/Devices.h"
#include "Partitioned/PartitionedMesh.h"
#include "Partitioning/MeshTiling.h"
#include "vtkTIPPIOModule.h"

#include <cstdint>
#include <functional>
#include <map>
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

/// Options of partitionMesh() and the functions below.
struct PartitionOptions
{
  TilingChoice Tiling;
  /// Whether borrowed cells are copied to their borrowers' pieces; if not, pieces refer to the
  /// owner's.
  bool DuplicateBorrowers = false;
  /// Whether the mesh gets a cell array NeighborIds: for each corner the global id of the cell
  /// across the opposite edge or face, the lowest if there are several, or -1. It replaces an
  /// existing array of that name.
  bool Neighbors = false;
  /// In bytes per rank; bounds the buffers of loaders, chunks and pieces together.
  std::uint64_t MemoryLimit = std::uint64_t(2) << 30;
  LoaderOptions Loading;        ///< its MemoryLimit is derived from the above
  std::int64_t ChunkCells = 0;  ///< 0: as many as fit in memory
  std::int64_t ChunkPoints = 0; ///< 0: as many as fit in memory
  DeviceChoice Device;          ///< the device that classifies cells
  int Threads = 0;              ///< 0: OpenMP's default
  /// Called on every rank's calling thread, every few thousand points or cells, with the fraction
  /// done; returning false aborts the run on all ranks.
  std::function<bool(double)> Progress;
};

/// Statistics of a run. Counts and bytes are sums over all ranks.
struct PartitionStatistics
{
  struct Phase
  {
    std::string Name;
    double Seconds; ///< wall-clock seconds on the first rank
  };
  std::int64_t Points = 0;
  std::int64_t Cells = 0;
  std::int64_t Pieces = 0;
  std::int64_t BorderCells = 0;   ///< cells that meet more than one partition
  std::int64_t BorrowedCells = 0; ///< a cell counts once per borrower
  std::int64_t CopiedPoints = 0;  ///< ghost points stored in pieces
  /// Of a VTK data set on the first rank: as in Flattened.
  std::map<std::string, std::int64_t> LeftOut;
  std::int64_t GhostCells = 0;
  std::uint64_t SpilledBytes = 0; ///< on all ranks
  std::uint64_t MeshBytes = 0;    ///< size of all files
  int Ranks = 1;
  int Threads = 1;
  std::string Loader; ///< the loader that was used
  LoadCounters Loads; ///< sum over all ranks
  std::vector<Phase> Phases;
  bool Aborted = false; ///< whether Progress aborted the run; then nothing was written
};

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
/// and returns their arrays in the same order. Throws IOError if two names would be equal in the
/// pieces.
std::vector<RawArray> describeArrays(const FlatMesh& mesh, PartitionedMesh& result);

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
