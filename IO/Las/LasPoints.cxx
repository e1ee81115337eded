// SPDX-License-Identifier: BSD-3-Clause
#include "Points/ReadPoints.h"

#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Files/RawValues.h"
#include "Las/CopcHierarchy.h"
#include "Las/LasHeader.h"
#include "Las/LasIndex.h"
#include "Las/LazFile.h"
#include "Parallel/ParallelFor.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstring>
#include <initializer_list>
#include <memory>
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

  /// The attributes of compressed points that decide.
  unsigned attributes() const
  {
    const bool isAnyClass =
      std::count(this->IsClassKept.begin(), this->IsClassKept.end(), false) == 0;
    return (isAnyClass ? 0 : laz::Class) | (this->LeftOut == 0 ? 0 : laz::Flags);
  }

  /// The class as formats 6 to 10 have it: overlap is a flag there, and the class is unknown.
  unsigned writtenClassOf(const char* record) const
  {
    constexpr unsigned unclassified = 1;
    return this->isOverlapClass(record) ? unclassified : this->classOf(record);
  }

  unsigned writtenFlagsOf(const char* record) const
  {
    const unsigned flags = valueAt<std::uint8_t>(record + 15);
    if (this->Extended)
    {
      return flags;
    }
    const unsigned ofClass = this->ClassMask == 31 ? flags >> 5 : 0;
    const unsigned ofScan = valueAt<std::uint8_t>(record + 14) & 0xC0U;
    return ofClass | (this->isOverlapClass(record) ? 8U : 0U) | ofScan;
  }

  unsigned returnsOf(const char* record) const
  {
    const unsigned returns = valueAt<std::uint8_t>(record + 14);
    return this->Extended ? returns : (returns & 7U) | (((returns >> 3) & 7U) << 4);
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
  static constexpr unsigned overlapClass = 12; ///< of formats 0 to 5

  bool isOverlapClass(const char* record) const
  {
    return !this->Extended && this->classOf(record) == overlapClass;
  }

  bool keepsReturn(const char* record) const
  {
    const unsigned returns = this->returnsOf(record);
    const unsigned number = returns & 15U;
    const unsigned count = returns >> 4;
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
    Time,
    // As formats 6 to 10 have them:
    WrittenClass,
    Returns, ///< 4 bits each: the number, and how many there are
    Flags,   ///< 8 bits: of the class, the scanner channel, direction and edge
    Angle,   ///< in units of 0.006 degrees
    Bytes,   ///< a whole number of up to 4 bytes
    Zero     ///< the file has no such field
  };
  std::string Name;
  Kind Is;
  std::size_t Offset;
  unsigned Attribute; ///< of compressed points
  std::size_t Size = 1;
};

/// The columns for writing: see LasFields.
std::vector<LasColumn> columnsToWrite(const LasHeader& header, const LasFields& fields)
{
  using Kind = LasColumn::Kind;
  const bool isExtended = header.isExtended();
  const auto named = [](const char* name) { return std::string(LasFields::Prefix) + name; };
  std::vector<LasColumn> columns = { { "z", Kind::Height, 8, laz::Z },
    { "intensity", Kind::Short, 12, laz::Intensity },
    { "classification", Kind::WrittenClass, 0, laz::Class },
    { named("returns"), Kind::Returns, 14, 0 },
    { named("flags"), Kind::Flags, 15, laz::Flags | laz::Class },
    { named("user data"), Kind::Bytes, 17, laz::UserData },
    { named("angle"), Kind::Angle, isExtended ? 18U : 16U, laz::Angle },
    { named("source"), Kind::Bytes, isExtended ? 20U : 18U, laz::Source, 2 } };
  const std::size_t time = isExtended ? 22 : 20;
  const std::size_t colour = time + (header.hasTime() ? 8 : 0);
  columns.push_back({ "gps_time", header.hasTime() ? Kind::Time : Kind::Zero, time, laz::Time });
  const auto addShorts =
    [&](bool isThere, std::size_t at, unsigned attribute, std::initializer_list<const char*> names)
  {
    for (const char* const name : names)
    {
      columns.push_back({ name, isThere ? Kind::Short : Kind::Zero, at, attribute });
      at += 2;
    }
  };
  if (fields.HasColour)
  {
    addShorts(header.hasColour(), colour, laz::Colour, { "red", "green", "blue" });
  }
  if (fields.HasInfrared)
  {
    addShorts(header.hasInfrared(), colour + 6, laz::Infrared, { "nir" });
  }
  std::vector<LasExtra> extras = header.Extras;
  for (std::size_t i = 0; i < fields.Extras.size(); ++i)
  {
    const auto extra = std::find_if(extras.begin(), extras.end(),
      [&](const LasExtra& own) { return own.Size > 0 && own.key() == fields.Extras[i]; });
    if (extra == extras.end())
    {
      throw IOError("The extra bytes of a LAS file have been changed meanwhile; start again.");
    }
    for (std::size_t done = 0; done < extra->Size; done += 4)
    {
      columns.push_back(
        { named(("extra " + std::to_string(i) + "." + std::to_string(done)).c_str()), Kind::Bytes,
          extra->Offset + done, laz::Extra, std::min<std::size_t>(4, extra->Size - done) });
    }
    extra->Size = 0; // another one may have the same name
  }
  return columns;
}

