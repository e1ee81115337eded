// SPDX-License-Identifier: BSD-3-Clause
// Direct Load: Algorithm 4 of the dissertation "Efficient Generating and Processing of Large-Scale
// Unstructured Meshes".
#include "Loading/ArrayFiles.h"
#include "Loading/GroupedMoves.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace tipp
{
namespace
{

class DirectLoader : public VertexLoader
{
public:
  DirectLoader(ArrayFiles files, std::int64_t m, int threads)
    : Files(std::move(files))
    // Positions in the buffers are 32-bit numbers.
    , M(std::min<std::int64_t>(m, std::numeric_limits<std::uint32_t>::max()))
    , Threads(threads)
  {
  }

  void load(const std::int64_t* ids, std::size_t count, void* const* out) override
  {
    const IdRange range = this->Files.range(ids, count, this->Threads);
    if (count == 0)
    {
      return;
    }
    this->Counts.UsefulBytes += std::int64_t(count * this->Files.recordBytes());
    const std::int64_t chunkRange = range.High - range.Low + 1;
    if (chunkRange <= this->M)
    {
      this->readSegment(range.Low, chunkRange);
      gatherAll(count, this->Files, this->Buffers, out, this->Threads,
        [ids, low = range.Low](std::size_t i) { return std::uint64_t(ids[i] - low); });
      return;
    }
    const std::size_t segments = std::size_t((range.High - range.Low) / this->M) + 1;
    const Divisor m{ std::uint64_t(this->M) };
    this->Moves.sort(count, segments, this->Threads,
      [this, ids, &m, low = range.Low](std::size_t i)
      {
        const auto relative = std::uint64_t(ids[i] - low);
        const std::uint64_t segment = m.quotient(relative);
        return std::make_pair(segment, std::uint32_t(relative - segment * std::uint64_t(this->M)));
      });
    const std::vector<std::size_t> active = this->Moves.wanted();
    for (const std::size_t segment : active)
    {
      const std::int64_t first = range.Low + std::int64_t(segment) * this->M;
      this->readSegment(first, std::min(this->M, range.High + 1 - first));
      this->Moves.gather(
        segment, segment == active.back(), this->Files, this->Buffers, out, this->Threads);
    }
  }

  const LoadCounters& counters() const override { return this->Counts; }
  Loader kind() const override { return Loader::Direct; }

private:
  void readSegment(std::int64_t first, std::int64_t size)
  {
    this->Buffers.resize(this->Files, size);
    for (std::size_t a = 0; a < this->Files.count(); ++a)
    {
      this->Files.read(a, first, size, this->Buffers.data(a), this->Threads, this->Counts);
    }
    ++this->Counts.Passes;
  }

  ArrayFiles Files;
  std::int64_t M;
  int Threads;
  LoadCounters Counts;
  TupleBuffers Buffers;
  GroupedMoves Moves;
};

} // namespace

std::unique_ptr<VertexLoader> makeDirectLoader(ArrayFiles files, std::int64_t m, int threads)
{
  return std::make_unique<DirectLoader>(std::move(files), m, threads);
}

} // namespace tipp
