// SPDX-License-Identifier: BSD-3-Clause
#include "Las/LasFilePoints.h"

#include "Files/IOError.h"
#include "Las/CopcHierarchy.h"
#include "Las/LazFile.h"
#include "Parallel/ParallelFor.h"

#include <algorithm>
#include <atomic>

namespace tipp
{
namespace
{

/// The points of a compressed file. Some chunks ahead of the stream are decoded at the same time.
class LazPoints : public LasFilePoints
{
public:
  LazPoints(const std::string& path, const LasHeader& header, const PointOptions& options)
    : LasFilePoints(path, header, options)
    , Laz(path, header)
  {
    this->Header.Remark = this->Laz.remark();
    LazPoints::needColumns(true);
    this->AllChunks = this->Laz.chunks().size();
    this->keepChunks(options.Spacing);
    if (options.Las.KeepTruncated)
    {
      this->keepReadable();
    }
  }

  bool next(PointBlock& block, std::size_t most) override
  {
    block.Columns.resize(this->Wanted.size());
    block.resize(0);
    while (block.size() < most && this->hasPoints())
    {
      const PointBlock& from = this->Ahead[this->Served].Points;
      const std::size_t count = std::min(most - block.size(), from.size() - this->ServedOfChunk);
      append(from, this->ServedOfChunk, count, block);
      this->ServedOfChunk += count;
    }
    return block.size() > 0;
  }

  void needColumns(bool areNeeded) override
  {
    this->Needed = this->Filter.attributes();
    for (const LasColumn& column : this->Wanted)
    {
      this->Needed |= areNeeded ? column.Attribute : 0;
    }
  }

  ReadFigures readFigures() const override
  {
    ReadFigures figures = LasFilePoints::readFigures();
    figures.Chunks = std::int64_t(this->AllChunks);
    figures.SkippedChunks = std::int64_t(this->AllChunks - this->Laz.chunks().size());
    return figures;
  }

protected:
  void seek(std::int64_t chunk) override
  {
    std::vector<Decoded>().swap(this->Ahead);
    std::vector<LazReader>().swap(this->Readers);
    this->AheadCount = 0;
    this->Served = 0;
    this->ServedOfChunk = 0;
    this->NextChunk = std::size_t(chunk);
    this->DoneOfChunk = 0;
  }

  std::vector<Counts> countChunks() const override
  {
    const std::size_t chunks = this->Laz.chunks().size();
    std::vector<Counts> counts(chunks);
    std::vector<LazReader> readers = this->makeReaders(1, this->Filter.attributes());
    const InputFile file(this->Path);
    forChunks(std::int64_t(chunks), 1, this->Threads, {},
      [&](std::int64_t i, std::int64_t, int thread)
      {
        const auto chunk = std::size_t(i);
        Share share;
        this->readChunk(readers[std::size_t(thread)], file, chunk, share,
          [&](std::size_t count)
          {
            this->select(count, share);
            counts[chunk].Kept += std::int64_t(share.Kept.size());
          });
        counts[chunk].InRegion = share.InRegion;
      });
    return counts;
  }

private:
  static constexpr std::uint64_t stepRecords = 4096; ///< which stay in the processor's cache
  /// Points that are decoded ahead, unless it takes more of them to have a chunk for each thread.
  std::uint64_t manyPoints() const
  {
    constexpr std::uint64_t manyValues = 1 << 24; // a file says itself how many columns it has
    return std::min<std::uint64_t>(1 << 20, manyValues / (this->Wanted.size() + 2) + 1);
  }
  std::uint64_t mostPoints() const { return 2 * this->manyPoints(); }
  /// Small chunks are decoded together until they have at least this many points.
  static constexpr std::uint64_t fewPoints = 1 << 14;
  /// Records of a chunk of more than mostPoints() that are decoded at a time.
  static constexpr std::uint64_t partOfChunk = 1 << 17;

  /// The selected points of a chunk, or of a part of it.
  struct Decoded : public Share
  {
    PointBlock Points;
    std::uint64_t Records = 0; ///< to decode
    std::size_t Size = 0;      ///< selected points so far
  };

  /// Leaves out the chunks that cannot have points in the region, or that are of finer levels.
  void keepChunks(double spacing)
  {
    if (!this->Header.Copc.empty() && (this->Region || spacing > 0))
    {
      this->Laz.keep(this->chunksOfNodes(spacing));
    }
    else if (const auto ranges = this->indexedRecords())
    {
      this->Laz.keep(this->chunksOfRanges(*ranges));
    }
    this->countRecords();
  }

  /// Returns for each chunk whether it is a node that is needed.
  std::vector<bool> chunksOfNodes(double spacing) const
  {
    std::vector<bool> isKept(this->Laz.chunks().size(), false);
    for (const CopcNode& node :
      findCopcNodes(this->Path, this->Header, this->Laz.chunks(), { this->Region, spacing }))
    {
      isKept[node.Chunk] = true;
    }
    return isKept;
  }

