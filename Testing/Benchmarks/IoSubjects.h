// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippIoSubjects_h
#define tippIoSubjects_h

#include "ProcessorTime.h"

#include <cstdint>
#include <string>
#include <vector>

namespace tipp
{
namespace benchmark
{

struct IoArguments
{
  std::vector<std::string> Meshes; ///< paths of flat meshes, or of files of points
  int Repeat = 3;
  int Threads = 2;
  std::vector<std::int64_t> Parts{ 64, 8, 1 }; ///< M: number of vertices / these
  std::vector<std::int64_t> Chunks{ 4096, 65536, 524288, 4000000 }; ///< numbers of cells
};

/// Measures loading the vertices of all cells, for each loader, M, chunk size and state of the
/// system's file cache. The first mesh has vertices in random order, the second in local order.
void benchmarkLoaders(const IoArguments& arguments);

/// Measures classification of a chunk of cells on OpenMP threads and on an OpenCL device, for
/// several tilings.
void benchmarkClassify(const IoArguments& arguments);

/// Compares reading a partitioned mesh, the second, with VTK's reader on one .vtu, the first.
void benchmarkReading(const IoArguments& arguments);

/// Compares reading a piece with its borrowed cells: by reference from the first mesh, and
/// duplicated from the second.
void benchmarkBorrowing(const IoArguments& arguments);

/// Measures reading the points of the files in `arguments.Meshes`.
void benchmarkPoints(const IoArguments& arguments);

/// Measures decoding LAZ files, the paths in `arguments.Meshes`, to records: x, y, z, returns and
/// classes alone ('some'), and all attributes. Prints each run.
void benchmarkLaz(const IoArguments& arguments);

} // namespace benchmark
} // namespace tipp

#endif
