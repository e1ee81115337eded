// SPDX-License-Identifier: BSD-3-Clause
// Measures decoding a LAZ file to the records of the same LAS file.
#include "IoSubjects.h"

#include "Files/InputFile.h"
#include "Las/LasHeader.h"
#include "Las/LazFile.h"
#include "Parallel/ParallelFor.h"

#include <algorithm>
#include <chrono>
#include <cstdio>

namespace tipp
{
namespace benchmark
{
namespace
{

/// Decodes the whole file, chunk by chunk, two of them at the same time on each thread.
class Decoding
{
public:
  Decoding(const std::string& path, unsigned attributes, int threads)
    : Laz(path, readLasHeader(path))
    , File(path)
    , Threads(threads)
  {
    for (int i = 0; i < 2 * threads; ++i)
    {
      this->Readers.emplace_back(this->Laz, attributes);
    }
    this->Records.resize(std::size_t(2 * threads));
  }

  void run()
  {
    forChunks(std::int64_t(this->Laz.chunks().size()), 2, this->Threads, {},
      [&](std::int64_t begin, std::int64_t end, int thread)
      {
        const std::size_t own = 2 * std::size_t(thread);
        for (std::int64_t i = begin; i < end; ++i)
        {
          this->Readers[own + std::size_t(i - begin)].begin(this->File, std::size_t(i));
        }
        const std::uint64_t first = this->points(begin);
        const std::uint64_t second = end - begin == 2 ? this->points(begin + 1) : 0;
        const std::uint64_t both = std::min(first, second);
        for (std::uint64_t done = 0; done < both; done += step)
        {
          const auto count = std::size_t(std::min(step, both - done));
          this->Readers[own].readWith(this->Readers[own + 1], count, this->roomFor(own, count),
            this->roomFor(own + 1, count));
        }
        this->readRest(own, first - both);
        this->readRest(own + 1, second - both);
      });
  }

  std::int64_t points() const
  {
    std::uint64_t sum = 0;
    for (const LazChunkPlace& chunk : this->Laz.chunks())
    {
      sum += chunk.Points;
    }
    return std::int64_t(sum);
  }

private:
  static constexpr std::uint64_t step = 4096;

  std::uint64_t points(std::int64_t chunk) const
  {
    return this->Laz.chunks()[std::size_t(chunk)].Points;
  }

  char* roomFor(std::size_t reader, std::size_t count)
  {
    std::vector<char>& records = this->Records[reader];
    records.resize(std::max(records.size(), count * this->Laz.format().RecordLength));
    return records.data();
  }

  void readRest(std::size_t reader, std::uint64_t points)
  {
    for (std::uint64_t done = 0; done < points; done += step)
    {
      const auto count = std::size_t(std::min(step, points - done));
      this->Readers[reader].read(count, this->roomFor(reader, count));
    }
  }

  LazFile Laz;
  InputFile File;
  int Threads;
  std::vector<LazReader> Readers; ///< two of each thread
  std::vector<std::vector<char>> Records;
};

} // namespace

void benchmarkLaz(const IoArguments& arguments)
{
  for (const std::string& path : arguments.Meshes)
  {
    for (const unsigned attributes : { laz::Z | laz::Class, laz::All })
    {
      Decoding decoding(path, attributes, arguments.Threads);
      for (int run = 0; run < arguments.Repeat; ++run)
      {
        const auto start = std::chrono::steady_clock::now();
        const double startProcessor = processorSeconds();
        decoding.run();
        const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
        std::printf("%-5s %12lld points %8.3f s %8.3f s of processor\n",
          attributes == laz::All ? "all" : "some", static_cast<long long>(decoding.points()),
          passed.count(), processorSeconds() - startProcessor);
      }
    }
  }
}

} // namespace benchmark
} // namespace tipp