  /// Returns for each chunk whether it has some of the records.
  std::vector<bool> chunksOfRanges(const std::vector<RecordRange>& ranges) const
  {
    std::vector<bool> isKept;
    auto range = ranges.begin();
    for (const LazChunkPlace& place : this->Laz.chunks())
    {
      while (range != ranges.end() && range->End <= place.FirstPoint)
      {
        ++range;
      }
      isKept.push_back(range != ranges.end() && range->Begin < place.FirstPoint + place.Points);
    }
    return isKept;
  }

  void countRecords()
  {
    this->Records = 0;
    for (const LazChunkPlace& place : this->Laz.chunks())
    {
      this->Records += std::int64_t(place.Points);
    }
  }

  std::vector<LazReader> makeReaders(std::size_t ofThread, unsigned attributes) const
  {
    std::vector<LazReader> readers;
    readers.reserve(ofThread * std::size_t(this->Threads));
    while (readers.size() < readers.capacity())
    {
      readers.emplace_back(this->Laz, attributes);
    }
    return readers;
  }

  /// Decodes records, and calls take(count) when some are in the share.
  template <typename Take>
  void readRecords(LazReader& reader, std::uint64_t records, Share& share, const Take& take) const
  {
    while (records > 0)
    {
      const std::uint64_t count = std::min(stepRecords, records);
      reader.read(std::size_t(count), this->roomFor(std::size_t(count), share));
      take(std::size_t(count));
      records -= count;
    }
  }

  template <typename Take>
  void readChunk(LazReader& reader, const InputFile& file, std::size_t chunk, Share& share,
    const Take& take) const
  {
    reader.begin(file, chunk);
    this->readRecords(reader, this->Laz.chunks()[chunk].Points, share, take);
  }

  /// Leaves out the first chunk that cannot be decoded, and all after it.
  void keepReadable()
  {
    const std::size_t chunks = this->Laz.chunks().size();
    std::atomic<std::size_t> readable{ chunks };
    std::vector<LazReader> readers = this->makeReaders(1, this->Needed);
    const InputFile file(this->Path);
    forChunks(std::int64_t(chunks), 1, this->Threads, {},
      [&](std::int64_t i, std::int64_t, int thread)
      {
        const auto chunk = std::size_t(i);
        try
        {
          Share share;
          this->readChunk(readers[std::size_t(thread)], file, chunk, share, [](std::size_t) {});
        }
        catch (const IOError&)
        {
          std::size_t before = readable;
          while (chunk < before && !readable.compare_exchange_weak(before, chunk))
          {
          }
        }
      });
    if (readable < chunks)
    {
      const auto points = std::int64_t(this->Laz.chunks()[readable].FirstPoint);
      this->Header.Remark = "announces " + std::to_string(this->Header.Points) +
        " points and can be decompressed up to point " + std::to_string(points) +
        "; those before it are read";
      // What cannot be read does not count as a part that is not needed.
      const std::int64_t records = this->Records;
      this->AllChunks -= chunks - readable;
      this->Laz.keepFirst(readable);
      this->countRecords();
      this->Header.Points -= records - this->Records;
    }
  }

  /// Whether there are points to serve; decodes more if necessary.
  bool hasPoints()
  {
    while (true)
    {
      for (; this->Served < this->AheadCount; ++this->Served, this->ServedOfChunk = 0)
      {
        if (this->ServedOfChunk < this->Ahead[this->Served].Points.size())
        {
          return true;
        }
      }
      if (this->NextChunk == this->Laz.chunks().size())
      {
        this->DroppedOfPass = this->Dropped;
        return false;
      }
      this->decodeAhead();
    }
  }

  void decodeAhead()
  {
    if (this->Readers.empty())
    {
      this->Readers = this->makeReaders(2, this->Needed);
    }
    const bool isLarge = this->Laz.chunks()[this->NextChunk].Points > this->mostPoints();
    this->AheadCount = isLarge ? 1 : this->chunksAhead();
    this->Ahead.resize(std::max(this->Ahead.size(), this->AheadCount));
    this->Served = 0;
    this->ServedOfChunk = 0;
    isLarge ? this->decodePart() : this->decodeChunks();
    for (std::size_t i = 0; i < this->AheadCount; ++i)
    {
      this->Dropped += this->Ahead[i].InRegion - std::int64_t(this->Ahead[i].Points.size());
    }
  }

  /// Returns how many chunks to decode at the same time: if possible two or four for each thread.
  std::size_t chunksAhead() const
  {
    const auto threads = std::size_t(this->Threads);
    const std::size_t left = this->Laz.chunks().size() - this->NextChunk;
    std::uint64_t points = 0;
    std::size_t count = 0;
    for (; count < left && (count < 4 * threads || points < fewPoints); ++count)
    {
      points += this->Laz.chunks()[this->NextChunk + count].Points;
      if (count > 0 && points > (count < threads ? this->mostPoints() : this->manyPoints()))
      {
        break;
      }
    }
    const std::size_t unit = count >= 2 * threads ? 2 * threads : count >= threads ? threads : 1;
    return count < left ? count / unit * unit : count;
  }

