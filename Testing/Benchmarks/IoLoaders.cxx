// SPDX-License-Identifier: BSD-3-Clause
#include "IoSubjects.h"
#include "LruLoader.h"

#include "Flat/FlatMesh.h"
#include "Loading/VertexLoader.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <stdexcept>

#include <fcntl.h>
#include <unistd.h>

namespace tipp
{
namespace benchmark
{
namespace
{

/// Removes the file from the system's cache, so that the next read comes from the disk.
void dropFromCache(const std::string& path)
{
  const int file = open(path.c_str(), O_RDONLY);
  const bool done =
    file >= 0 && fdatasync(file) == 0 && posix_fadvise(file, 0, 0, POSIX_FADV_DONTNEED) == 0;
  close(file);
  if (!done)
  {
    throw std::runtime_error("the cached pages of " + path + " could not be dropped");
  }
}

struct Column
{
  const char* Name;
  Loader Kind;
  std::int64_t Blocks; ///< of an LRU cache, which ignores Kind; 0 otherwise
  bool WithinM;        ///< its memory is limited to M vertices
};

constexpr std::int64_t fewBlocks = 512;
constexpr std::int64_t manyBlocks = 262144;

const Column columns[] = {
  { "direct", Loader::Direct, 0, true },
  { "fine", Loader::Fine, 0, true },
  { "LRU 512", Loader::Direct, fewBlocks, true },
  { "LRU 256K", Loader::Direct, manyBlocks, true },
  { "auto, M", Loader::Auto, 0, true },
  { "mmap", Loader::Mmap, 0, false },
  { "auto", Loader::Auto, 0, false },
};
constexpr std::size_t columnCount = sizeof(columns) / sizeof(columns[0]);

class Mesh
{
public:
  Mesh(const std::string& path, const char* order)
    : Order(order)
    , Flat(openFlatMesh(path))
  {
    CellReader(this->Flat).read(0, this->Flat.Cells.Tuples, this->Ids);
    dropFromCache(this->Flat.Cells.Path);
  }

  const char* Order;
  FlatMesh Flat;
  std::vector<std::int64_t> Ids;
};

struct Row
{
  const Mesh* Source;
  bool Cold;
  std::int64_t Parts; ///< M is the number of vertices divided by this
  std::int64_t Chunk; ///< number of cells
  double MicrosecondsACell[columnCount];
  LoadCounters Counters[columnCount];
  std::int64_t Misses; ///< of the last LRU cache
};

class LoaderBenchmark
{
public:
  explicit LoaderBenchmark(const IoArguments& arguments)
    : Arguments(arguments)
  {
  }

  /// Measures all columns: microseconds per cell in the fastest of several runs, in which the
  /// loaders alternate. LRU caches do not depend on the chunk size, so they run once for all rows
  /// that differ only in it.
  void measure(Row& row)
  {
    if (this->Cached.Source != row.Source || this->Cached.Cold != row.Cold ||
      this->Cached.Parts != row.Parts)
    {
      this->Cached = row;
      this->measure(this->Cached, 0, true);
    }
    std::copy_n(this->Cached.MicrosecondsACell, columnCount, row.MicrosecondsACell);
    std::copy_n(this->Cached.Counters, columnCount, row.Counters);
    row.Misses = this->Cached.Misses;
    for (int turn = 0; turn < this->Arguments.Repeat; ++turn)
    {
      this->measure(row, turn, false);
    }
  }

private:
  void measure(Row& row, int turn, bool lru)
  {
    const auto cells = std::int64_t(row.Source->Ids.size()) / row.Source->Flat.CellSize;
    for (std::size_t i = 0; i < columnCount; ++i)
    {
      if ((columns[i].Blocks > 0) == lru)
      {
        const double microseconds = this->run(row, columns[i], cells, row.Counters[i], row.Misses);
        double& best = row.MicrosecondsACell[i];
        best = turn == 0 ? microseconds : std::min(best, microseconds);
      }
    }
  }

  double run(const Row& row, const Column& column, std::int64_t cells, LoadCounters& counters,
    std::int64_t& misses)
  {
    const FlatMesh& mesh = row.Source->Flat;
    LoaderOptions options;
    options.Kind = column.Kind;
    options.Threads = this->Arguments.Threads;
    options.M = std::max<std::int64_t>(mesh.Points.Tuples / row.Parts, 1);
    if (column.WithinM)
    {
      options.MemoryLimit = std::uint64_t(options.M) * mesh.Points.tupleBytes();
    }
    // LRU caches do not depend on chunks, and are slow, so they always load small chunks.
    constexpr std::int64_t small = 4096;
    const std::int64_t chunk = std::min(column.Blocks > 0 ? small : row.Chunk, cells);
    this->Out.resize(std::size_t(chunk * mesh.CellSize) * mesh.Points.tupleBytes());
    if (row.Cold)
    {
      dropFromCache(mesh.Points.Path);
    }
    // Loads only some of many small chunks: runs of consecutive chunks, since these share vertices,
    // from all parts of the mesh.
    constexpr std::int64_t enough = 240;
    constexpr std::int64_t together = 20;
    const std::int64_t chunks = (cells + chunk - 1) / chunk;
    const std::int64_t stride = together * std::max<std::int64_t>(chunks / enough, 1);
    std::int64_t loaded = 0;
    const auto start = std::chrono::steady_clock::now();
    const auto loader = column.Blocks > 0
      ? std::make_unique<LruLoader>(std::vector{ mesh.Points }, options.M, column.Blocks)
      : makeVertexLoader({ mesh.Points }, options);
    void* const out[] = { this->Out.data() };
    for (std::int64_t i = 0; i < chunks; ++i)
    {
      if (i % stride >= together)
      {
        continue;
      }
      const std::int64_t first = i * chunk;
      const std::int64_t size = std::min(chunk, cells - first);
      loader->load(
        row.Source->Ids.data() + first * mesh.CellSize, std::size_t(size * mesh.CellSize), out);
      loaded += size;
    }
    counters = loader->counters();
    if (const auto* const lru = dynamic_cast<const LruLoader*>(loader.get()))
    {
      misses = lru->misses();
    }
    const std::chrono::duration<double, std::micro> spent =
      std::chrono::steady_clock::now() - start;
    return spent.count() / double(loaded);
  }

