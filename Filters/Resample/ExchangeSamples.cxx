// SPDX-License-Identifier: BSD-3-Clause
#include "Resample/ExchangeSamples.h"

#include "vtkDataArray.h"
#include "vtkMultiProcessController.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <sstream>

namespace tipp
{
namespace
{

using Extent = std::array<int, 6>;

Extent overlap(const Extent& a, const Extent& b)
{
  Extent both;
  for (int axis = 0; axis < 3; ++axis)
  {
    both[2 * axis] = std::max(a[2 * axis], b[2 * axis]);
    both[2 * axis + 1] = std::min(a[2 * axis + 1], b[2 * axis + 1]);
  }
  return both;
}

std::int64_t samplesOf(const Extent& extent)
{
  std::int64_t samples = 1;
  for (int axis = 0; axis < 3; ++axis)
  {
    samples *= std::max(0, extent[2 * axis + 1] - extent[2 * axis] + 1);
  }
  return samples;
}

/// Calls work(first, count) for the rows of a part of an extent, with the first sample's number
/// in that extent.
template <typename Work>
void forRows(const Extent& whole, const Extent& part, const Work& work)
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

/// What every rank knows of every other.
struct RankNote
{
  Extent Local;
  Extent Wanted;
  int Dimension;
  int DescriptionLength;
};

class Exchange
{
public:
  Exchange(SampledImage& local, SampledImage& result, vtkMultiProcessController* controller)
    : Local(local)
    , Result(result)
    , Controller(controller)
    , Rank(controller->GetLocalProcessId())
    , Notes(std::size_t(controller->GetNumberOfProcesses()))
  {
  }

  void run()
  {
    this->shareNotes();
    this->merge(this->Rank, this->pack(this->Rank));
    const int ranks = int(this->Notes.size());
    // In each round the ranks pair up; of a pair the lower one speaks first.
    for (int round = 0; round < ranks; ++round)
    {
      const int partner = (round - this->Rank + ranks) % ranks;
      if (partner != this->Rank)
      {
        this->exchangeWith(partner);
      }
    }
  }

private:
  static constexpr int Tag = 51423;

  void shareNotes()
  {
    const std::string description = this->describe();
    RankNote mine{ this->Local.lattice().Extent, this->Result.lattice().Extent,
      this->Local.dimension(), int(description.size()) };
    const std::size_t ranks = this->Notes.size();
    this->Controller->AllGather(reinterpret_cast<const char*>(&mine),
      reinterpret_cast<char*>(this->Notes.data()), vtkIdType(sizeof mine));
    std::vector<vtkIdType> lengths(ranks);
    std::vector<vtkIdType> offsets(ranks);
    vtkIdType total = 0;
    for (std::size_t i = 0; i < ranks; ++i)
    {
      this->Dimension = std::max(this->Dimension, this->Notes[i].Dimension);
      lengths[i] = this->Notes[i].DescriptionLength;
      offsets[i] = total;
      total += lengths[i];
    }
    std::string all(std::size_t(total), '\0');
    this->Controller->AllGatherV(description.data(), all.data(), vtkIdType(description.size()),
      lengths.data(), offsets.data());
    this->Has.resize(ranks);
    for (std::size_t i = 0; i < ranks; ++i)
    {
      this->learnArrays(all.substr(std::size_t(offsets[i]), std::size_t(lengths[i])), this->Has[i]);
    }
  }

  /// Each array as 'cells type components length name'.
  std::string describe() const
  {
    std::ostringstream text;
    for (const SampledImage::Array& array : this->Local.arrays())
    {
      text << array.OfCells << ' ' << array.Samples->GetDataType() << ' '
           << array.Samples->GetNumberOfComponents() << ' ' << array.Name.size() << ' '
           << array.Name;
    }
    return text.str();
  }

  /// Adds a rank's arrays to the result and notes which of the result's it has.
  void learnArrays(const std::string& description, std::vector<std::string>& names)
  {
    std::istringstream text(description);
    bool ofCells;
    int type;
    int components;
    std::size_t length;
    while (text >> ofCells >> type >> components >> length)
    {
      std::string name(length, '\0');
      text.get();
      text.read(name.data(), std::streamsize(length));
      SampledImage::Array* known = this->Result.findArray(name);
      if (!known)
      {
        known = &this->Result.addNullArray(name, ofCells, type, components);
      }
      if (known->OfCells == ofCells && known->Samples->GetDataType() == type &&
        known->Samples->GetNumberOfComponents() == components)
      {
        names.push_back(name);
      }
    }
  }

  bool has(int rank, const std::string& name) const
  {
    const std::vector<std::string>& names = this->Has[std::size_t(rank)];
    return std::find(names.begin(), names.end(), name) != names.end();
  }

  /// What goes from a rank to another: empty if nothing does.
  Extent part(int from, int to) const
  {
    const RankNote& note = this->Notes[std::size_t(from)];
    if (note.Dimension < this->Dimension || note.Dimension == 0)
    {
      return { 0, -1, 0, -1, 0, -1 };
    }
    return overlap(note.Local, this->Notes[std::size_t(to)].Wanted);
  }

  std::size_t bytes(int from, const Extent& extent) const
  {
    std::size_t tuple = sizeof(CellKey);
    for (const SampledImage::Array& array : this->Result.arrays())
    {
      tuple += this->has(from, array.Name) ? tupleBytes(array) : 0;
    }
    return tuple * std::size_t(samplesOf(extent));
  }

  std::vector<char> pack(int to)
  {
    const Extent part = this->part(this->Rank, to);
    if (samplesOf(part) == 0)
    {
      return {};
    }
    std::vector<char> message(this->bytes(this->Rank, part));
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

  void merge(int from, const std::vector<char>& message)
  {
    const Extent part = this->part(from, this->Rank);
    const std::size_t samples = std::size_t(samplesOf(part));
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
            this->Result.valid()[std::size_t(sample)] = 1;
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

  void exchangeWith(int partner)
  {
    const auto send = [&] { this->send(partner, this->pack(partner)); };
    const auto receive = [&] { this->merge(partner, this->receive(partner)); };
    if (this->Rank < partner)
    {
      send();
      receive();
    }
    else
    {
      receive();
      send();
    }
  }

  static constexpr std::size_t LargestMessage = std::size_t(1) << 30;

  void send(int to, const std::vector<char>& message)
  {
    for (std::size_t begin = 0; begin < message.size(); begin += LargestMessage)
    {
      const std::size_t size = std::min(LargestMessage, message.size() - begin);
      this->Controller->Send(message.data() + begin, vtkIdType(size), to, Tag);
    }
  }

  std::vector<char> receive(int from)
  {
    std::vector<char> message(this->bytes(from, this->part(from, this->Rank)));
    for (std::size_t begin = 0; begin < message.size(); begin += LargestMessage)
    {
      const std::size_t size = std::min(LargestMessage, message.size() - begin);
      this->Controller->Receive(message.data() + begin, vtkIdType(size), from, Tag);
    }
    return message;
  }

  SampledImage& Local;
  SampledImage& Result;
  vtkMultiProcessController* Controller;
  int Rank;
  int Dimension = 0;
  std::vector<RankNote> Notes;
  std::vector<std::vector<std::string>> Has; ///< for each rank the names of its arrays
};

} // namespace

void exchangeSamples(
  SampledImage& local, SampledImage& result, vtkMultiProcessController* controller)
{
  Exchange(local, result, controller).run();
}

} // namespace tipp
