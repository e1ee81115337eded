// SPDX-License-Identifier: BSD-3-Clause
// Exchanges the samples between ranks, and makes the output image and its statistics.
#include "Sampling/ImageOutput.h"

#include "Parallel/ParallelFor.h"
#include "Pipeline/FilterPipeline.h"
#include "Ranks/Communicator.h"
#include "Sampling/HiddenSamples.h"
#include "Statistics/RunStatistics.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkTable.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

namespace tipp
{
namespace
{

using ImageExtent = std::array<int, 6>;

ImageExtent overlap(const ImageExtent& a, const ImageExtent& b)
{
  ImageExtent both;
  for (int axis = 0; axis < 3; ++axis)
  {
    both[2 * axis] = std::max(a[2 * axis], b[2 * axis]);
    both[2 * axis + 1] = std::min(a[2 * axis + 1], b[2 * axis + 1]);
  }
  return both;
}

std::int64_t samplesOf(const ImageExtent& extent)
{
  std::int64_t samples = 1;
  for (int axis = 0; axis < 3; ++axis)
  {
    samples *= std::max(0, extent[2 * axis + 1] - extent[2 * axis] + 1);
  }
  return samples;
}

/// Calls work(first, count) for each row of `part`; `first` is the index of the row's first sample
/// in `whole`.
template <typename Work>
void forRows(const ImageExtent& whole, const ImageExtent& part, const Work& work)
{
  const std::int64_t width = whole[1] - whole[0] + 1;
  const std::int64_t depth = whole[3] - whole[2] + 1;
  for (int z = part[4]; z <= part[5]; ++z)
  {
    for (int y = part[2]; y <= part[3]; ++y)
    {
      const std::int64_t row = (z - whole[4]) * depth + (y - whole[2]);
      work(row * width + (part[0] - whole[0]), std::int64_t(part[1]) - part[0] + 1);
    }
  }
}

std::size_t tupleBytes(const SampledImage::Array& array)
{
  return std::size_t(array.Samples->GetNumberOfComponents()) *
    std::size_t(array.Samples->GetDataTypeSize());
}

char* bytesOf(const SampledImage::Array& array)
{
  return static_cast<char*>(array.Samples->GetVoidPointer(0));
}

/// What every rank knows about another rank's samples.
struct SamplesOfRank
{
  ImageExtent Local;
  ImageExtent Wanted;
  int Dimension;
};

class Exchange
{
public:
  Exchange(SampledImage& local, SampledImage& result, Communicator& ranks)
    : Local(local)
    , Result(result)
    , Ranks(ranks)
    , Rank(ranks.rank())
  {
  }

  void run()
  {
    this->exchangeSummaries();
    this->merge(this->Rank, this->pack(this->Rank));
    // The ranks exchange in pairs, so that few messages are in memory at a time.
    for (int round = 0; round < this->Ranks.size(); ++round)
    {
      const int partner = (round - this->Rank + this->Ranks.size()) % this->Ranks.size();
      if (partner != this->Rank)
      {
        this->Ranks.post(partner, MessageKind::FirstFree, this->pack(partner));
        this->merge(partner, this->Ranks.wait(MessageKind::FirstFree, partner).Content);
      }
    }
  }

private:
  void exchangeSummaries()
  {
    const SamplesOfRank mine{ this->Local.lattice().Extent, this->Result.lattice().Extent,
      this->Local.dimension() };
    std::vector<Bytes> contents;
    for (int rank = 0; rank < this->Ranks.size(); ++rank)
    {
      SaveArchive writer;
      writer(mine);
      this->describe(writer);
      contents.push_back(writer.take());
    }
    for (const Bytes& content : this->Ranks.allToAll(std::move(contents)))
    {
      LoadArchive reader(content);
      this->Others.push_back(reader.get<SamplesOfRank>());
      this->Dimension = std::max(this->Dimension, this->Others.back().Dimension);
      this->Has.push_back(this->learnArrays(reader));
    }
  }

