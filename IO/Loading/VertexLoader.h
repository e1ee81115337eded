// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippVertexLoader_h
#define tippVertexLoader_h

#include "Flat/RawArray.h"
#include "vtkTIPPIOModule.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace tipp
{

/// What a loader has done since it was made.
struct LoadCounters
{
  std::int64_t Reads = 0;       ///< calls to read from a file
  std::int64_t Bytes = 0;       ///< read from files
  std::int64_t UsefulBytes = 0; ///< given to the caller, a vertex as often as it was asked for
  std::int64_t Passes = 0;      ///< segments (Direct) or groups of runs (Fine) held in memory
  std::int64_t CacheMisses = 0; ///< blocks that the cache did not hold (Lru)
};

enum class Loader
{
  Auto,   ///< Mmap if the arrays fit well into the memory limit, else Fine
  Direct, ///< Direct Load, Algorithm 4 of the dissertation
  Fine,   ///< Direct Load with a bit for about 1,024 vertices instead of one for M
  Lru,    ///< a cache of blocks, the least recently used one being replaced
  Mmap    ///< the files are mapped into memory
};

/// "auto", "direct", "fine", "lru", "mmap"; throws std::invalid_argument for any other name.
VTKTIPPIO_EXPORT Loader loaderFromName(const std::string& name);
VTKTIPPIO_EXPORT const char* loaderName(Loader kind);

struct LoaderOptions
{
  Loader Kind = Loader::Auto;
  /// Vertices in memory at once (the dissertation's vertex memory threshold); 0: as many as fit in
  /// MemoryLimit. Mmap knows no such limit.
  std::int64_t M = 0;
  std::int64_t Blocks = 262144; ///< that Lru's M vertices are divided into
  /// In bytes, for the vertices held; 0: 512 MiB.
  std::uint64_t MemoryLimit = 0;
  int Threads = 0; ///< 0: OpenMP's choice. Lru works on one.
};

/// Loads tuples of arrays that lie in files by their ids, in any order: the "load" phase of a
/// partitioner, a chunk of cells a call. The result does not depend on the kind of loader, its
/// options or the number of threads.
class VTKTIPPIO_EXPORT VertexLoader
{
public:
  VertexLoader() = default;
  virtual ~VertexLoader();
  VertexLoader(const VertexLoader&) = delete;
  VertexLoader& operator=(const VertexLoader&) = delete;

  /// out[a] + i * tupleBytes of array a gets tuple ids[i] of that array. Throws IOError if a file
  /// cannot be read or an id is not that of a tuple.
  virtual void load(const std::int64_t* ids, std::size_t count, void* const* out) = 0;
  virtual const LoadCounters& counters() const = 0;
  virtual Loader kind() const = 0;
};

/// A loader of arrays that all have the same number of tuples. Throws IOError if a file cannot be
/// opened or does not hold its array whole; std::invalid_argument if the arrays differ in tuples.
VTKTIPPIO_EXPORT std::unique_ptr<VertexLoader> makeVertexLoader(
  std::vector<RawArray> arrays, const LoaderOptions& options = {});

} // namespace tipp

#endif