std::vector<LasColumn> columnsOf(const LasHeader& header, const PointOptions& options)
{
  using Kind = LasColumn::Kind;
  if (options.Fields)
  {
    return columnsToWrite(header, *options.Fields);
  }
  std::vector<LasColumn> columns = { { "z", Kind::Height, 8, laz::Z },
    { "intensity", Kind::Short, 12, laz::Intensity },
    { "classification", Kind::Class, 0, laz::Class } };
  const std::size_t afterBasics = header.isExtended() ? 22 : 20;
  if (header.hasTime())
  {
    columns.push_back({ "gps_time", Kind::Time, afterBasics, laz::Time });
  }
  const std::size_t colour = afterBasics + (header.hasTime() ? 8 : 0);
  if (header.hasColour())
  {
    columns.push_back({ "red", Kind::Short, colour, laz::Colour });
    columns.push_back({ "green", Kind::Short, colour + 2, laz::Colour });
    columns.push_back({ "blue", Kind::Short, colour + 4, laz::Colour });
  }
  if (header.hasInfrared())
  {
    columns.push_back({ "nir", Kind::Short, colour + 6, laz::Infrared });
  }
  return columns;
}

/// What files that are compressed or not have in common. Their records come in chunks.
class LasFilePoints : public FilePoints
{
public:
  LasFilePoints(const std::string& path, const LasHeader& header, const PointOptions& options)
    : Path(path)
    , Header(header)
    , Filter(header, options.Las)
    , Region(options.Region)
    , Threads(threadCount(options.Threads))
    , Records(header.Points)
  {
    for (const LasColumn& column : columnsOf(header, options))
    {
      if (options.wants(column.Name))
      {
        this->Wanted.push_back(column);
      }
    }
  }

