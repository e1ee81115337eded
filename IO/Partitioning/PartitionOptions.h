// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPartitionOptions_h
#define tippPartitionOptions_h

#include "Loading/VertexLoader.h"
#include "OpenCL/Devices.h"
#include "Partitioning/MeshTiling.h"
#include "Series/MeshSeries.h"

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace tipp
{

/// Options of partitionMesh() and the other functions of PartitionMesh.h.
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
  SeriesOptions Model;          ///< how the output of a model is read
  DeviceChoice Device;          ///< the device that classifies cells
  int Threads = 0;              ///< 0: defaultThreads()
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
  /// Of the output of a model, on the first rank: see MeshSeries.
  std::vector<SeriesLeftOut> VariablesLeftOut;
  std::uint64_t SpilledBytes = 0; ///< on all ranks
  std::uint64_t MeshBytes = 0;    ///< size of all files
  int Ranks = 1;
  int Threads = 1;
  std::string Loader; ///< the loader that was used
  LoadCounters Loads; ///< sum over all ranks
  std::vector<Phase> Phases;
  bool Aborted = false; ///< whether Progress aborted the run; then nothing was written
};

} // namespace tipp

#endif
