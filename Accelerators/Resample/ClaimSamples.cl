// SPDX-License-Identifier: BSD-3-Clause
// Finds the cell that claims each sample of a lattice. Cells for which rounding could change the
// result go to a list, which the host processes exactly. Host side: ResampleOnDevice.cxx.
#include "LatticeAndMesh.cl"
#include "CellRows.cl"

// Claims some rows of a cell; returns the number of samples, or -1 if that is undecided.
INLINE int claimRows(const Cell* cell, int first, int last, Axis x, Axis y, int name, global int* claims)
{
  int total = 0;
  for (; first < last; first += ROWS_AT_ONCE)
  {
    Spans spans;
    if (cellSpans(cell, first, last, x, y, &spans) == DOUBT)
    {
      return -1;
    }
    for (int i = 0; i < min(ROWS_AT_ONCE, last - first); ++i)
    {
      const long row = indexOfRow(spans.row[i], spans.layer[i], x, y);
      for (int column = spans.begin[i]; column < spans.end[i]; ++column)
      {
        claims[row + column] = name;
      }
      total += max(0, spans.end[i] - spans.begin[i]);
    }
  }
  return total;
}

INLINE int setCellOf(Cell* cell, const Mesh* mesh, long number, Axis x, Axis y, Axis z)
{
  int ids[CORNERS];
  double3 points[CORNERS];
  loadIds(mesh, number, ids);
  loadPoints(mesh, ids, points);
  const int state = setBox(cell, points, x, y, z);
  return state == ROWS ? setRows(cell, points, x, y, z) : state;
}

// Each work item processes `share` consecutive cells. Cells with more than `largest` samples in
// their boxes and undecided cells are appended to the lists, whose lengths are in `lengths`. The
// samples of listed cells are not counted.
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
    int state = setCellOf(&cell, &mesh, i, x, y, z);
    const Box box = cell.box;
    if (state == ROWS && samplesOf(&box) > largest)
    {
      large[atomic_inc(&lengths[0])] = (int)i;
      continue;
    }
    int count = 0;
    if (state == ROWS)
    {
      count = claimRows(&cell, 0, rowsOf(&box), x, y, (int)(firstCell + i), claims);
      state = count < 0 ? DOUBT : ROWS;
    }
    if (state == DOUBT)
    {
      doubtful[atomic_inc(&lengths[1])] = (int)i;
    }
    total += state == ROWS ? count : 0;
  }
  counts[item] = total;
}

// One large cell, a work item per row; counts[row] is the number of samples claimed, or -1 if that
// is undecided.
kernel void claimLarge(global const Real* points, global const Id* ids, int u, int v, Axis x, Axis y, Axis z, long number, long firstCell, int rows,
  global int* claims, global int* counts)
{
  const Mesh mesh = { points, ids, u, v };
  const int item = (int)get_global_id(0);
  Cell cell;
  setCellOf(&cell, &mesh, number, x, y, z);
  if (item < rows)
  {
    counts[item] = claimRows(&cell, item, item + 1, x, y, (int)(firstCell + number), claims);
  }
}