  void rewind() override
  {
    this->File.reset(); // reopened when needed: there may be many files
    this->Dropped = 0;
    this->seek(0);
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
    this->seek(chunk);
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

  std::int64_t most() const override { return this->Records; }
  std::int64_t leftOut() const override
  {
    // A pass may be limited to a part of the file.
    return this->KeptBefore.empty() ? this->DroppedOfPass
                                    : this->InRegion - this->KeptBefore.back();
  }
  ReadFigures readFigures() const override
  {
    ReadFigures figures;
    figures.Files = 1;
    figures.Points = this->Header.Points;
    figures.SkippedPoints = this->Header.Points - this->Records;
    return figures;
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
    for (const std::string& remark : { this->Header.Remark, this->IndexRemark })
    {
      if (!remark.empty())
      {
        reports.emplace_back().Path = this->Path;
        reports.back().Warnings.push_back(remark + ".");
      }
    }
    return reports;
  }

protected:
  /// Records on their way to a block.
  struct Share
  {
    std::vector<char> Raw;
    std::vector<const char*> Kept; ///< the selected records among these
    std::int64_t InRegion = 0;     ///< records so far that lie in the region, selected or not
  };

  /// Numbers of records of a chunk.
  struct Counts
  {
    std::int64_t InRegion = 0;
    std::int64_t Kept = 0; ///< the selected ones of these
  };

  /// Goes to the first record of a chunk, or behind the last chunk.
  virtual void seek(std::int64_t chunk) = 0;
  virtual std::vector<Counts> countChunks() const = 0;

  /// Returns the records that may lie in the region by an index; nullopt: all.
  std::optional<std::vector<RecordRange>> indexedRecords()
  {
    if (!this->Region)
    {
      return std::nullopt;
    }
    IndexedRecords found = findIndexedRecords(this->Path, this->Header, *this->Region);
    this->IndexRemark = found.Remark;
    return std::move(found.Ranges);
  }

  const InputFile& file()
  {
    if (!this->File)
    {
      this->File = std::make_unique<InputFile>(this->Path);
    }
    return *this->File;
  }

  /// Makes room for records, and returns it.
  char* roomFor(std::size_t count, Share& share) const
  {
    share.Raw.resize(count * this->Header.RecordLength);
    return share.Raw.data();
  }

  /// Finds the selected ones of a share's records.
  void select(std::size_t count, Share& share) const
  {
    if (this->Region)
    {
      this->select(count, share,
        [this](const char* record)
        {
          return this->Region->contains(
            Point2{ this->coordinate(record, 0), this->coordinate(record, 1) });
        });
    }
    else
    {
      this->select(count, share, [](const char*) { return true; });
    }
  }

  template <typename IsInRegion>
  void select(std::size_t count, Share& share, const IsInRegion& isInRegion) const
  {
    const std::size_t length = this->Header.RecordLength;
    share.Kept.clear();
    std::int64_t inRegion = 0;
    for (const char* record = share.Raw.data(); count > 0; record += length, --count)
    {
      if (isInRegion(record))
      {
        ++inRegion;
        if (this->Filter.keeps(record))
        {
          share.Kept.push_back(record);
        }
      }
    }
    share.InRegion += inRegion;
  }

  double coordinate(const char* record, std::size_t axis) const
  {
    return valueAt<std::int32_t>(record + 4 * axis) * this->Header.Scale[axis] +
      this->Header.Offset[axis];
  }

  /// The scan angle in units of 0.006 degrees, from such a number or one of whole degrees.
  double angleOf(const char* at) const
  {
    constexpr double unitsOfDegree = 500.0 / 3;
    return this->Header.isExtended()
      ? double(valueAt<std::int16_t>(at))
      : std::nearbyint(double(valueAt<std::int8_t>(at)) * unitsOfDegree);
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
        case LasColumn::Kind::WrittenClass:
          fill([this](const char* record) { return double(this->Filter.writtenClassOf(record)); });
          break;
        case LasColumn::Kind::Returns:
          fill([this](const char* record) { return double(this->Filter.returnsOf(record)); });
          break;
        case LasColumn::Kind::Flags:
          fill([this](const char* record) { return double(this->Filter.writtenFlagsOf(record)); });
          break;
        case LasColumn::Kind::Angle:
          fill([&](const char* record) { return this->angleOf(record + column.Offset); });
          break;
        case LasColumn::Kind::Bytes:
          fill(
            [&](const char* record)
            {
              std::uint32_t number = 0;
              std::memcpy(&number, record + column.Offset, column.Size);
              return double(number);
            });
          break;
        case LasColumn::Kind::Zero:
          std::fill_n(values, records.size(), 0.0);
          break;
      }
    }
  }

  const std::string Path;
  LasHeader Header;
  const RecordFilter Filter;
  const std::optional<Box2> Region;
  const int Threads;
  std::int64_t Records;    ///< number of records to decode
  std::string IndexRemark; ///< see IndexedRecords
  std::vector<LasColumn> Wanted;
  std::int64_t Dropped = 0; ///< points dropped so far in this pass
  std::int64_t DroppedOfPass = 0;

private:
  void countKept() const
  {
    if (!this->KeptBefore.empty())
    {
      return;
    }
    std::vector<std::int64_t> before{ 0 };
    for (const Counts& counts : this->countChunks())
    {
      before.push_back(before.back() + counts.Kept);
      this->InRegion += counts.InRegion;
    }
    this->KeptBefore = std::move(before);
  }

  std::unique_ptr<InputFile> File;
  /// The number of points selected before each chunk of records, and in total.
  mutable std::vector<std::int64_t> KeptBefore;
  mutable std::int64_t InRegion = 0; ///< records in the region, once these are counted
};

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

/// The points of a compressed file. Some chunks ahead of the stream are decoded at the same time.
class LazPoints : public LasFilePoints
{
public:
  LazPoints(const std::string& path, const LasHeader& header, const PointOptions& options)
    : LasFilePoints(path, header, options)
    , Laz(path, header)
    , Needed(this->Filter.attributes())
  {
    this->Header.Remark = this->Laz.remark();
    for (const LasColumn& column : this->Wanted)
    {
      this->Needed |= column.Attribute;
    }
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
  unsigned Needed;                ///< attributes to decode
  std::vector<LazReader> Readers; ///< two of each thread
  std::vector<Decoded> Ahead;     ///< the points to serve, in order
  std::size_t AheadCount = 0;     ///< how many of these are in use
  std::size_t Served = 0;         ///< the first of them that is not all served
  std::size_t ServedOfChunk = 0;  ///< points of it that are served
  std::size_t NextChunk = 0;      ///< to decode
  std::uint64_t DoneOfChunk = 0;  ///< records of the next chunk that are decoded already
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
    return std::make_unique<LazPoints>(path, header, options);
  }
  return std::make_unique<PlainLasPoints>(path, header, options);
}

} // namespace tipp
