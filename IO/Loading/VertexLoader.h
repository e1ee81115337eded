// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippVertexLoader_h
#define tippVertexLoader_h

#include "Files/RawArray.h"
#include "vtkTIPPIOModule.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace tipp
{

/// What a loader has done since its construction.
struct LoadCounters
{
  std::int64_t Reads = 0; ///< read calls
  std::int64_t Bytes = 0; ///< bytes read from files
  /// bytes returned to the caller; repeated vertices count repeatedly
  std::int64_t UsefulBytes = 0;
  std::int64_t Passes = 0; ///< segments (Direct) or groups of runs (Fine) that were loaded
};

/// How vertices are loaded.
enum class Loader
{
  Auto,   ///< Mmap if the arrays fit well within the memory limit, else Fine
  Direct, ///< Direct Load, Algorithm 4 of the dissertation
  Fine,   ///< Direct Load with a bit per 1,024 or so vertices instead of one per M
  Mmap    ///< memory-mapped files
};

/// Parses "auto", "direct", "fine" or "mmap"; throws std::invalid_argument for any other name.
VTKTIPPIO_EXPORT Loader loaderFromName(const std::string& name);

/// Options of makeVertexLoader().
struct LoaderOptions
{
  Loader Kind = Loader::Auto;
  /// Vertices in memory at once (the dissertation's vertex memory threshold M); 0: as many as fit
  /// in MemoryLimit. Mmap ignores it.
  std::int64_t M = 0;
  /// Bytes for the vertices in memory; 0: 512 MiB.
  std::uint64_t MemoryLimit = 0;
  int Threads = 0; ///< 0: defaultThreads().
};

/// Loads tuples of arrays in files by their index in the array, in any order: the "load" phase of a
/// partitioner, one call per chunk of cells. The result does not depend on the kind of loader, its
/// options or the number of threads.
class VTKTIPPIO_EXPORT VertexLoader
{
public:
  VertexLoader() = default;
  virtual ~VertexLoader();
  VertexLoader(const VertexLoader&) = delete;
  VertexLoader& operator=(const VertexLoader&) = delete;

  /// Copies tuple ids[i] of array a to out[a] + i * tupleBytes, for all i and a. Throws IOError if
  /// a file cannot be read or an id is not a tuple's index.
  virtual void load(const std::int64_t* ids, std::size_t count, void* const* out) = 0;
  const LoadCounters& counters() const { return this->Counts; }
  /// The name of the loader that was chosen, such as "mmap".
  virtual const char* name() const = 0;

protected:
  LoadCounters Counts;
};

/// Creates a loader of arrays with equal numbers of tuples. Throws IOError if a file cannot be
/// opened or is too short for its array; std::invalid_argument if the arrays' numbers of tuples
/// differ.
VTKTIPPIO_EXPORT std::unique_ptr<VertexLoader> makeVertexLoader(
  std::vector<RawArray> arrays, const LoaderOptions& options = {});

} // namespace tipp

#endif
