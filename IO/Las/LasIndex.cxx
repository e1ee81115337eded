// SPDX-License-Identifier: BSD-3-Clause
#include "Las/LasIndex.h"

#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Files/RawValues.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <stdexcept>

namespace tipp
{
namespace
{

/// Thrown if an index cannot be used. what() goes on after its name: "is damaged".
class IndexError : public std::runtime_error
{
  using std::runtime_error::runtime_error;
};

/// The bytes of an index, from first to last.
class IndexCursor
{
public:
  explicit IndexCursor(const std::vector<char>& bytes)
    : At(bytes.data())
    , End(bytes.data() + bytes.size())
  {
  }

  template <typename T>
  T take()
  {
    this->require(sizeof(T));
    const T value = valueAt<T>(this->At);
    this->At += sizeof(T);
    return value;
  }

  /// Skips a signature of four letters, and returns whether it was there.
  bool skip(const char* signature)
  {
    this->require(4);
    const bool isThere = std::memcmp(this->At, signature, 4) == 0;
    this->At += isThere ? 4 : 0;
    return isThere;
  }

  void require(std::uint64_t bytes) const
  {
    if (std::uint64_t(this->End - this->At) < bytes)
    {
      throw IndexError("ends too early");
    }
  }

private:
  const char* At;
  const char* const End;
};

/// The quadtree whose cells an index numbers, level by level from the root. Corners are in single
/// precision, as the points were compared with them.
class CellTree
{
public:
  explicit CellTree(IndexCursor& cursor)
  {
    if (!cursor.skip("LASS") || cursor.take<std::uint32_t>() != 0)
    {
      throw IndexError("has no quadtree");
    }
    if (cursor.skip("LASQ"))
    {
      cursor.take<std::uint32_t>(); // version
    }
    this->Levels = cursor.take<std::uint32_t>();
    const auto part = cursor.take<std::uint32_t>();
    cursor.take<std::uint32_t>(); // belongs to the part
    for (std::size_t axis = 0; axis < 2; ++axis)
    {
      this->Low[axis] = cursor.take<float>();
      this->High[axis] = cursor.take<float>();
    }
    const bool isGood = this->Low[0] < this->High[0] && this->Low[1] < this->High[1] &&
      std::isfinite(this->Low[0] + this->High[0] + this->Low[1] + this->High[1]);
    if (this->Levels > mostLevels || part != 0 || !isGood)
    {
      throw IndexError("has a quadtree that is not known here");
    }
  }

  /// Returns the box of the points of a cell.
  Box2 boxOf(std::uint32_t cell) const
  {
    std::uint32_t level = 0;
    std::uint64_t cells = 1; // of this level
    std::uint64_t index = cell;
    for (; index >= cells; cells *= 4)
    {
      index -= cells;
      if (++level > this->Levels)
      {
        throw IndexError("has a cell " + std::to_string(cell) + ", which its quadtree has not");
      }
    }
    // Points outside of the root are in the cells at its border.
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Box2 box = { { -infinity, -infinity }, { infinity, infinity } };
    for (std::size_t axis = 0; axis < 2; ++axis)
    {
      float low = this->Low[axis];
      float high = this->High[axis];
      for (std::uint32_t i = level; i-- > 0;)
      {
        const float middle = (low + high) / 2;
        const bool isUpper = (index >> (2 * i + axis) & 1) != 0;
        (isUpper ? low : high) = middle;
        (isUpper ? box.Min : box.Max)[axis] = middle;
      }
    }
    return box;
  }

private:
  static constexpr std::uint32_t mostLevels = 15; // so that numbers of cells have 32 bits

