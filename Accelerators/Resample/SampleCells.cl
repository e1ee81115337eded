// SPDX-License-Identifier: BSD-3-Clause
// Finds the samples that cells claim and marks them. With NAMES_CELLS 1, marks are the cells'
// numbers, as in claimSamples(). Otherwise they are ones, and the samples are interpolated in the
// same pass, as in sampleDirectly(). A work item does SHARE cells, each step for all of them, so
// that their random memory reads overlap. Cells for which rounding could change the result, and
// thin cells to interpolate, go to a list, which the host processes. Host side:
// ResampleOnDevice.cxx.
#include "CellRows.cl"

// The mark of a sample that a cell claims.
#if NAMES_CELLS
typedef int Mark;
#define MARK(cell) ((Mark)(cell))
#else
typedef uchar Mark;
#define MARK(cell) 1
#endif

// Counters of samples: many, since all work items add to them.
#define COUNTERS 1024

// The largest number of components of all arrays together; ResampleOnDevice.cxx ensures it.
#define CHANNELS 8

typedef struct
{
  global const uchar* values;
  global uchar* samples;
  int isFloat;
  int components;
} Array;

// A component of an array in a cell: the value at the first corner, and the gradient.
typedef struct
{
  global uchar* samples;
  int isFloat;
  int components;
  int component;
  double first;
  double3 rise;
} Channel;

typedef struct
{
  double3 origin; // the first corner
  Channel channels[CHANNELS];
  int count;
} Gradients;

void order(double3* a, double3* b, int* i, int* j)
{
  const int less = (b->x < a->x) |
    ((b->x == a->x) & ((b->y < a->y) | ((b->y == a->y) & (b->z < a->z))));
  const double3 p = less ? *b : *a;
  const double3 q = less ? *a : *b;
  const int k = less ? *j : *i;
  const int l = less ? *i : *j;
  *a = p;
  *b = q;
  *i = k;
  *j = l;
}

double largest(double a, double b, double c)
{
  return fmax(fmax(fabs(a), fabs(b)), fabs(c));
}

// A cell and its corners.
typedef struct
{
  int number; // index among the work item's cells
  int ids[CORNERS];
  double3 points[CORNERS];
} Corners;

// The arrays' values at a cell's corners.
typedef double Values[CHANNELS][CORNERS];

// Sorts the corners lexicographically by coordinates, and computes the gradients of the weights of
// all but the first: see GroupLanes in Lanes.h. Returns DOUBT for a thin cell.
INLINE int setNormals(const double3* points, int* ids, double3* origin, double3* normals)
{
  double3 p[4];
  for (int i = 0; i < CORNERS; ++i)
  {
    ids[i] = i;
    p[i] = points[i];
  }
#if CORNERS == 3
  order(&p[0], &p[1], &ids[0], &ids[1]);
  order(&p[1], &p[2], &ids[1], &ids[2]);
  order(&p[0], &p[1], &ids[0], &ids[1]);
  const double3 u = p[1] - p[0];
  const double3 v = p[2] - p[0];
  const double determinant = u.x * v.y - u.y * v.x;
  const double product = largest(u.x, v.x, 0) * largest(u.y, v.y, 0);
  normals[0] = (double3)(v.y, -v.x, 0);
  normals[1] = (double3)(-u.y, u.x, 0);
#else
  order(&p[0], &p[1], &ids[0], &ids[1]);
  order(&p[2], &p[3], &ids[2], &ids[3]);
  order(&p[0], &p[2], &ids[0], &ids[2]);
  order(&p[1], &p[3], &ids[1], &ids[3]);
  order(&p[1], &p[2], &ids[1], &ids[2]);
  const double3 u = p[1] - p[0];
  const double3 v = p[2] - p[0];
  const double3 w = p[3] - p[0];
  normals[0] = v.yzx * w.zxy - v.zxy * w.yzx;
  normals[1] = w.yzx * u.zxy - w.zxy * u.yzx;
  normals[2] = u.yzx * v.zxy - u.zxy * v.yzx;
  const double determinant = normals[0].x * u.x + normals[0].y * u.y + normals[0].z * u.z;
  const double product = largest(u.x, v.x, w.x) * largest(u.y, v.y, w.y) * largest(u.z, v.z, w.z);
#endif
  *origin = p[0];
  const double inverse = 1 / determinant;
  for (int i = 0; i < CORNERS - 1; ++i)
  {
    normals[i] *= inverse;
  }
  return fabs(determinant) * 64 > product && !(product < 1e-280) ? ROWS : DOUBT;
}