  const IoArguments& Arguments;
  Row Cached{}; ///< the last row in which the columns of LRU caches were measured
  std::vector<char> Out;
};

void printHeader()
{
  std::printf("Microseconds a cell. 'auto, M' may use the memory of M vertices, 'auto' 512 MiB.\n"
              "%-7s %-5s %6s %9s",
    "order", "cache", "M", "chunk");
  for (const Column& column : columns)
  {
    std::printf(" %9s", column.Name);
  }
  std::printf(" | %9s %9s %9s %9s\n", "reads", "MB", "passes", "misses");
}

/// Prints a row. Counters are those of Direct Load, except for the misses, which are those of LRU.
void print(const Row& row)
{
  std::printf("%-7s %-5s n/%-4lld %9lld", row.Source->Order, row.Cold ? "cold" : "warm",
    (long long)row.Parts, (long long)row.Chunk);
  for (const double microseconds : row.MicrosecondsACell)
  {
    std::printf(" %9.4f", microseconds);
  }
  const LoadCounters& direct = row.Counters[0];
  std::printf(" | %9lld %9.1f %9lld %9lld\n", (long long)direct.Reads, 1e-6 * double(direct.Bytes),
    (long long)direct.Passes, (long long)row.Misses);
  std::fflush(stdout);
}

void printDirectAgainstLru(const std::vector<Row>& rows)
{
  for (const Row& row : rows)
  {
    if (row.Parts == 8 && row.Chunk == 4000000 && row.Source == rows.front().Source)
    {
      const double lru = std::min(row.MicrosecondsACell[2], row.MicrosecondsACell[3]);
      std::printf("Direct Load against the better LRU, M = n/8, chunks of 4M cells, random, %s: "
                  "%.1fx less time\n",
        row.Cold ? "cold" : "warm", lru / row.MicrosecondsACell[0]);
    }
  }
}

void printFineAgainstDirect(
  const std::vector<Row>& rows, const Mesh& mesh, const std::vector<std::int64_t>& chunks)
{
  for (const std::int64_t chunk : chunks)
  {
    double least = 0;
    double most = 0;
    for (const Row& row : rows)
    {
      if (row.Source == &mesh && row.Chunk == chunk)
      {
        const double ratio = row.MicrosecondsACell[0] / row.MicrosecondsACell[1];
        least = least == 0 ? ratio : std::min(least, ratio);
        most = std::max(most, ratio);
      }
    }
    std::printf(
      "Fine against Algorithm 4, %s order, chunks of %lld cells: %.2fx to %.2fx as fast\n",
      mesh.Order, (long long)chunk, least, most);
  }
}

/// Prints the row in which an automatic choice was slowest, compared with the first `candidates`
/// loaders.
void printAuto(const std::vector<Row>& rows, std::size_t automatic, std::size_t candidates)
{
  double worst = 0;
  const Row* at = nullptr;
  for (const Row& row : rows)
  {
    double best = row.MicrosecondsACell[0];
    for (std::size_t column = 1; column < candidates; ++column)
    {
      const bool other = column != automatic && columns[column].Kind != Loader::Auto;
      best = other ? std::min(best, row.MicrosecondsACell[column]) : best;
    }
    const double ratio = row.MicrosecondsACell[automatic] / best;
    if (ratio > worst)
    {
      worst = ratio;
      at = &row;
    }
  }
  std::printf("'%s' against the best %s: at worst %.2fx the time (%s, %s, n/%lld, %lld)\n",
    columns[automatic].Name, candidates > 5 ? "of all" : "of those within M", worst,
    at->Source->Order, at->Cold ? "cold" : "warm", (long long)at->Parts, (long long)at->Chunk);
}

} // namespace

void benchmarkLoaders(const IoArguments& arguments)
{
  const Mesh meshes[] = { { arguments.Meshes[0], "random" }, { arguments.Meshes[1], "local" } };
  LoaderBenchmark benchmark(arguments);
  std::vector<Row> rows;
  printHeader();
  for (const Mesh& mesh : meshes)
  {
    for (const bool cold : { false, true })
    {
      for (const std::int64_t parts : arguments.Parts)
      {
        for (const std::int64_t chunk : arguments.Chunks)
        {
          // The system reads ahead: a few small chunks would be charged for reading the whole file.
          if (cold && chunk < 65536)
          {
            continue;
          }
          Row row{ &mesh, cold, parts, chunk, {}, {}, 0 };
          benchmark.measure(row);
          print(row);
          rows.push_back(row);
        }
      }
    }
  }
  printDirectAgainstLru(rows);
  printFineAgainstDirect(rows, meshes[0], arguments.Chunks);
  printFineAgainstDirect(rows, meshes[1], arguments.Chunks);
  printAuto(rows, 4, 5);
  printAuto(rows, 6, 7);
}

} // namespace benchmark
} // namespace tipp
