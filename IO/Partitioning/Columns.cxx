// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioning/Columns.h"

#include "Parallel/ParallelFor.h"

#include <utility>

namespace tipp
{

Columns::Columns(std::vector<RawArray> arrays)
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

void Columns::read(std::int64_t first, std::int64_t count, int threads)
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

} // namespace tipp
