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

/// A stretch of tuples of several arrays in memory, to be put together row by row.
class Columns
{
public:
  /// Throws IOError if a file cannot be opened.
  explicit Columns(std::vector<RawArray> arrays);

  /// Of a row: a tuple of each array.
  std::size_t rowBytes() const { return this->RowBytes; }

  /// Throws IOError.
  void read(std::int64_t first, std::int64_t count, int threads);

  /// The tuples at a place in the stretch, one array after the other.
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
