// SPDX-License-Identifier: BSD-3-Clause
// Which cell answers each sample of a lattice. A cell for which rounding could change a count goes to
// a list, for the host to do exactly. Host side: ResampleOnDevice.cxx.
#include "LatticeAndMesh.cl"
#include "CellRows.cl"

// Claims a row; returns the number of samples, or -1 if that is in doubt.
int claimRow(const Cell* cell, int row, int layer, Axis x, Axis y, Axis z, int name,
  global int* claims)
{
  int begin;
  int end;
  const int state = cellSpan(cell, row, layer, x, y, z, &begin, &end);
  if (state == DOUBT)
  {
    return -1;
  }
  const long first = placeOfRow(row, layer, x, y);
  for (int i = begin; i < end; ++i)
  {
    claims[first + i] = name;
  }
  return max(0, end - begin);
}

// Each item does `share` cells in a row. Cells with more than `largest` samples in their boxes and
// cells in doubt go to the lists; `lengths` has the lists' lengths. A cell of a list counts nothing.
kernel void claimCells(global const Real* points, global const Id* ids, int u, int v, Axis x, Axis y, Axis z, long cells, long firstCell, int share,
  long largest, global const uchar* hidden, int hasHidden, global int* claims,
  global uint* counts, global int* large, global int* doubtful, global int* lengths)
{
  const Mesh mesh = { points, ids, u, v };
  const long item = get_global_id(0);
  const long begin = item * share;
  if (begin >= cells)
  {
    return;
  }
  uint total = 0;
  for (long i = begin; i < min(begin + share, cells); ++i)
  {
    Cell cell;
    if (hasHidden && hidden[i])
    {
      continue;
    }
    int state = setCell(&cell, &mesh, i, x, y, z);
    const Box box = cell.box;
    if (state == ROWS && samplesOf(&box) > largest)
    {
      large[atomic_inc(&lengths[0])] = (int)i;
      continue;
    }
    int count = 0;
    for (int layer = box.layerBegin; state == ROWS && layer < box.layerEnd; ++layer)
    {
      for (int row = box.rowBegin; state == ROWS && row < box.rowEnd; ++row)
      {
        const int claimed =
          claimRow(&cell, row, layer, x, y, z, (int)(firstCell + i), claims);
        state = claimed < 0 ? DOUBT : ROWS;
        count += claimed;
      }
    }
    if (state == DOUBT)
    {
      doubtful[atomic_inc(&lengths[1])] = (int)i;
    }
    total += state == ROWS ? count : 0;
  }
  counts[item] = total;
}

// One large cell, a row an item; counts[row] is what it claims, or -1 if that is in doubt.
kernel void claimLarge(global const Real* points, global const Id* ids, int u, int v, Axis x, Axis y, Axis z, long number, long firstCell, int rows,
  global int* claims, global int* counts)
{
  const Mesh mesh = { points, ids, u, v };
  const int item = (int)get_global_id(0);
  Cell cell;
  setCell(&cell, &mesh, number, x, y, z);
  const Box box = cell.box;
  if (item < rows)
  {
    const int depth = box.rowEnd - box.rowBegin;
    counts[item] = claimRow(&cell, box.rowBegin + item % depth,
      box.layerBegin + item / depth, x, y, z, (int)(firstCell + number), claims);
  }
}
