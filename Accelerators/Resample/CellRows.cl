// SPDX-License-Identifier: BSD-3-Clause
// Which samples of its rows a cell answers, as far as rounding could not change a count. After
// LatticeAndMesh.cl; TriangleRows.cl and TetrahedronRows.cl, of which one counts, follow with a Cell and
// setBox(), setRows() and cellSpans() for it, to be called in this order. Each returns what the cell
// has as far as it knows.
#define NOTHING 0
#define ROWS 1
#define DOUBT 2

// Without branches, many of which would be mispredicted: a mask is 0 or -1.
int anyOf(int4 truths)
{
  const int2 pairs = truths.lo | truths.hi;
  return pairs.x | pairs.y;
}
int allOf(int4 truths)
{
  const int2 pairs = truths.lo & truths.hi;
  return pairs.x & pairs.y;
}
int stateOf(int isNothing, int isSure)
{
  return (1 + isNothing) * (2 + isSure);
}

// A box's samples: columns, rows and layers.
typedef struct
{
  int4 begin;
  int4 end;
} Box;

// The number of rows in a cell's box.
int rowsOf(const Box* box)
{
  return (box->end.y - box->begin.y) * (box->end.z - box->begin.z);
}

// The number of samples in a cell's box.
long samplesOf(const Box* box)
{
  return (long)(box->end.x - box->begin.x) * rowsOf(box);
}

// Number of rows of a cell processed together.
#define ROWS_AT_ONCE (CORNERS == 3 ? 4 : 8)

// The samples that rows of a cell claim; a row without samples has end <= begin.
typedef struct
{
  int begin[ROWS_AT_ONCE];
  int end[ROWS_AT_ONCE];
  int row[ROWS_AT_ONCE];
  int layer[ROWS_AT_ONCE];
} Spans;

// The index of a row's first sample.
long placeOfRow(int row, int layer, Axis x, Axis y)
{
  return ((long)layer * (long)y.s7 + row) * (long)x.s7;
}
