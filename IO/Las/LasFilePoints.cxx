// SPDX-License-Identifier: BSD-3-Clause
#include "Las/LasFilePoints.h"

#include "Files/IOError.h"
#include "Files/RawValues.h"
#include "Parallel/ParallelFor.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

namespace tipp
{

LasFilePoints::LasFilePoints(
  const std::string& path, const LasHeader& header, const PointOptions& options)
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

void LasFilePoints::rewind()
{
  this->File.reset(); // reopened when needed: there may be many files
  this->Dropped = 0;
  this->seek(0);
}

std::int64_t LasFilePoints::divisible() const
{
  this->countKept();
  return this->KeptBefore.back();
}

void LasFilePoints::skip(std::int64_t points)
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

std::vector<std::string> LasFilePoints::columns() const
{
  std::vector<std::string> names;
  for (const LasColumn& column : this->Wanted)
  {
    names.emplace_back(column.Name);
  }
  return names;
}

std::int64_t LasFilePoints::leftOut() const
{
  // A pass may be limited to a part of the file.
  return this->KeptBefore.empty() ? this->DroppedOfPass : this->InRegion - this->KeptBefore.back();
}

ReadFigures LasFilePoints::readFigures() const
{
  ReadFigures figures;
  figures.Files = 1;
  figures.Points = this->Header.Points;
  figures.SkippedPoints = this->Header.Points - this->Records;
  figures.Bounds = this->Header.Bounds;
  return figures;
}

ReferenceSystem LasFilePoints::referenceSystem() const
{
  ReferenceSystem system = understandCrs(this->Header.Crs);
  if (!system.Problem.empty())
  {
    system.Problem = IOError(this->Path, system.Problem).what();
  }
  return system;
}

std::vector<TableReport> LasFilePoints::reports() const
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

std::optional<std::vector<RecordRange>> LasFilePoints::indexedRecords()
{
  if (!this->Region)
  {
    return std::nullopt;
  }
  IndexedRecords found = findIndexedRecords(this->Path, this->Header, *this->Region);
  this->IndexRemark = found.Remark;
  return std::move(found.Ranges);
}

const InputFile& LasFilePoints::file()
{
  if (!this->File)
  {
    this->File = std::make_unique<InputFile>(this->Path);
  }
  return *this->File;
}

char* LasFilePoints::roomFor(std::size_t count, Share& share) const
{
  share.Raw.resize(count * this->Header.RecordLength);
  return share.Raw.data();
}

double LasFilePoints::coordinate(const char* record, std::size_t axis) const
{
  return valueAt<std::int32_t>(record + 4 * axis) * this->Header.Scale[axis] +
    this->Header.Offset[axis];
}

template <typename IsInRegion>
void LasFilePoints::select(std::size_t count, Share& share, const IsInRegion& isInRegion) const
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

void LasFilePoints::select(std::size_t count, Share& share) const
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

double LasFilePoints::angleOf(const char* at) const
{
  constexpr double unitsOfDegree = 500.0 / 3;
  return this->Header.isExtended()
    ? double(valueAt<std::int16_t>(at))
    : std::nearbyint(double(valueAt<std::int8_t>(at)) * unitsOfDegree);
}

void LasFilePoints::write(
  const std::vector<const char*>& records, PointBlock& block, std::size_t to) const
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

void LasFilePoints::countKept() const
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

} // namespace tipp
