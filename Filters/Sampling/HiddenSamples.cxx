// SPDX-License-Identifier: BSD-3-Clause
#include "Sampling/HiddenSamples.h"

#include "Parallel/ParallelFor.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace tipp
{
namespace
{

// VTK's vtkDataSetAttributes::HIDDENPOINT and HIDDENCELL.
constexpr int hiddenPoint = 2;
constexpr int hiddenCell = 32;

// Separate functions, so that the compiler can assume that the bytes written alias nothing.

/// Marks invalid points as hidden. `count` must fit into a byte. Returns the number of valid
/// points.
unsigned char hidePoints(
  const unsigned char* valid, std::int64_t count, unsigned char* __restrict ghosts)
{
  unsigned char hits = 0;
  for (std::int64_t i = 0; i < count; ++i)
  {
    ghosts[i] = (unsigned char)((valid[i] - 1) & hiddenPoint);
    hits = (unsigned char)(hits + valid[i]);
  }
  return hits;
}

/// Computes for each column whether the points of all four rows are valid.
void joinRows(
  const unsigned char* const (&rows)[4], std::int64_t count, unsigned char* __restrict valid)
{
  const unsigned char* const a = rows[0];
  const unsigned char* const b = rows[1];
  const unsigned char* const c = rows[2];
  const unsigned char* const d = rows[3];
  for (std::int64_t i = 0; i < count; ++i)
  {
    valid[i] = a[i] & b[i] & c[i] & d[i];
  }
}

/// Hides cells with invalid points; a cell's columns of points are `right` apart.
void hideCells(const unsigned char* valid, std::int64_t right, std::int64_t count,
  unsigned char* __restrict ghosts)
{
  for (std::int64_t i = 0; i < count; ++i)
  {
    const int whole = valid[i] & valid[i + right];
    ghosts[i] = (unsigned char)((whole - 1) & hiddenCell);
  }
}

std::int64_t cellsAlong(const Lattice& lattice, int axis)
{
  return std::max<std::int64_t>(1, lattice.size(axis) - 1);
}

} // namespace

std::int64_t markHiddenSamples(
  const unsigned char* valid, std::int64_t samples, int threads, unsigned char* ghosts)
{
  std::vector<std::int64_t> counts(std::size_t(threads), 0);
  forChunks(samples, 1 << 16, threads, {},
    [&](std::int64_t begin, std::int64_t end, int thread)
    {
      constexpr std::int64_t few = 1 << 7; // the count fits into a byte; lanes are summed in bytes
      std::int64_t count = 0;
      for (std::int64_t first = begin; first < end; first += few)
      {
        count += hidePoints(valid + first, std::min(few, end - first), ghosts + first);
      }
      counts[std::size_t(thread)] += count;
    });
  return std::accumulate(counts.begin(), counts.end(), std::int64_t(0));
}

std::int64_t cellsBetween(const Lattice& lattice)
{
  return cellsAlong(lattice, 0) * cellsAlong(lattice, 1) * cellsAlong(lattice, 2);
}

void markHiddenCells(
  const Lattice& lattice, const unsigned char* valid, int threads, unsigned char* ghosts)
{
  const std::int64_t width = lattice.size(0);
  const std::int64_t layer = width * lattice.size(1);
  const std::int64_t columns = cellsAlong(lattice, 0);
  const std::int64_t rows = cellsAlong(lattice, 1);
  const std::int64_t right = width > 1 ? 1 : 0;
  const std::int64_t back = lattice.size(1) > 1 ? width : 0;
  const std::int64_t up = lattice.size(2) > 1 ? layer : 0;
  const auto fillRow = [&](std::int64_t row, std::vector<unsigned char>& corners)
  {
    const unsigned char* const points = valid + row / rows * layer + row % rows * width;
    joinRows({ points, points + back, points + up, points + up + back }, width, corners.data());
    hideCells(corners.data(), right, columns, ghosts + row * columns);
  };
  forChunks(rows * cellsAlong(lattice, 2), 64, threads, {},
    [&](std::int64_t begin, std::int64_t end, int)
    {
      std::vector<unsigned char> corners(static_cast<std::size_t>(width));
      for (std::int64_t row = begin; row < end; ++row)
      {
        fillRow(row, corners);
      }
    });
}

} // namespace tipp
