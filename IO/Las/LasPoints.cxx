// SPDX-License-Identifier: BSD-3-Clause
#include "Points/ReadPoints.h"

#include "Files/IOError.h"
#include "Las/LasHeader.h"
#include "Parallel/ParallelFor.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <vector>

namespace tipp
{
namespace
{

/// Decides which records are selected.
class RecordFilter
{
public:
  RecordFilter(const LasHeader& header, const LasSelection& selection)
    : Extended(header.isExtended())
    , Kind(selection.Kind)
  {
    this->IsClassKept.fill(selection.Classes.empty());
    for (const int number : selection.Classes)
    {
      this->IsClassKept[std::size_t(number)] = true;
    }
    constexpr std::size_t overlapClass = 12;
    const bool asksForOverlap =
      std::count(selection.Classes.begin(), selection.Classes.end(), int(overlapClass)) > 0;
    if (!this->Extended && !selection.KeepOverlap && !asksForOverlap)
    {
      this->IsClassKept[overlapClass] = false;
    }
    // Version 1.0 has no flags: the whole byte is the class.
    this->ClassMask = this->Extended || header.Minor == 0 ? 255 : 31;
    const unsigned synthetic = this->Extended ? 1 : 32;
    const unsigned withheld = this->Extended ? 4 : 128;
    const unsigned overlap = this->Extended ? 8 : 0;
    this->LeftOut = header.Minor == 0 ? 0
                                      : (selection.KeepSynthetic ? 0 : synthetic) |
        (selection.KeepWithheld ? 0 : withheld) | (selection.KeepOverlap ? 0 : overlap);
  }

  unsigned classOf(const char* record) const
  {
    return valueAt<std::uint8_t>(record + (this->Extended ? 16 : 15)) & this->ClassMask;
  }

  bool keeps(const char* record) const
  {
    return this->IsClassKept[this->classOf(record)] &&
      (valueAt<std::uint8_t>(record + 15) & this->LeftOut) == 0 && this->keepsReturn(record);
  }

private:
  bool keepsReturn(const char* record) const
  {
    const unsigned byte = valueAt<std::uint8_t>(record + 14);
    const unsigned number = this->Extended ? byte & 15U : byte & 7U;
    const unsigned count = this->Extended ? byte >> 4 : (byte >> 3) & 7U;
    return this->Kind == LasSelection::Returns::All ||
      (this->Kind == LasSelection::Returns::First ? number <= 1 : number >= count);
  }

  bool Extended;
  LasSelection::Returns Kind;
  std::array<bool, 256> IsClassKept{};
  unsigned ClassMask;
  unsigned LeftOut;
};

/// A column besides x and y.
struct LasColumn
{
  enum class Kind
  {
    Height,
    Class,
    Short, ///< 16 bits
    Time
  };
  const char* Name;
  Kind Is;
  std::size_t Offset;
};

std::vector<LasColumn> columnsOf(const LasHeader& header)
{
  using Kind = LasColumn::Kind;
  std::vector<LasColumn> columns = { { "z", Kind::Height, 8 }, { "intensity", Kind::Short, 12 },
    { "classification", Kind::Class, 0 } };
  const std::size_t afterBasics = header.isExtended() ? 22 : 20;
  if (header.hasTime())
  {
    columns.push_back({ "gps_time", Kind::Time, afterBasics });
  }
  const std::size_t colour = afterBasics + (header.hasTime() ? 8 : 0);
  if (header.hasColour())
  {
    columns.push_back({ "red", Kind::Short, colour });
    columns.push_back({ "green", Kind::Short, colour + 2 });
    columns.push_back({ "blue", Kind::Short, colour + 4 });
  }
  if (header.hasInfrared())
  {
    columns.push_back({ "nir", Kind::Short, colour + 6 });
  }
  return columns;
}

class LasFilePoints : public FilePoints
{
public:
  LasFilePoints(const std::string& path, const PointOptions& options)
    : Path(path)
    , Header(readLasHeader(path, options.Las))
    , Filter(this->Header, options.Las)
    , Threads(threadCount(options.Threads))
  {
    openLasRecords(path, this->Header); // to report errors early
    if (this->Header.Compressed && options.Las.KeepTruncated)
    {
      this->keepReadable();
    }
    for (const LasColumn& column : columnsOf(this->Header))
    {
      if (options.wants(column.Name))
      {
        this->Wanted.push_back(column);
      }
    }
  }