double valueAt(const Array* array, int id, int component)
{
  const long at = (long)id * array->components + component;
  return array->isFloat ? ((global const float*)array->values)[at]
                        : ((global const double*)array->values)[at];
}

INLINE void loadValues(double (*values)[CORNERS], const int* ids, const Array* arrays, int count)
{
  int channel = 0;
  for (int i = 0; i < count; ++i)
  {
    for (int component = 0; component < arrays[i].components; ++component, ++channel)
    {
      for (int corner = 0; corner < CORNERS; ++corner)
      {
        values[channel][corner] = valueAt(&arrays[i], ids[corner], component);
      }
    }
  }
}

INLINE int setGradients(Gradients* gradients, const double3* points, double (*values)[CORNERS],
  const Array* arrays, int count)
{
  gradients->count = 0;
#if NAMES_CELLS
  return ROWS;
#endif
  int order[4];
  double3 normals[3];
  int state = setNormals(points, order, &gradients->origin, normals);
  for (int i = 0; i < count; ++i)
  {
    for (int component = 0; component < arrays[i].components; ++component)
    {
      const double* at = values[gradients->count];
      Channel* channel = &gradients->channels[gradients->count++];
      channel->samples = arrays[i].samples;
      channel->isFloat = arrays[i].isFloat;
      channel->components = arrays[i].components;
      channel->component = component;
      channel->first = at[order[0]];
      channel->rise = normals[0] * (at[order[1]] - channel->first);
      for (int corner = 2; corner < CORNERS; ++corner)
      {
        channel->rise += normals[corner - 1] * (at[order[corner]] - channel->first);
      }
      // Not if gradients are infinite or NaN: the samples may be finite.
      const double3 check = channel->rise - channel->rise;
      state = check.x + check.y + check.z == 0 ? state : DOUBT;
    }
  }
  return state;
}

INLINE void fillRow(const Gradients* gradients, long first, int begin, int end, double y, double z,
  Axis x)
{
  for (int i = 0; i < gradients->count; ++i)
  {
    const Channel* channel = &gradients->channels[i];
    const double base = channel->first +
      (channel->rise.y * (y - gradients->origin.y) + channel->rise.z * (z - gradients->origin.z));
    const double rise = channel->rise.x;
    for (int column = begin; column < end; ++column)
    {
      const double value = base + rise * (coordinateOf(x, column) - gradients->origin.x);
      const long at = (first + column) * channel->components + channel->component;
      if (channel->isFloat)
      {
        ((global float*)channel->samples)[at] = (float)value;
      }
      else
      {
        ((global double*)channel->samples)[at] = value;
      }
    }
  }
}

// Marks and fills some rows; returns the number of samples.
INLINE int fillRows(const Gradients* gradients, const Spans* spans, int count, Axis x, Axis y,
  Axis z, Mark mark, global Mark* marks)
{
  int total = 0;
  for (int i = 0; i < min(ROWS_AT_ONCE, count); ++i)
  {
    const int begin = spans->begin[i];
    const int end = spans->end[i];
    if (begin >= end)
    {
      continue;
    }
    total += end - begin;
    const long index = indexOfRow(spans->row[i], spans->layer[i], x, y);
    for (int column = begin; column < end; ++column)
    {
      marks[index + column] = mark;
    }
    fillRow(gradients, index, begin, end, coordinateOf(y, spans->row[i]),
      CORNERS == 4 ? coordinateOf(z, spans->layer[i]) : 0, x);
  }
  return total;
}