  void describe(SaveArchive& writer) const
  {
    for (const SampledImage::Array& array : this->Local.arrays())
    {
      const int components = array.Samples->GetNumberOfComponents();
      writer(array.Name);
      writer(array.OfCells);
      writer(array.Samples->GetDataType());
      writer(components);
      for (int i = 0; i < components; ++i)
      {
        const char* const name = array.Samples->GetComponentName(i);
        writer(std::string(name ? name : ""));
      }
    }
  }

  /// Adds the arrays of a rank to the result; returns the names of those that the rank has.
  std::vector<std::string> learnArrays(LoadArchive& reader)
  {
    std::vector<std::string> names;
    while (reader.left() > 0)
    {
      const std::string name = reader.get<std::string>();
      const bool ofCells = reader.get<bool>();
      const int type = reader.get<int>();
      const int components = reader.get<int>();
      SampledImage::Array* known = this->Result.findArray(name);
      const bool isNew = !known;
      if (isNew)
      {
        known = &this->Result.addNullArray(name, ofCells, type, components);
      }
      for (int i = 0; i < components; ++i)
      {
        const std::string component = reader.get<std::string>();
        if (isNew && !component.empty())
        {
          known->Samples->SetComponentName(i, component.c_str());
        }
      }
      if (this->Result.accepts(*known, ofCells, type, components))
      {
        names.push_back(name);
      }
    }
    return names;
  }

  bool has(int rank, const std::string& name) const
  {
    const std::vector<std::string>& names = this->Has[std::size_t(rank)];
    return std::find(names.begin(), names.end(), name) != names.end();
  }

  /// The extent that one rank sends to another; may be empty.
  ImageExtent part(int from, int to) const
  {
    const SamplesOfRank& other = this->Others[std::size_t(from)];
    if (other.Dimension < this->Dimension || other.Dimension == 0)
    {
      return { 0, -1, 0, -1, 0, -1 };
    }
    return overlap(other.Local, this->Others[std::size_t(to)].Wanted);
  }

  std::size_t bytes(int from, const ImageExtent& extent) const
  {
    std::size_t tuple = sizeof(CellKey);
    for (const SampledImage::Array& array : this->Result.arrays())
    {
      tuple += this->has(from, array.Name) ? tupleBytes(array) : 0;
    }
    return tuple * std::size_t(samplesOf(extent));
  }

  Bytes pack(int to)
  {
    const ImageExtent part = this->part(this->Rank, to);
    if (samplesOf(part) == 0)
    {
      return {};
    }
    Bytes message(this->bytes(this->Rank, part));
    char* end = message.data();
    const auto append = [&](const char* values, std::size_t size)
    {
      forRows(this->Local.lattice().Extent, part,
        [&](std::int64_t first, std::int64_t count)
        {
          std::memcpy(end, values + std::size_t(first) * size, std::size_t(count) * size);
          end += std::size_t(count) * size;
        });
    };
    append(reinterpret_cast<const char*>(this->Local.keys()), sizeof(CellKey));
    for (const SampledImage::Array& array : this->Result.arrays())
    {
      if (this->has(this->Rank, array.Name))
      {
        append(bytesOf(*this->Local.findArray(array.Name)), tupleBytes(array));
      }
    }
    return message;
  }

  void merge(int from, const Bytes& message)
  {
    const ImageExtent part = this->part(from, this->Rank);
    const std::size_t samples = std::size_t(samplesOf(part));
    if (message.size() != this->bytes(from, part))
    {
      throw std::runtime_error("a message from another rank is damaged.");
    }
    if (samples == 0)
    {
      return;
    }
    std::vector<const char*> sources;
    const char* next = message.data() + samples * sizeof(CellKey);
    for (const SampledImage::Array& array : this->Result.arrays())
    {
      sources.push_back(this->has(from, array.Name) ? next : nullptr);
      next += sources.back() ? samples * tupleBytes(array) : 0;
    }
    std::size_t i = 0;
    forRows(this->Result.lattice().Extent, part,
      [&](std::int64_t first, std::int64_t count)
      {
        for (std::int64_t sample = first; sample < first + count; ++sample, ++i)
        {
          CellKey key;
          std::memcpy(&key, message.data() + i * sizeof key, sizeof key);
          if (key < this->Result.keys()[sample])
          {
            this->Result.keys()[sample] = key;
            this->Result.valid()[sample] = 1;
            this->take(sources, i, sample);
          }
        }
      });
  }

