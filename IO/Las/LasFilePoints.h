// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippLasFilePoints_h
#define tippLasFilePoints_h

#include "Files/InputFile.h"
#include "Las/LasColumns.h"
#include "Las/LasHeader.h"
#include "Las/LasIndex.h"
#include "Las/RecordFilter.h"
#include "Points/ReadPoints.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tipp
{

/// The common part of reading LAS and LAZ files, whose records come in chunks.
class LasFilePoints : public FilePoints
{
public:
  LasFilePoints(const std::string& path, const LasHeader& header, const PointOptions& options);

  void rewind() override;

  std::int64_t divisible() const override;

  void skip(std::int64_t points) override;

  std::vector<std::string> columns() const override;

  std::int64_t most() const override { return this->Records; }
  std::int64_t leftOut() const override;
  ReadFigures readFigures() const override;
  ReferenceSystem referenceSystem() const override;
  std::vector<TableReport> reports() const override;

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
  std::optional<std::vector<RecordRange>> indexedRecords();

  const InputFile& file();

  /// Makes room for records, and returns it.
  char* roomFor(std::size_t count, Share& share) const;

  /// Finds the selected ones of a share's records.
  void select(std::size_t count, Share& share) const;

  /// Writes the columns of records to a block, from its point `to` on.
  void write(const std::vector<const char*>& records, PointBlock& block, std::size_t to) const;

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
  void countKept() const;
  template <typename IsInRegion>
  void select(std::size_t count, Share& share, const IsInRegion& isInRegion) const;
  double coordinate(const char* record, std::size_t axis) const;
  /// The scan angle in units of 0.006 degrees, from such a number or one of whole degrees.
  double angleOf(const char* at) const;

  std::unique_ptr<InputFile> File;
  /// The number of points selected before each chunk of records, and in total.
  mutable std::vector<std::int64_t> KeptBefore;
  mutable std::int64_t InRegion = 0; ///< records in the region, once these are counted
};

/// The points of a LAZ file, some chunks of which are decoded ahead of the stream.
std::unique_ptr<FilePoints> openLazPoints(
  const std::string& path, const LasHeader& header, const PointOptions& options);

} // namespace tipp

#endif