// Fills a cell's rows up to `last` - 1. `spans` has the first ones; rows count from the first of
// its box.
INLINE int fillCell(const Cell* cell, Spans* spans, int first, int last,
  const Gradients* gradients, Axis x, Axis y, Axis z, Mark mark, global Mark* marks, int* total)
{
  *total = 0;
  while (true)
  {
    *total += fillRows(gradients, spans, last - first, x, y, z, mark, marks);
    first += ROWS_AT_ONCE;
    if (first >= last)
    {
      return ROWS;
    }
    if (cellSpans(cell, first, last, x, y, spans) == DOUBT)
    {
      return DOUBT;
    }
  }
}

// Whether a cell with `rows` rows of samples, of which `spans` has the first, may claim any sample.
INLINE int isOpen(const Spans* spans, int rows)
{
  int open = rows > ROWS_AT_ONCE;
  for (int i = 0; i < min(ROWS_AT_ONCE, rows); ++i)
  {
    open |= spans->begin[i] < spans->end[i];
  }
  return open;
}

// Whether all corners lie beyond one side of the lattice: see OutsidePoints in SimplexMesh.h.
int isOutside(const int* ids, global const uchar* sides)
{
  int common = 0xff;
  for (int i = 0; i < CORNERS; ++i)
  {
    common &= sides[ids[i]];
  }
  return common != 0;
}

// The parameters that both kernels have. Each array has its own, since OpenCL has no arrays of
// buffers.
#define PARAMETERS                                                                                 \
  global const Real *points, global const Id *ids, int u, int v, Axis x, Axis y, Axis z,           \
    long firstCell, global Mark *marks, int arrayCount, global const uchar *values0,               \
    global uchar *samples0, int isFloat0, int components0, global const uchar *values1,            \
    global uchar *samples1, int isFloat1, int components1, global const uchar *values2,            \
    global uchar *samples2, int isFloat2, int components2, global const uchar *values3,            \
    global uchar *samples3, int isFloat3, int components3
#define ARRAYS                                                                                     \
  {                                                                                                \
    { values0, samples0, isFloat0, components0 }, { values1, samples1, isFloat1, components1 },    \
      { values2, samples2, isFloat2, components2 }, { values3, samples3, isFloat3, components3 }   \
  }

// Prefetches what the next work item reads first, if the compiler can: PoCL's prefetch() does
// nothing. GPUs run work items concurrently and do not need it. Prefetching beyond the end is
// harmless.
void askForIds(const Mesh* mesh, long cell)
{
#if SHARE > 1 && defined(__has_builtin)
#if __has_builtin(__builtin_prefetch)
  const size_t first = (size_t)(mesh->ids + cell * CORNERS);
  for (size_t line = 0; line < SHARE * CORNERS * sizeof(Id); line += 64)
  {
    __builtin_prefetch((const void*)(first + line));
  }
#endif
#endif
}

// A cell whose box has samples.
typedef struct
{
  Cell cell;
  Spans spans; // the spans of its first rows
  Corners* corners;
  int state;
} Live;

// Adds to one of the counters. The second half of the array counts their overflows, because the sum
// over overlapping cells may exceed 32 bits.
void count(global uint* counters, long item, uint samples)
{
  const long counter = item % COUNTERS;
  if (samples != 0 && atomic_add(&counters[counter], samples) > UINT_MAX - samples)
  {
    atomic_inc(&counters[COUNTERS + counter]);
  }
}

