// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippIoSubjects_h
#define tippIoSubjects_h

#include <cstdint>
#include <string>
#include <vector>

namespace tipp
{
namespace benchmark
{

struct IoArguments
{
  std::vector<std::string> Meshes; ///< flat meshes
  int Repeat = 3;
  int Threads = 2;
  std::vector<std::int64_t> Parts{ 64, 8, 1 };                      ///< M is n over these
  std::vector<std::int64_t> Chunks{ 4096, 65536, 524288, 4000000 }; ///< in cells
};

/// Loading the vertices of all cells, loader by loader, over M, chunk size and the state of the
/// file system's cache. Vertices of the first mesh are in random order, of the second in local
/// order.
void benchmarkLoaders(const IoArguments& arguments);

/// Classification of a chunk of cells, on OpenMP threads and on an OpenCL device, tiling by tiling.
void benchmarkClassify(const IoArguments& arguments);

/// Reading a partitioned mesh, the second, beside VTK's reader on one .vtu, the first.
void benchmarkReading(const IoArguments& arguments);

/// Reading a piece with its borrowed cells: by reference, of the first mesh, and duplicated, of the
/// second.
void benchmarkBorrowing(const IoArguments& arguments);

/// Reading the points of files; `arguments.Meshes` names them.
void benchmarkPoints(const IoArguments& arguments);

} // namespace benchmark
} // namespace tipp

#endif