  void decodeChunks()
  {
    const InputFile& file = this->file();
    const bool inPairs = this->AheadCount >= 2 * std::size_t(this->Threads);
    forChunks(std::int64_t(this->AheadCount), inPairs ? 2 : 1, this->Threads, {},
      [&](std::int64_t begin, std::int64_t end, int thread)
      {
        LazReader* const readers = &this->Readers[2 * std::size_t(thread)];
        if (end - begin == 2 && this->decodePair(file, std::size_t(begin), readers))
        {
          return;
        }
        for (auto i = std::size_t(begin); i < std::size_t(end); ++i)
        {
          this->start(this->Ahead[i], this->Laz.chunks()[this->NextChunk + i].Points);
          readers->begin(file, this->NextChunk + i);
          this->finish(*readers, this->Ahead[i], this->Ahead[i].Records);
        }
      });
    this->NextChunk += this->AheadCount;
  }

  /// Returns false if one of the chunks is damaged: then they are decoded one after the other, so
  /// that the error is that of the first damaged one, as with any number of threads.
  bool decodePair(const InputFile& file, std::size_t at, LazReader* readers)
  {
    const LazChunkPlace* const places = &this->Laz.chunks()[this->NextChunk + at];
    Decoded* const decoded = &this->Ahead[at];
    const std::uint64_t shorter = std::min(places[0].Points, places[1].Points);
    try
    {
      for (std::size_t i = 0; i < 2; ++i)
      {
        this->start(decoded[i], places[i].Points);
        readers[i].begin(file, this->NextChunk + at + i);
      }
      for (std::uint64_t done = 0; done < shorter; done += stepRecords)
      {
        const auto count = std::size_t(std::min(stepRecords, shorter - done));
        readers[0].readWith(
          readers[1], count, this->roomFor(count, decoded[0]), this->roomFor(count, decoded[1]));
        this->take(count, decoded[0]);
        this->take(count, decoded[1]);
      }
    }
    catch (const LazError&)
    {
      return false;
    }
    catch (const IOError&) // of the second chunk, perhaps; the first may be damaged, too
    {
      return false;
    }
    for (std::size_t i = 0; i < 2; ++i)
    {
      this->finish(readers[i], decoded[i], places[i].Points - shorter);
    }
    return true;
  }

  /// Decodes a part of a chunk that is too large to be decoded at once.
  void decodePart()
  {
    const std::uint64_t points = this->Laz.chunks()[this->NextChunk].Points;
    LazReader& reader = this->Readers.front();
    if (this->DoneOfChunk == 0)
    {
      reader.begin(this->file(), this->NextChunk);
    }
    const std::uint64_t count =
      std::min({ partOfChunk, this->manyPoints(), points - this->DoneOfChunk });
    this->start(this->Ahead.front(), count);
    this->finish(reader, this->Ahead.front(), count);
    this->DoneOfChunk += count;
    if (this->DoneOfChunk == points)
    {
      this->DoneOfChunk = 0;
      ++this->NextChunk;
    }
  }

  void start(Decoded& decoded, std::uint64_t records) const
  {
    decoded.Points.Columns.resize(this->Wanted.size());
    decoded.Points.resize(std::size_t(records));
    decoded.Records = records;
    decoded.Size = 0;
    decoded.InRegion = 0;
  }

  /// Takes the selected ones of records that are decoded.
  void take(std::size_t count, Decoded& decoded) const
  {
    this->select(count, decoded);
    this->write(decoded.Kept, decoded.Points, decoded.Size);
    decoded.Size += decoded.Kept.size();
  }

  /// Decodes the last records.
  void finish(LazReader& reader, Decoded& decoded, std::uint64_t records) const
  {
    this->readRecords(
      reader, records, decoded, [&](std::size_t count) { this->take(count, decoded); });
    decoded.Points.resize(decoded.Size);
  }

  /// Appends `count` points to another block.
  static void append(const PointBlock& from, std::size_t begin, std::size_t count, PointBlock& to)
  {
    const auto copy =
      [&](const std::vector<double>& values, std::vector<double>& more, std::size_t width)
    {
      const double* const first = values.data() + width * begin;
      more.insert(more.end(), first, first + width * count);
    };
    copy(from.XY, to.XY, 2);
    for (std::size_t i = 0; i < from.Columns.size(); ++i)
    {
      copy(from.Columns[i], to.Columns[i], 1);
    }
  }

  LazFile Laz;
  std::size_t AllChunks = 0;      ///< number of chunks of the file
  unsigned Needed = 0;            ///< attributes to decode
  std::vector<LazReader> Readers; ///< two of each thread
  std::vector<Decoded> Ahead;     ///< the points to serve, in order
  std::size_t AheadCount = 0;     ///< how many of these are in use
  std::size_t Served = 0;         ///< the first of them that is not all served
  std::size_t ServedOfChunk = 0;  ///< points of it that are served
  std::size_t NextChunk = 0;      ///< to decode
  std::uint64_t DoneOfChunk = 0;  ///< records of the next chunk that are decoded already
};

} // namespace

std::unique_ptr<FilePoints> openLazPoints(
  const std::string& path, const LasHeader& header, const PointOptions& options)
{
  return std::make_unique<LazPoints>(path, header, options);
}

} // namespace tipp
