// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippColumns_h
#define tippColumns_h

#include "Files/InputFile.h"
#include "Flat/RawArray.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace tipp
{

/// A range of tuples of several arrays in memory, copied out row by row. A row is one tuple of each
/// array.
class Columns
{
public:
  /// Throws IOError if a file cannot be opened.
  explicit Columns(std::vector<RawArray> arrays);

  /// The size of a row in bytes.
  std::size_t rowBytes() const { return this->RowBytes; }

  /// Reads tuples [first, first + count) of each array. Throws IOError.
  void read(std::int64_t first, std::int64_t count, int threads);

  /// Copies the row at index `place` of the range to `to`; returns the end of the copy.
  char* copyRow(std::size_t place, char* to) const
  {
    for (std::size_t a = 0; a < this->Arrays.size(); ++a)
    {
      const std::size_t bytes = this->Bytes[a];
      std::memcpy(to, this->Values[a].data() + place * bytes, bytes);
      to += bytes;
    }
    return to;
  }

private:
  std::vector<RawArray> Arrays;
  std::vector<std::size_t> Bytes;
  std::size_t RowBytes = 0;
  std::map<std::string, std::unique_ptr<InputFile>> Files;
  std::vector<std::vector<char>> Values;
};

} // namespace tipp

#endif
