// SPDX-License-Identifier: BSD-3-Clause
#include "Las/LasFilePoints.h"

#include "Parallel/ParallelFor.h"

#include <algorithm>
#include <cstring>

namespace tipp
{
namespace
{

/// The points of a file that has none in the region.
class SkippedPoints : public LasFilePoints
{
public:
  SkippedPoints(const std::string& path, const LasHeader& header, const PointOptions& options)
    : LasFilePoints(path, header, options)
  {
    this->Records = 0;
  }

  bool next(PointBlock& block, std::size_t) override
  {
    block.Columns.resize(this->Wanted.size());
    block.resize(0);
    return false;
  }

  ReadFigures readFigures() const override
  {
    ReadFigures figures = LasFilePoints::readFigures();
    figures.SkippedFiles = 1;
    return figures;
  }

protected:
  void seek(std::int64_t) override {}
  std::vector<Counts> countChunks() const override { return {}; }
};

/// The points of a file that is not compressed, decoded straight to the block.
class PlainLasPoints : public LasFilePoints
{
public:
  PlainLasPoints(const std::string& path, const LasHeader& header, const PointOptions& options)
    : LasFilePoints(path, header, options)
  {
    if (const auto ranges = this->indexedRecords())
    {
      this->keepChunks(*ranges);
    }
  }

  bool next(PointBlock& block, std::size_t most) override
  {
    block.Columns.resize(this->Wanted.size());
    block.resize(0);
    std::size_t points = 0;
    while (points <= most / 2 && this->NextRecord < this->Records)
    {
      points = this->append(block, points, most - points);
    }
    if (this->NextRecord == this->Records)
    {
      this->DroppedOfPass = this->Dropped;
    }
    return points > 0;
  }

protected:
  void seek(std::int64_t chunk) override
  {
    std::vector<Part>().swap(this->Parts);
    this->NextRecord = std::min(chunk * chunkRecords, this->Records);
  }

  std::vector<Counts> countChunks() const override
  {
    const InputFile file(this->Path);
    std::vector<Counts> counts;
    for (std::int64_t first = 0; first < this->Records; first += chunkRecords)
    {
      Share share;
      this->select(file, first, std::size_t(std::min(chunkRecords, this->Records - first)), share);
      counts.push_back({ share.InRegion, std::int64_t(share.Kept.size()) });
    }
    return counts;
  }

private:
  static constexpr std::int64_t chunkRecords = 1 << 14;

  /// Limits the records to the chunks that have some of the ranges.
  void keepChunks(const std::vector<RecordRange>& ranges)
  {
    this->Chunks.emplace();
    this->Records = 0;
    for (const RecordRange& range : ranges)
    {
      const auto end = (std::int64_t(range.End) + chunkRecords - 1) / chunkRecords;
      auto chunk = std::int64_t(range.Begin) / chunkRecords;
      chunk = this->Chunks->empty() ? chunk : std::max(chunk, this->Chunks->back() + 1);
      for (; chunk < end; ++chunk)
      {
        this->Chunks->push_back(chunk);
        this->Records += std::min(chunkRecords, this->Header.Points - chunk * chunkRecords);
      }
    }
  }

  /// Returns the index in the file of one of the records to decode. Only the last chunk is short.
  std::int64_t inFile(std::int64_t record) const
  {
    return this->Chunks
      ? (*this->Chunks)[std::size_t(record / chunkRecords)] * chunkRecords + record % chunkRecords
      : record;
  }

  /// Records that one thread decodes.
  struct Part : public Share
  {
    std::int64_t First = 0;
    std::int64_t Count = 0;
    std::size_t To = 0;     ///< index of its first point in the block
    std::size_t Points = 0; ///< number of selected points
  };

  /// Appends the selected of the next `most` records to the block; returns the number of points it
  /// then has.
  std::size_t append(PointBlock& block, std::size_t points, std::size_t most)
  {
    const std::int64_t count =
      std::min<std::int64_t>(std::int64_t(most), this->Records - this->NextRecord);
    const std::int64_t parts = std::clamp<std::int64_t>(count / chunkRecords, 1, this->Threads);
    block.resize(points + std::size_t(count));
    this->Parts.resize(std::size_t(parts));
    const InputFile& file = this->file();
    parallelFor(parts, int(parts),
      [&](std::int64_t i)
      {
        Part& part = this->Parts[std::size_t(i)];
        const std::int64_t begin = count * i / parts;
        part.First = this->NextRecord + begin;
        part.Count = count * (i + 1) / parts - begin;
        part.To = points + std::size_t(begin);
        this->decode(file, part, block);
      });
    for (const Part& part : this->Parts)
    {
      move(block, part.To, points, part.Points);
      points += part.Points;
      this->Dropped += part.InRegion - std::int64_t(part.Points);
    }
    block.resize(points);
    this->NextRecord += count;
    return points;
  }

  /// Moves points within a block, towards its beginning.
  static void move(PointBlock& block, std::size_t from, std::size_t to, std::size_t count)
  {
    if (from == to || count == 0)
    {
      return;
    }
    std::memmove(&block.XY[2 * to], &block.XY[2 * from], 2 * count * sizeof(double));
    for (std::vector<double>& column : block.Columns)
    {
      std::memmove(&column[to], &column[from], count * sizeof(double));
    }
  }

  /// Writes the selected points of a part to their positions in the block.
  void decode(const InputFile& file, Part& part, PointBlock& block) const
  {
    part.Points = 0;
    part.InRegion = 0;
    for (std::int64_t first = part.First; first < part.First + part.Count;)
    {
      const std::int64_t ofChunk = chunkRecords - first % chunkRecords;
      const std::int64_t count = std::min(ofChunk, part.First + part.Count - first);
      this->select(file, first, std::size_t(count), part);
      this->write(part.Kept, block, part.To + part.Points);
      part.Points += part.Kept.size();
      first += count;
    }
  }

  /// Reads records of a chunk, and finds the selected ones.
  void select(const InputFile& file, std::int64_t first, std::size_t count, Share& share) const
  {
    const std::size_t length = this->Header.RecordLength;
    file.read(this->Header.PointOffset + std::uint64_t(this->inFile(first)) * length,
      this->roomFor(count, share), count * length);
    this->LasFilePoints::select(count, share);
  }

  std::vector<Part> Parts;
  std::int64_t NextRecord = 0;                     ///< counted among those to decode
  std::optional<std::vector<std::int64_t>> Chunks; ///< those to decode; nullopt: all
};

} // namespace

std::unique_ptr<FilePoints> openLasPoints(const std::string& path, const PointOptions& options)
{
  const LasHeader header = readLasHeader(path, options.Las);
  if (options.Spacing > 0 && header.Copc.empty())
  {
    refuseSpacing(path);
  }
  if (options.Region && !header.Bounds.isEmpty() && !header.Bounds.meets(*options.Region))
  {
    return std::make_unique<SkippedPoints>(path, header, options);
  }
  if (header.Compressed)
  {
    return openLazPoints(path, header, options);
  }
  return std::make_unique<PlainLasPoints>(path, header, options);
}

} // namespace tipp
