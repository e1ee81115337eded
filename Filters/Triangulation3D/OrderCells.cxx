// SPDX-License-Identifier: BSD-3-Clause
#include "Triangulation3D/OrderCells.h"

#include "Parallel/CountingSort.h"
#include "Parallel/ParallelFor.h"

#include <algorithm>
#include <utility>

namespace tipp
{
namespace
{

/// Sorts the ids of a cell; exchanges the last two if the sorting changed the orientation.
CellIds canonical(CellIds cell)
{
  bool isOdd = false;
  const auto exchange = [&](std::size_t i, std::size_t j)
  {
    if (cell[j] < cell[i])
    {
      std::swap(cell[i], cell[j]);
      isOdd = !isOdd;
    }
  };
  exchange(0, 1);
  exchange(2, 3);
  exchange(0, 2);
  exchange(1, 3);
  exchange(1, 2);
  if (isOdd)
  {
    std::swap(cell[2], cell[3]);
  }
  return cell;
}

/// Compares cells with the same first id. It is an object so that the compiler inlines it into the
/// sort.
struct IsBefore
{
  bool operator()(const CellIds& a, const CellIds& b) const
  {
    if (a[1] != b[1])
    {
      return a[1] < b[1];
    }
    const auto [aLow, aHigh] = std::minmax(a[2], a[3]);
    const auto [bLow, bHigh] = std::minmax(b[2], b[3]);
    return aLow != bLow ? aLow < bLow : aHigh < bHigh;
  }
};

/// Compares any two cells: by their first ids, then by IsBefore.
struct IsBeforeAny
{
  bool operator()(const CellIds& a, const CellIds& b) const
  {
    return a[0] != b[0] ? a[0] < b[0] : IsBefore()(a, b);
  }
};

/// Writes `count` cells with the same first id to `to`, sorted. Each of a few cells is written to
/// its rank: to count the cells before it takes no branches, of which a sort mispredicts a third.
void sortGroup(CellIds* from, std::size_t count, CellIds* to)
{
  constexpr std::size_t few = 48;
  if (count > few)
  {
    std::sort(from, from + count, IsBefore());
    std::copy_n(from, count, to);
    return;
  }
  std::array<std::uint64_t, few> high; // the second and third id
  std::array<std::int32_t, few> low;
  for (std::size_t i = 0; i < count; ++i)
  {
    const auto [c, d] = std::minmax(from[i][2], from[i][3]);
    high[i] = std::uint64_t(from[i][1]) << 32 | std::uint64_t(c);
    low[i] = d;
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    unsigned rank = 0;
    for (std::size_t j = 0; j < i; ++j)
    {
      rank +=
        unsigned(high[j] < high[i]) | (unsigned(high[j] == high[i]) & unsigned(low[j] <= low[i]));
    }
    for (std::size_t j = i + 1; j < count; ++j)
    {
      rank +=
        unsigned(high[j] < high[i]) | (unsigned(high[j] == high[i]) & unsigned(low[j] < low[i]));
    }
    to[rank] = from[i];
  }
}

/// Sorts the cells whose first id is in [first, first + width).
void sortRange(CellIds* begin, CellIds* end, std::int32_t first, std::size_t width)
{
  GroupedItems<CellIds, std::uint32_t> grouped(width, 1,
    [&](const auto& visit)
    {
      std::for_each(
        begin, end, [&](const CellIds& cell) { visit(std::size_t(cell[0] - first), cell); });
    });
  for (std::size_t i = 0; i < width; ++i)
  {
    const auto count = std::size_t(grouped.end(i) - grouped.begin(i));
    sortGroup(grouped.begin(i), count, begin + (grouped.begin(i) - grouped.data()));
  }
}

Buffer<char> merged(const Buffer<char>& a, const Buffer<char>& b)
{
  Buffer<char> both(a.size() + b.size());
  const auto* const cellsOfA = a.as<CellIds>();
  const auto* const cellsOfB = b.as<CellIds>();
  std::merge(cellsOfA, cellsOfA + a.size() / sizeof(CellIds), cellsOfB,
    cellsOfB + b.size() / sizeof(CellIds), both.as<CellIds>(), IsBeforeAny());
  return both;
}

} // namespace

Buffer<std::int32_t> orderCells(
  std::vector<std::vector<CellIds>>&& parts, std::size_t points, int threads)
{
  // Ranges of first ids: small enough that the cells of one fit in a cache, and few enough that one
  // pass can distribute to all of them.
  constexpr std::size_t mostRanges = 1024;
  constexpr unsigned leastShift = 8;
  unsigned shift = leastShift;
  while ((points >> shift) + 1 > mostRanges)
  {
    ++shift;
  }
  const std::size_t ranges = (points >> shift) + 1;
  std::vector<std::vector<std::size_t>> next(parts.size(), std::vector<std::size_t>(ranges, 0));
  const auto count = std::int64_t(parts.size());
  parallelFor(count, threads,
    [&](std::int64_t part)
    {
      for (CellIds& cell : parts[std::size_t(part)])
      {
        cell = canonical(cell);
        ++next[std::size_t(part)][std::size_t(cell[0]) >> shift];
      }
    });
  const std::vector<std::size_t> begins = countsToIndices(ranges, next);
  Buffer<std::int32_t> ids(4 * begins.back());
  auto* const cells = ids.as<CellIds>();
  parallelFor(count, threads,
    [&](std::int64_t part)
    {
      for (const CellIds& cell : parts[std::size_t(part)])
      {
        cells[next[std::size_t(part)][std::size_t(cell[0]) >> shift]++] = cell;
      }
      std::vector<CellIds>().swap(parts[std::size_t(part)]);
    });
  parallelFor(std::int64_t(ranges), threads,
    [&](std::int64_t range)
    {
      const auto r = std::size_t(range);
      sortRange(cells + begins[r], cells + begins[r + 1], std::int32_t(r << shift),
        std::size_t(1) << shift);
    });
  return ids;
}

Buffer<std::int32_t> mergeCells(std::vector<Buffer<char>> parts)
{
  // Neighbours in pairs, until one list is left.
  while (parts.size() > 1)
  {
    const std::size_t pairs = parts.size() / 2;
    for (std::size_t i = 0; i < pairs; ++i)
    {
      parts[i] = merged(parts[2 * i], parts[2 * i + 1]);
      parts[2 * i + 1] = {};
    }
    if (parts.size() % 2 == 1)
    {
      parts[pairs] = std::move(parts.back());
    }
    parts.resize(parts.size() - pairs);
  }
  return parts.empty() ? Buffer<std::int32_t>() : Buffer<std::int32_t>(std::move(parts[0]));
}

void orderTriangles(Buffer<std::int32_t>& ids)
{
  using Corners = std::array<std::int32_t, 3>;
  auto* const begin = ids.as<Corners>();
  auto* const end = begin + ids.size() / 3;
  for (Corners* corners = begin; corners != end; ++corners)
  {
    std::rotate(
      corners->begin(), std::min_element(corners->begin(), corners->end()), corners->end());
  }
  std::sort(begin, end);
}

Buffer<std::int32_t> orderTriangles(const std::vector<CellIds>& cells)
{
  Buffer<std::int32_t> ids(3 * cells.size());
  std::int32_t* to = ids.data();
  for (const CellIds& cell : cells)
  {
    to = std::copy_n(cell.begin(), 3, to);
  }
  orderTriangles(ids);
  return ids;
}

} // namespace tipp
