// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPartitionMesh_h
#define tippPartitionMesh_h

#include "Files/PendingFolder.h"
#include "Flat/FlatMesh.h"
#include "Loading/VertexLoader.h"
#include "OpenCL/DeviceChoice.h"
#include "Partitioning/TilingChoice.h"
#include "vtkTIPPIOModule.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

class vtkMultiProcessController;

namespace tipp
{

struct PartitionOptions
{
  TilingChoice Tiling;
  /// Copies borrowed cells to their borrowers' pieces; else those refer to the owner's.
  bool DuplicateBorrowers = false;
  /// In bytes, of each rank; the loaders', the chunks' and the pieces' buffers keep within it.
  std::uint64_t MemoryLimit = std::uint64_t(2) << 30;
  LoaderOptions Loading;        ///< MemoryLimit in it is set from the above
  std::int64_t ChunkCells = 0;  ///< 0: as many as fit
  std::int64_t ChunkPoints = 0; ///< 0: as many as fit
  DeviceChoice Device;          ///< that classifies cells
  int Threads = 0;              ///< 0: OpenMP's choice
  /// Called on every rank's calling thread, every few thousand points or cells, with the fraction
  /// done; false ends the run on all ranks.
  std::function<bool(double)> Progress;
};

struct PartitionStatistics
{
  struct Phase
  {
    std::string Name;
    double Seconds; ///< on the first rank
  };
  std::int64_t Points = 0;
  std::int64_t Cells = 0;
  std::int64_t Pieces = 0;
  std::int64_t BorderCells = 0;   ///< cells that meet more than one partition
  std::int64_t BorrowedCells = 0; ///< one for each borrower
  std::int64_t CopiedPoints = 0;  ///< points stored in pieces that they do not belong to
  std::uint64_t SpilledBytes = 0; ///< on all ranks
  std::uint64_t MeshBytes = 0;    ///< of all files
  int Ranks = 1;
  int Threads = 1;
  std::string Loader; ///< that was taken
  LoadCounters Loads; ///< of all ranks
  std::vector<Phase> Phases;
  bool Aborted = false; ///< by Progress; nothing was written
};

/// A partitioned mesh gives way to a new one.
extern const Replaceable replaceableMesh;

/// Makes the partitioned mesh `path` of a flat mesh, within the memory limit. The files depend on
/// the mesh, the tiling and the kind of borrowers alone, byte for byte. All is written to a hidden
/// folder beside `path`, which takes the path's place when it is whole and safe on the disk; a
/// partitioned mesh that was there stays until then.
///
/// With a controller its ranks share the work; all must call it and see the same files. Throws
/// IOError, on all ranks if on one.
///
/// A chunk of cells is loaded, classified and updated as in Algorithm 5 of the dissertation, but
/// what is loaded is the partition of each vertex, 4 bytes, and only cells whose vertices do not
/// lie inside one partition need coordinates. Vertices then go to the pieces in one more pass.
VTKTIPPIO_EXPORT PartitionStatistics partitionMesh(const FlatMesh& mesh, const std::string& path,
  const PartitionOptions& options = {}, vtkMultiProcessController* controller = nullptr);

} // namespace tipp

#endif