  std::uint32_t Levels = 0;
  std::array<float, 2> Low{};
  std::array<float, 2> High{};
};

/// Sorts ranges, and joins those that overlap or touch.
void joinRanges(std::vector<RecordRange>& ranges)
{
  std::sort(ranges.begin(), ranges.end(),
    [](const RecordRange& a, const RecordRange& b) { return a.Begin < b.Begin; });
  std::size_t last = 0;
  for (std::size_t i = 1; i < ranges.size(); ++i)
  {
    if (ranges[i].Begin <= ranges[last].End)
    {
      ranges[last].End = std::max(ranges[last].End, ranges[i].End);
    }
    else
    {
      ranges[++last] = ranges[i];
    }
  }
  ranges.resize(std::min(ranges.size(), last + 1));
}

/// Returns the ranges of the cells that meet the box. Throws IndexError.
std::vector<RecordRange> rangesIn(
  const std::vector<char>& bytes, std::uint64_t points, const Box2& box)
{
  IndexCursor cursor(bytes);
  if (!cursor.skip("LASX"))
  {
    throw IndexError("is no LASindex");
  }
  cursor.take<std::uint32_t>(); // version
  const CellTree tree(cursor);
  if (!cursor.skip("LASV"))
  {
    throw IndexError("has no ranges");
  }
  cursor.take<std::uint32_t>(); // version
  std::vector<RecordRange> all;
  std::vector<RecordRange> met;
  for (auto cells = cursor.take<std::uint32_t>(); cells > 0; --cells)
  {
    const bool isMet = tree.boxOf(cursor.take<std::uint32_t>()).meets(box);
    auto ranges = cursor.take<std::uint32_t>();
    cursor.take<std::uint32_t>(); // points in the cell
    cursor.require(std::uint64_t(ranges) * 8);
    for (; ranges > 0; --ranges)
    {
      const std::uint64_t first = cursor.take<std::uint32_t>();
      const std::uint64_t last = cursor.take<std::uint32_t>();
      if (last < first || last >= points)
      {
        throw IndexError("has points " + std::to_string(first) + " to " + std::to_string(last) +
          " of " + std::to_string(points));
      }
      all.push_back({ first, last + 1 });
      if (isMet)
      {
        met.push_back(all.back());
      }
    }
  }
  joinRanges(all);
  if (points > 0 && (all.size() != 1 || all[0].Begin != 0 || all[0].End != points))
  {
    throw IndexError("lacks points of the file");
  }
  joinRanges(met);
  return met;
}

/// Returns the name of the index beside a file: "a.lax" for "a.las", "A.LAX" for "A.LAZ".
std::string besideOf(const std::string& path)
{
  std::string name = path;
  const char last = name.empty() ? ' ' : name.back();
  name.back() = last == 'S' || last == 'Z' ? 'X' : 'x';
  return name;
}

/// Throws IndexError if the file beside has been replaced or changed since its index was made.
void requireNew(const std::string& beside, const std::string& path)
{
  std::error_code unknown;
  const auto ofIndex = std::filesystem::last_write_time(beside, unknown);
  const auto ofPoints = unknown ? ofIndex : std::filesystem::last_write_time(path, unknown);
  if (!unknown && ofIndex < ofPoints)
  {
    throw IndexError("is older than the file");
  }
}

std::vector<char> readIndex(const std::string& path, std::uint64_t offset, std::uint64_t bytes)
{
  constexpr std::uint64_t most = std::uint64_t(1) << 28;
  if (bytes > most)
  {
    throw IndexError("has " + std::to_string(bytes) + " bytes, too many for an index");
  }
  std::vector<char> content(static_cast<std::size_t>(bytes));
  InputFile(path).read(offset, content.data(), content.size());
  return content;
}

} // namespace

IndexedRecords findIndexedRecords(const std::string& path, const LasHeader& header, const Box2& box)
{
  IndexedRecords found;
  std::error_code ignored;
  const std::string beside = besideOf(path);
  const bool isBeside = std::filesystem::is_regular_file(beside, ignored);
  if (!isBeside && header.IndexBytes == 0)
  {
    return found;
  }
  const std::string name = isBeside ? "the index " + beside : "the index in it";
  try
  {
    if (isBeside)
    {
      requireNew(beside, path);
    }
    const std::vector<char> content = isBeside
      ? readIndex(beside, 0, InputFile(beside).size())
      : readIndex(path, header.IndexOffset, header.IndexBytes);
    found.Ranges = rangesIn(content, std::uint64_t(header.Points), box);
  }
  catch (const IndexError& error)
  {
    found.Remark = name + " " + error.what() + " and is not used; make it again or remove it";
  }
  catch (const IOError& error)
  {
    found.Remark = name + " cannot be read and is not used; make it again or remove it";
  }
  return found;
}

} // namespace tipp