  void take(const std::vector<const char*>& sources, std::size_t i, std::int64_t sample)
  {
    std::size_t next = 0;
    for (const SampledImage::Array& array : this->Result.arrays())
    {
      const char* const source = sources[next++];
      if (source)
      {
        const std::size_t bytes = tupleBytes(array);
        std::memcpy(bytesOf(array) + std::size_t(sample) * bytes, source + i * bytes, bytes);
      }
      else
      {
        this->Result.setNull(array, sample);
      }
    }
  }

  SampledImage& Local;
  SampledImage& Result;
  Communicator& Ranks;
  int Rank;
  int Dimension = 0;
  std::vector<SamplesOfRank> Others;
  std::vector<std::vector<std::string>> Has; ///< by rank: the names of the arrays that it has
};

/// Adds an uninitialised ghost array for points or cells; `data` owns it.
unsigned char* addGhosts(vtkDataSetAttributes* data, std::int64_t count)
{
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  ghosts->SetNumberOfValues(vtkIdType(count));
  data->AddArray(ghosts);
  return ghosts->GetPointer(0);
}

} // namespace

void exchangeSamples(SampledImage& local, SampledImage& result, Communicator& ranks)
{
  Exchange(local, result, ranks).run();
}

std::int64_t fillImage(SampledImage& samples, int threads, vtkImageData* image)
{
  Lattice lattice = samples.lattice();
  image->SetExtent(lattice.Extent.data());
  image->SetOrigin(lattice.Min.data());
  image->SetSpacing(lattice.Delta.data());
  vtkPointData* const data = image->GetPointData();
  for (const SampledImage::Array& array : samples.arrays())
  {
    data->AddArray(array.Samples);
  }
  data->AddArray(samples.mask());
  if (lattice.empty())
  {
    return 0;
  }
  const unsigned char* const valid = samples.valid();
  markHiddenCells(
    lattice, valid, threads, addGhosts(image->GetCellData(), image->GetNumberOfCells()));
  return markHiddenSamples(valid, samples.samples(), threads, addGhosts(data, samples.samples()));
}

void fillTable(const SamplingStatistics& statistics, std::int64_t samples, std::int64_t hits,
  int threads, vtkTable* table)
{
  RunStatistics run;
  run.add("", "Cells", statistics.Cells);
  run.add("", "IgnoredCells", statistics.Ignored);
  run.add("", "VisitedCells", statistics.Claims.VisitedCells);
  run.add("", "Tests", statistics.Claims.Tests);
  run.add("", "ExactTests", statistics.Claims.ExactTests);
  run.add("", "OverlappingClaims", statistics.Claims.OverlappingClaims);
  run.add("", "Samples", samples);
  run.add("", "SamplesHit", hits);
  run.add("", "Threads", threads);
  run.add("", "Device", statistics.Device);
  run.Lists.push_back({ "phases", false,
    { { "", "PhaseName",
        std::vector<std::string>{
          "preparation", "claims", "interpolation", "transfer", "exchange", "output" } },
      { "", "PhaseSeconds",
        std::vector<double>{ statistics.PreparationSeconds, statistics.ClaimSeconds,
          statistics.InterpolationSeconds, statistics.TransferSeconds, statistics.ExchangeSeconds,
          statistics.OutputSeconds } } } });
  table->Initialize();
  fillStatisticsTable(run, table);
}

} // namespace tipp