  bool next(PointBlock& block, std::size_t most) override
  {
    block.Columns.resize(this->Wanted.size());
    std::size_t points = 0;
    while (points <= most / 2 && this->NextRecord < this->Header.Points)
    {
      points = this->append(block, points, most - points);
    }
    if (this->NextRecord == this->Header.Points)
    {
      this->DroppedOfPass = this->Dropped;
    }
    return points > 0;
  }

  void rewind() override
  {
    this->Records.reset(); // reopened when needed: there may be many files
    std::vector<Share>().swap(this->Shares);
    this->Dropped = 0;
    this->NextRecord = 0;
  }

  std::int64_t divisible() const override
  {
    this->countKept();
    return this->KeptBefore.back();
  }

  void skip(std::int64_t points) override
  {
    this->countKept();
    const auto after = std::upper_bound(this->KeptBefore.begin(), this->KeptBefore.end(), points);
    const std::int64_t chunk = after - this->KeptBefore.begin() - 1;
    this->NextRecord = std::min(chunk * chunkRecords, this->Header.Points);
    auto left = std::size_t(points - this->KeptBefore[std::size_t(chunk)]);
    for (PointBlock block; left > 0 && this->next(block, left);)
    {
      left -= block.size();
    }
  }

  std::vector<std::string> columns() const override
  {
    std::vector<std::string> names;
    for (const LasColumn& column : this->Wanted)
    {
      names.emplace_back(column.Name);
    }
    return names;
  }

  std::int64_t most() const override { return this->Header.Points; }
  std::int64_t leftOut() const override
  {
    // A pass may be limited to a part of the file.
    return this->KeptBefore.empty() ? this->DroppedOfPass
                                    : this->Header.Points - this->KeptBefore.back();
  }
  ReferenceSystem referenceSystem() const override
  {
    ReferenceSystem system = understandCrs(this->Header.Crs);
    if (!system.Problem.empty())
    {
      system.Problem = IOError(this->Path, system.Problem).what();
    }
    return system;
  }
  std::vector<TableReport> reports() const override
  {
    std::vector<TableReport> reports;
    if (!this->Header.Remark.empty())
    {
      reports.emplace_back().Path = this->Path;
      reports.back().Warnings.push_back(this->Header.Remark + ".");
    }
    return reports;
  }

private:
  static constexpr std::int64_t chunkRecords = 1 << 14;

  /// Limits the points of a compressed file to those that can be decompressed.
  void keepReadable()
  {
    const auto records = openLasRecords(this->Path, this->Header);
    std::vector<char> record(this->Header.RecordLength);
    std::int64_t readable = 0;
    try
    {
      for (; readable < this->Header.Points; ++readable)
      {
        records->read(readable, 1, record.data());
      }
    }
    catch (const IOError&)
    {
      this->Header.Remark = "announces " + std::to_string(this->Header.Points) +
        " points and can be decompressed up to point " + std::to_string(readable) +
        "; those before it are read";
      this->Header.Points = readable;
    }
  }

  /// Records that one thread decodes.
  struct Share
  {
    std::int64_t First = 0;
    std::int64_t Count = 0;
    std::size_t To = 0;            ///< index of its first point in the block
    std::size_t Points = 0;        ///< number of selected points
    std::vector<char> Raw;         ///< a part of the records
    std::vector<const char*> Kept; ///< the selected records among these
  };