// Each work item does SHARE consecutive cells. Cells with more than `most` samples in their boxes
// and undecided cells are appended to the lists, whose lengths are in `lengths`. The samples of
// listed cells are not counted.
#if SHARE > 1
// PoCL allocates the arrays of all work items of a group: with many items they would not fit into
// the cache.
__attribute__((reqd_work_group_size(1, 1, 1)))
#endif
kernel void sampleCells(PARAMETERS, long cells, long most, global const uchar* hidden,
  int hasHidden, global const uchar* sides, int hasSides, global uint* counters, global int* large,
  global int* doubtful, global int* lengths)
{
  const Mesh mesh = { points, ids, u, v };
  const Array arrays[4] = ARRAYS;
  const long item = get_global_id(0);
  const long begin = item * SHARE;
  if (begin >= cells)
  {
    return;
  }
  Corners corners[SHARE];
  int kept = 0;
  for (int i = 0; i < (int)min((long)SHARE, cells - begin); ++i)
  {
    int ids[CORNERS];
    loadIds(&mesh, begin + i, ids);
    if ((hasHidden && hidden[begin + i]) || (hasSides && isOutside(ids, sides)))
    {
      continue;
    }
    for (int corner = 0; corner < CORNERS; ++corner)
    {
      corners[kept].ids[corner] = ids[corner];
    }
    corners[kept++].number = i;
  }
  askForIds(&mesh, begin + SHARE);
  for (int k = 0; k < kept; ++k)
  {
    loadPoints(&mesh, corners[k].ids, corners[k].points);
  }
  Live live[SHARE];
  int liveCount = 0;
  for (int k = 0; k < kept; ++k)
  {
    Live* next = &live[liveCount];
    next->corners = &corners[k];
    next->state = setBox(&next->cell, corners[k].points, x, y, z);
    liveCount += next->state != NOTHING;
  }
  int open[SHARE];
  int openCount = 0;
  for (int k = 0; k < liveCount; ++k)
  {
    Live* of = &live[k];
    const int rows = rowsOf(&of->cell.box);
    if (of->state == ROWS)
    {
      of->state = setRows(&of->cell, of->corners->points, x, y, z);
    }
    if (of->state == ROWS && samplesOf(&of->cell.box) > most)
    {
      large[atomic_inc(&lengths[0])] = (int)begin + of->corners->number;
      continue;
    }
    if (of->state != DOUBT)
    {
      // NOTHING is 0, so an empty cell stays empty.
      of->state *= cellSpans(&of->cell, 0, rows, x, y, &of->spans);
    }
    if (of->state == DOUBT)
    {
      doubtful[atomic_inc(&lengths[1])] = (int)begin + of->corners->number;
    }
    open[openCount] = k;
    openCount += (of->state == ROWS) & isOpen(&of->spans, rows);
  }
  Values values[SHARE];
  for (int k = 0; k < openCount; ++k)
  {
    loadValues(values[k], live[open[k]].corners->ids, arrays, arrayCount);
  }
  uint sum = 0;
  for (int k = 0; k < openCount; ++k)
  {
    Live* of = &live[open[k]];
    Gradients gradients;
    int total = 0;
    int state = setGradients(&gradients, of->corners->points, values[k], arrays, arrayCount);
    if (state == ROWS)
    {
      state = fillCell(&of->cell, &of->spans, 0, rowsOf(&of->cell.box), &gradients, x, y, z,
        MARK(firstCell + begin + of->corners->number), marks, &total);
    }
    if (state == DOUBT)
    {
      doubtful[atomic_inc(&lengths[1])] = (int)begin + of->corners->number;
    }
    sum += state == ROWS ? total : 0;
  }
  count(counters, item, sum);
}

// One large cell, of which sampleCells() has found that setBox() and setRows() return ROWS; a work
// item per row. counts[row] is the number of samples claimed, or -1 if that is undecided.
kernel void sampleLarge(PARAMETERS, long number, int rows, global int* counts)
{
  const Mesh mesh = { points, ids, u, v };
  const Array arrays[4] = ARRAYS;
  const int item = (int)get_global_id(0);
  if (item >= rows)
  {
    return;
  }
  Corners corners;
  loadIds(&mesh, number, corners.ids);
  loadPoints(&mesh, corners.ids, corners.points);
  Values values;
  loadValues(values, corners.ids, arrays, arrayCount);
  Cell cell;
  setBox(&cell, corners.points, x, y, z);
  setRows(&cell, corners.points, x, y, z);
  Spans spans;
  Gradients gradients;
  int total = 0;
  int state = cellSpans(&cell, item, item + 1, x, y, &spans);
  if (state == ROWS && isOpen(&spans, 1))
  {
    state = setGradients(&gradients, corners.points, values, arrays, arrayCount);
    total = state == ROWS
      ? fillRows(&gradients, &spans, 1, x, y, z, MARK(firstCell + number), marks)
      : 0;
  }
  counts[item] = state == DOUBT ? -1 : total;
}
