// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippStoredRows_h
#define tippStoredRows_h

#include "Files/FileSystem.h"
#include "Files/InputFile.h"
#include "Files/OutputFile.h"
#include "Parallel/Poll.h"
#include "Partitioning/Spill.h"
#include "vtkTIPPIOModule.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace tipp
{

/// Rows of equal size in a temporary file: first they are appended, then read. The file is removed
/// with the object.
class VTKTIPPIO_EXPORT RowFile
{
public:
  /// Creates the file. Throws IOError, as all methods do.
  RowFile(const std::string& path, std::size_t rowBytes);

  void append(const void* row);
  /// Call it once, after the last row.
  void finish();

  std::int64_t count() const { return this->Count; }
  /// Reads `count` rows from number `first` on.
  void read(std::int64_t first, std::size_t count, void* to) const;

  /// Calls visit(number, row) for all rows in their order, and polls.
  template <typename Row, typename Visit>
  void forEach(const Visit& visit) const
  {
    constexpr std::int64_t most = 4096;
    std::vector<Row> rows(std::size_t(std::min(most, this->Count)));
    for (std::int64_t first = 0; first < this->Count; first += most)
    {
      const std::int64_t end = std::min(this->Count, first + most);
      this->read(first, std::size_t(end - first), rows.data());
      for (std::int64_t i = first; i < end; ++i)
      {
        visit(i, rows[std::size_t(i - first)]);
      }
      poll();
    }
  }

private:
  void flush();

  const RemovedFile File;
  const std::size_t RowBytes;
  std::unique_ptr<OutputFile> Out; ///< until finish()
  std::unique_ptr<InputFile> In;   ///< after it
  std::vector<char> Buffer;
  std::int64_t Count = 0;
  std::uint64_t Written = 0;
};

/// Rows of equal size with a key each, in a temporary file: first they are added, then read by key,
/// in the order in which they were added. The file is removed with the object.
class VTKTIPPIO_EXPORT KeyedRows
{
public:
  /// Creates the file. Throws IOError, as all methods do.
  KeyedRows(const std::string& path, std::size_t keys, std::size_t rowBytes);

  void add(std::size_t key, const void* row);
  /// Call it once, after the last row.
  void finish();

  std::size_t keys() const { return this->Rows.content().Counts.size(); }
  std::int64_t count(std::size_t key) const { return this->Rows.rows(key); }

  /// Calls visit(row) with the bytes of each of the key's rows, and polls.
  template <typename Visit>
  void forEach(std::size_t key, const Visit& visit) const
  {
    constexpr std::size_t most = 4096;
    this->Rows.read(key, most,
      [&](const char* rows, std::size_t count)
      {
        for (std::size_t i = 0; i < count; ++i)
        {
          visit(rows + i * this->Rows.rowBytes());
        }
        poll();
      });
  }

  /// All rows of a key.
  template <typename Row>
  std::vector<Row> readAll(std::size_t key) const
  {
    std::vector<Row> rows(std::size_t(this->count(key)));
    this->Rows.readAll(key, rows.data());
    return rows;
  }

private:
  void flush();

  const RemovedFile File;
  Spill Rows;
  std::vector<std::uint32_t> BufferedKeys;
  std::vector<char> Buffer;
};

} // namespace tipp

#endif