  /// Appends the selected of the next `most` records to the block; returns the number of points it
  /// then has.
  std::size_t append(PointBlock& block, std::size_t points, std::size_t most)
  {
    const std::int64_t count =
      std::min<std::int64_t>(std::int64_t(most), this->Header.Points - this->NextRecord);
    // LAZ records are decompressed sequentially.
    const std::int64_t shares = this->Header.Compressed
      ? 1
      : std::clamp<std::int64_t>(count / chunkRecords, 1, this->Threads);
    block.resize(points + std::size_t(count));
    this->Shares.resize(std::size_t(shares));
    if (!this->Records)
    {
      this->Records = openLasRecords(this->Path, this->Header);
    }
    parallelFor(shares, int(shares),
      [&](std::int64_t i)
      {
        Share& share = this->Shares[std::size_t(i)];
        const std::int64_t begin = count * i / shares;
        share.First = this->NextRecord + begin;
        share.Count = count * (i + 1) / shares - begin;
        share.To = points + std::size_t(begin);
        this->decode(share, block);
      });
    for (const Share& share : this->Shares)
    {
      move(block, share.To, points, share.Points);
      points += share.Points;
      this->Dropped += share.Count - std::int64_t(share.Points);
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

  /// Writes the selected points of a share to their positions in the block.
  void decode(Share& share, PointBlock& block) const
  {
    share.Points = 0;
    for (std::int64_t done = 0; done < share.Count; done += chunkRecords)
    {
      const auto count = std::size_t(std::min(chunkRecords, share.Count - done));
      this->select(*this->Records, share.First + done, count, share);
      this->write(share.Kept, block, share.To + share.Points);
      share.Points += share.Kept.size();
    }
  }

  /// Reads records, and finds the selected ones.
  void select(LasRecords& records, std::int64_t first, std::size_t count, Share& share) const
  {
    const std::size_t length = this->Header.RecordLength;
    share.Raw.resize(count * length);
    records.read(first, count, share.Raw.data());
    share.Kept.clear();
    for (const char* record = share.Raw.data(); count > 0; record += length, --count)
    {
      if (this->Filter.keeps(record))
      {
        share.Kept.push_back(record);
      }
    }
  }

  double coordinate(const char* record, std::size_t axis) const
  {
    return valueAt<std::int32_t>(record + 4 * axis) * this->Header.Scale[axis] +
      this->Header.Offset[axis];
  }

  void write(const std::vector<const char*>& records, PointBlock& block, std::size_t to) const
  {
    double* xy = block.XY.data() + 2 * to;
    for (const char* const record : records)
    {
      *xy++ = this->coordinate(record, 0);
      *xy++ = this->coordinate(record, 1);
    }
    for (std::size_t i = 0; i < this->Wanted.size(); ++i)
    {
      const LasColumn& column = this->Wanted[i];
      double* const values = block.Columns[i].data() + to;
      const auto fill = [&](const auto& valueOf)
      { std::transform(records.begin(), records.end(), values, valueOf); };
      switch (column.Is)
      {
        case LasColumn::Kind::Height:
          fill([this](const char* record) { return this->coordinate(record, 2); });
          break;
        case LasColumn::Kind::Class:
          fill([this](const char* record) { return double(this->Filter.classOf(record)); });
          break;
        case LasColumn::Kind::Time:
          fill([&](const char* record) { return valueAt<double>(record + column.Offset); });
          break;
        case LasColumn::Kind::Short:
          fill([&](const char* record)
            { return double(valueAt<std::uint16_t>(record + column.Offset)); });
          break;
      }
    }
  }

  /// The number of points selected before each chunk of records, and in total.
  void countKept() const
  {
    if (!this->KeptBefore.empty())
    {
      return;
    }
    const auto records = openLasRecords(this->Path, this->Header);
    std::vector<std::int64_t> before{ 0 };
    Share share;
    for (std::int64_t first = 0; first < this->Header.Points; first += chunkRecords)
    {
      const auto count = std::size_t(std::min(chunkRecords, this->Header.Points - first));
      this->select(*records, first, count, share);
      before.push_back(before.back() + std::int64_t(share.Kept.size()));
    }
    this->KeptBefore = std::move(before);
  }

  const std::string Path;
  LasHeader Header;
  const RecordFilter Filter;
  const int Threads;
  std::vector<LasColumn> Wanted;
  std::unique_ptr<LasRecords> Records;
  std::vector<Share> Shares;
  std::int64_t NextRecord = 0;
  std::int64_t Dropped = 0; ///< points dropped so far in this pass
  std::int64_t DroppedOfPass = 0;
  mutable std::vector<std::int64_t> KeptBefore;
};

} // namespace

std::unique_ptr<FilePoints> openLasPoints(const std::string& path, const PointOptions& options)
{
  return std::make_unique<LasFilePoints>(path, options);
}

} // namespace tipp
