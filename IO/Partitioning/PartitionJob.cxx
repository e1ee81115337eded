// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioning/PartitionJob.h"

#include "Parallel/ParallelFor.h"
#include "Parallel/Poll.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace tipp
{

ArrayRows::ArrayRows(std::vector<RawArray> arrays)
  : Arrays(std::move(arrays))
  , Values(this->Arrays.size())
{
  for (const RawArray& array : this->Arrays)
  {
    this->Bytes.push_back(array.tupleBytes());
    this->RowBytes += array.tupleBytes();
    std::unique_ptr<InputFile>& file = this->Files[array.Path];
    if (!file)
    {
      file = std::make_unique<InputFile>(array.Path);
    }
  }
}

void ArrayRows::read(std::int64_t first, std::int64_t count, int threads)
{
  parallelFor(std::int64_t(this->Arrays.size()), threads,
    [&](std::int64_t number)
    {
      const auto a = std::size_t(number);
      const RawArray& array = this->Arrays[a];
      this->Values[a].resize(std::size_t(count) * this->Bytes[a]);
      this->Files.at(array.Path)
        ->read(array.Offset + std::uint64_t(first) * this->Bytes[a], this->Values[a].data(),
          this->Values[a].size());
    });
}

void makeDistinct(std::vector<GhostPoint>& points)
{
  const auto keyOf = [](const GhostPoint& p)
  { return std::make_tuple(p.Point, p.Piece, p.GhostOnly); };
  std::sort(points.begin(), points.end(),
    [&](const GhostPoint& a, const GhostPoint& b) { return keyOf(a) < keyOf(b); });
  points.erase(std::unique(points.begin(), points.end(),
                 [](const GhostPoint& a, const GhostPoint& b)
                 { return a.Point == b.Point && a.Piece == b.Piece; }),
    points.end());
}

PartitionJob::PartitionJob(const FlatMesh& mesh, const PartitionOptions& options,
  const Ranks& ranks, const std::string& folder)
  : Mesh(mesh)
  , Options(options)
  , Team(ranks)
  , Threads(threadCount(options.Threads))
  , Folder(folder)
{
}

RawArray PartitionJob::owners() const
{
  RawArray array;
  array.Name = "owners";
  array.Path = this->scratch("owners");
  array.Type = Scalar::Int32;
  array.Tuples = this->Mesh.Points.Tuples;
  return array;
}

LoaderOptions PartitionJob::loaderOptions() const
{
  LoaderOptions options = this->Options.Loading;
  options.MemoryLimit = this->Options.MemoryLimit / 4;
  options.Threads = this->Threads;
  return options;
}

void PartitionJob::report(double fraction)
{
  this->Fraction = fraction;
  poll();
}

} // namespace tipp
