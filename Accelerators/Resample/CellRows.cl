// SPDX-License-Identifier: BSD-3-Clause
// For the kernels of SampleCells.cl: the lattice of samples, the mesh, and the samples in each row
// that a cell claims, unless rounding could change the result (DOUBT).
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
#pragma OPENCL FP_CONTRACT OFF

// For functions that are called for every cell and take whole axes as arguments.
#define INLINE __attribute__((always_inline))

// The smaller or larger of two numbers or vectors; b if one is NaN. Maps to one instruction,
// whereas fmin() and fmax() also check for NaN.
#define LEAST(a, b) ((a) < (b) ? (a) : (b))
#define MOST(a, b) ((a) > (b) ? (a) : (b))
#define CLAMPED(a, low, high) LEAST(MOST(a, low), high)

#define ROUNDINGS 0x1p-47
#define SMALLEST 1e-280

// A LatticeAxis; s0 to sa are origin, inverse, first, limit, error scale, error offset, delta, size,
// and the start, step and scale of its GridSteps.
typedef double16 Axis;

double coordinateOf(Axis axis, int i)
{
  return (axis.s8 + (i + axis.s2) * axis.s9) / axis.sa;
}
double4 coordinatesOf(Axis axis, int4 i)
{
  return (axis.s8 + (convert_double4(i) + axis.s2) * axis.s9) / axis.sa;
}
// The position of v in steps: LatticeAxis::position().
double4 placesOf(Axis axis, double4 v)
{
  const double4 position = (v - axis.s0) * axis.s1 - axis.s2 + 1;
  return CLAMPED(position, (double4)(0.5), (double4)(axis.s3));
}
// LatticeAxis::certain().
long4 certain(double4 position, double4 error)
{
  return fabs(position - convert_double4(convert_int4(position)) - 0.5) < 0.5 - error;
}

// Four axes side by side.
typedef struct
{
  double4 origin;
  double4 inverse;
  double4 first;
  double4 start;
  double4 step;
  double4 scale;
  double4 last; // index of the last sample
} Axes;

INLINE Axes axesOf(Axis a, Axis b, Axis c, Axis d)
{
  Axes axes;
  axes.origin = (double4)(a.s0, b.s0, c.s0, d.s0);
  axes.inverse = (double4)(a.s1, b.s1, c.s1, d.s1);
  axes.first = (double4)(a.s2, b.s2, c.s2, d.s2);
  axes.start = (double4)(a.s8, b.s8, c.s8, d.s8);
  axes.step = (double4)(a.s9, b.s9, c.s9, d.s9);
  axes.scale = (double4)(a.sa, b.sa, c.sa, d.sa);
  axes.last = (double4)(a.s7, b.s7, c.s7, d.s7) - 1;
  return axes;
}

// The indices of the samples nearest to v. If errors are below half a step, only these can be on
// the wrong side of v.
INLINE int4 nearestTo(const Axes* axes, double4 v)
{
  const double4 position = (v - axes->origin) * axes->inverse + (0.5 - axes->first);
  return convert_int4(CLAMPED(position, (double4)(0), axes->last));
}
// The coordinates of samples, as LatticeAxis computes them.
INLINE double4 samplesAt(const Axes* axes, int4 i)
{
  return (axes->start + (convert_double4(i) + axes->first) * axes->step) / axes->scale;
}
// How many samples lie before v. (A comparison is -1 where it is true.)
INLINE int4 countBefore(const Axes* axes, double4 v)
{
  const int4 nearest = nearestTo(axes, v);
  return nearest - convert_int4(samplesAt(axes, nearest) < v);
}
INLINE int4 countUpTo(const Axes* axes, double4 v)
{
  const int4 nearest = nearestTo(axes, v);
  return nearest - convert_int4(samplesAt(axes, nearest) <= v);
}

// Compiler options give the mesh's types: CORNERS is 3 or 4, FLOAT_POINTS and WIDE_IDS are 0 or 1.
#if FLOAT_POINTS
typedef float Real;
#else
typedef double Real;
#endif
#if WIDE_IDS
typedef long Id;
#else
typedef int Id;
#endif

// Points are read along the axes u and v, and for tetrahedra also along the third.
typedef struct
{
  global const Real* points;
  global const Id* ids;
  int u;
  int v;
} Mesh;

void loadIds(const Mesh* mesh, long cell, int* ids)
{
  for (int corner = 0; corner < CORNERS; ++corner)
  {
    ids[corner] = (int)mesh->ids[cell * CORNERS + corner];
  }
}
void loadPoints(const Mesh* mesh, const int* ids, double3* points)
{
#pragma unroll
  for (int corner = 0; corner < CORNERS; ++corner)
  {
    global const Real* p = mesh->points + 3 * (long)ids[corner];
    points[corner] =
      CORNERS == 4 ? (double3)(p[0], p[1], p[2]) : (double3)(p[mesh->u], p[mesh->v], 0);
  }
}

// Triangles and tetrahedra each have a Cell and setBox(), setRows() and cellSpans(), to be called
// in this order. Each returns NOTHING, ROWS or DOUBT.
#define NOTHING 0
#define ROWS 1
#define DOUBT 2

// Branch-free, since many branches would be mispredicted. A mask is 0 or -1.
int anyOf(int4 mask)
{
  const int2 pairs = mask.lo | mask.hi;
  return pairs.x | pairs.y;
}
int allOf(int4 mask)
{
  const int2 pairs = mask.lo & mask.hi;
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
long indexOfRow(int row, int layer, Axis x, Axis y)
{
  return ((long)layer * (long)y.s7 + row) * (long)x.s7;
}

// The counterpart of TriangleRows in CellRows.h; the third axis is not used.
#if CORNERS == 3

typedef struct
{
  double2 low;
  double slope;
} Edge;

typedef struct
{
  Edge edges[3]; // the long edge, then the short ones below and above the middle corner
  double middle;
  double top;
  double error;
  int longIsLeft;
  Box box;
} Cell;

Edge edgeOf(double3 low, double3 high)
{
  Edge edge;
  edge.low = low.xy;
  edge.slope = (high.x - low.x) / (high.y - low.y);
  return edge;
}

// Branch-free, since half of the branches would be mispredicted.
void lowFirst(double3* a, double3* b)
{
  const bool swap = b->y < a->y;
  const double3 low = swap ? *b : *a;
  const double3 high = swap ? *a : *b;
  *a = low;
  *b = high;
}

// Sets the box of samples: LatticeAxis::range() along both axes.
INLINE int setBox(Cell* t, const double3* p, Axis x, Axis y, Axis z)
{
  const double2 least = LEAST(p[0].xy, p[1].xy);
  const double2 most = MOST(p[0].xy, p[1].xy);
  const double2 low = LEAST(least, p[2].xy);
  const double2 high = MOST(most, p[2].xy);
  const double2 error = MOST(-low, high) * (double2)(x.s4, y.s4) + (double2)(x.s5, y.s5);
  const double4 ends = (double4)(low, high);
  const Axes axes = axesOf(x, y, x, y);
  const int2 begin = countBefore(&axes, ends).lo;
  const int2 end = countUpTo(&axes, ends).hi;
  const int2 sure = convert_int2(error < 0.5);
  t->error = error.x;
  t->box.begin = (int4)(begin, 0, 0);
  t->box.end = (int4)(end, 1, 1);
  return stateOf(anyOf((int4)(sure & (begin >= end), 0, 0)), allOf((int4)(sure, -1, -1)));
}

INLINE int setRows(Cell* t, const double3* p, Axis x, Axis y, Axis z)
{
  double3 a = p[0];
  double3 b = p[1];
  double3 c = p[2];
  lowFirst(&a, &b);
  lowFirst(&b, &c);
  lowFirst(&a, &b);
  // orientation(a, c, b) with the filter of ExactPredicates.h.
  const double l = (a.x - b.x) * (c.y - b.y);
  const double r = (a.y - b.y) * (c.x - b.x);
  const double bound = 3.3306690738754716e-16 * (fabs(l) + fabs(r)) + 1e-300;
  // False for non-finite coordinates.
  if (!(fabs(l - r) > bound))
  {
    return DOUBT;
  }
  t->longIsLeft = l < r;
  t->middle = b.y;
  t->top = c.y;
  t->edges[0] = edgeOf(a, c);
  t->edges[1] = edgeOf(a, b);
  t->edges[2] = edgeOf(b, c);
  return ROWS;
}

// The rows first..last - 1 of the box, at most ROWS_AT_ONCE.
INLINE int cellSpans(const Cell* t, int first, int last, Axis u, Axis v, Spans* spans)
{
  const int4 number = (int4)(0, 1, 2, 3) + first;
  const int4 row = number + t->box.begin.y;
  const double4 y = coordinatesOf(v, row);
  const long4 upper = y >= t->middle;
  const Edge* whole = &t->edges[0];
  const Edge* below = &t->edges[1];
  const Edge* above = &t->edges[2];
  const double4 lowX = upper ? (double4)(above->low.x) : (double4)(below->low.x);
  const double4 lowY = upper ? (double4)(above->low.y) : (double4)(below->low.y);
  const double4 slope = upper ? (double4)(above->slope) : (double4)(below->slope);
  const double4 xLong = whole->low.x + (y - whole->low.y) * whole->slope;
  const double4 xOther = lowX + (y - lowY) * slope;
  const double4 atLong = placesOf(u, xLong);
  const double4 atOther = placesOf(u, xOther);
  const double4 sum = xLong + xOther;
  const long4 sure = (y < t->top) & (sum - sum == 0) & certain(atLong, (double4)(t->error)) &
    certain(atOther, (double4)(t->error));
  vstore4(convert_int4(t->longIsLeft ? atLong : atOther), 0, spans->begin);
  vstore4(convert_int4(t->longIsLeft ? atOther : atLong), 0, spans->end);
  vstore4(row, 0, spans->row);
  vstore4((int4)(0), 0, spans->layer);
  return any(~convert_int4(sure) & (number < last)) ? DOUBT : ROWS;
}

#endif

// The counterpart of TetrahedronRows in CellRows.h.
#if CORNERS == 4

// The four faces in lanes: where each crosses the first row, in steps from the box's first column,
// and how many steps earlier with each further row and layer. In single precision, see CellLanes.h.
typedef struct
{
  float4 position;
  float4 perRow;
  float4 perLayer;
  float4 notBegin;
  float4 notEnd;
  float certainty;
  Box box;
  double3 size; // size of the box
  double3 error;
  int isSample; // the box has one sample, which is inside; the other fields are undefined
} Cell;

#define BEYOND 1e30f

// The corners a, b, c of the faces turn counter-clockwise seen from inside.
INLINE int setFaces(Cell* t, const double3 a, const double3 b, const double3 c, const double3 d,
  double3 size, double3 errors, Axis x, Axis y, Axis z)
{
  const double4 ax = (double4)(b.x, a.x, a.x, a.x);
  const double4 ay = (double4)(b.y, a.y, a.y, a.y);
  const double4 az = (double4)(b.z, a.z, a.z, a.z);
  const double4 ux = (double4)(d.x, c.x, d.x, b.x) - ax;
  const double4 uy = (double4)(d.y, c.y, d.y, b.y) - ay;
  const double4 uz = (double4)(d.z, c.z, d.z, b.z) - az;
  const double4 vx = (double4)(c.x, d.x, b.x, c.x) - ax;
  const double4 vy = (double4)(c.y, d.y, b.y, c.y) - ay;
  const double4 vz = (double4)(c.z, d.z, b.z, c.z) - az;
  const double4 nx = uy * vz - uz * vy;
  const double4 ny = uz * vx - ux * vz;
  const double4 nz = ux * vy - uy * vx;
  const double4 scale = x.s1 / nx;
  const double4 perRow = ny * scale * y.s6;
  const double4 perLayer = nz * scale * z.s6;
  const Box* box = &t->box;
  const double4 position = (ax - x.s0) * x.s1 - x.s2 + 1 -
    (ny * scale * (coordinateOf(y, box->begin.y) - ay) +
      nz * scale * (coordinateOf(z, box->begin.z) - az)) - (double)box->begin.x;
  const double area = ROUNDINGS * size.y * size.z;
  const double4 error = 2 * (errors.x + (area * size.x + SMALLEST) * fabs(scale)) +
    fabs(perRow) * errors.y + fabs(perLayer) * errors.z +
    0x1p-21 * (fabs(position) + fabs(perRow) * (double)(box->end.y - box->begin.y) +
      fabs(perLayer) * (double)(box->end.z - box->begin.z));
  if (!all((fabs(nx) > area + SMALLEST) & (error < 0.25)))
  {
    return DOUBT;
  }
  t->position = convert_float4(position);
  t->perRow = convert_float4(perRow);
  t->perLayer = convert_float4(perLayer);
  const int4 forward = convert_int4(nx > 0);
  t->notBegin = select((float4)(-BEYOND), (float4)(0), forward);
  t->notEnd = select((float4)(0), (float4)(BEYOND), forward);
  const double2 worst = fmax(error.lo, error.hi);
  t->certainty = (float)(0.5 - 0x1p-20 - fmax(worst.x, worst.y));
  return ROWS;
}

// Whether the box's only sample is inside: see CellLanes.h.
INLINE int setSample(const Box* box, double3 a, double3 b, double3 c, double3 d, double3 size,
  Axis x, Axis y, Axis z)
{
  const double4 px = (double4)(a.x, b.x, c.x, d.x) - coordinateOf(x, box->begin.x);
  const double4 py = (double4)(a.y, b.y, c.y, d.y) - coordinateOf(y, box->begin.y);
  const double4 pz = (double4)(a.z, b.z, c.z, d.z) - coordinateOf(z, box->begin.z);
  // Minors of each corner with the next, and with that after it.
  const double4 next = px * py.yzwx - px.yzwx * py;
  const double4 second = px * py.zwxy - px.zwxy * py;
  const double4 turned = pz.yzwx * next.zwxy - pz.zwxy * second.yzwx + pz.wxyz * next.yzwx;
  const double4 weights = turned * (double4)(1, -1, 1, -1);
  const double4 bound = ROUNDINGS * size.x * size.y * size.z + SMALLEST * (1 + size.z);
  const int4 above = convert_int4(weights > bound);
  const int4 below = convert_int4(weights < -bound);
  return stateOf(anyOf(above) & anyOf(below), allOf(above) | allOf(below));
}

// Sets the box of samples: LatticeAxis::range() along all axes. A dummy fourth axis with one sample
// fills the lanes.
INLINE int setBox(Cell* t, const double3* p, Axis x, Axis y, Axis z)
{
  const double3 leastOfTwo = LEAST(p[0], p[1]);
  const double3 leastOfOthers = LEAST(p[2], p[3]);
  const double3 mostOfTwo = MOST(p[0], p[1]);
  const double3 mostOfOthers = MOST(p[2], p[3]);
  const double3 low = LEAST(leastOfTwo, leastOfOthers);
  const double3 high = MOST(mostOfTwo, mostOfOthers);
  t->size = high - low;
  t->error = MOST(-low, high) * (double3)(x.s4, y.s4, z.s4) + (double3)(x.s5, y.s5, z.s5);
  const Axis single = (Axis)(0, 1, 0, 0, 0, 0, 1, 1, 0, 1, 1, 0, 0, 0, 0, 0);
  const Axes axes = axesOf(x, y, z, single);
  t->box.begin = countBefore(&axes, (double4)(low, 0));
  t->box.end = countUpTo(&axes, (double4)(high, 0));
  t->isSample = -allOf(t->box.end - t->box.begin == 1);
  const int4 sure = convert_int4((double4)(t->error, 0) < 0.5);
  return stateOf(anyOf(sure & (t->box.begin >= t->box.end)), allOf(sure));
}

INLINE int setRows(Cell* t, const double3* p, Axis x, Axis y, Axis z)
{
  double3 a = p[0];
  double3 b = p[1];
  const double3 c = p[2];
  const double3 d = p[3];
  const double3 size = t->size;
  if (t->isSample)
  {
    return setSample(&t->box, a, b, c, d, size, x, y, z);
  }
  const double3 u = b - a;
  const double3 v = c - a;
  const double3 w = d - a;
  const double volume = w.x * (u.y * v.z - u.z * v.y) + w.y * (u.z * v.x - u.x * v.z) +
    w.z * (u.x * v.y - u.y * v.x);
  // False for non-finite coordinates.
  if (!(fabs(volume) > ROUNDINGS * size.x * size.y * size.z + SMALLEST))
  {
    return DOUBT;
  }
  if (volume < 0)
  {
    const double3 swap = a;
    a = b;
    b = swap;
  }
  return setFaces(t, a, b, c, d, size, t->error, x, y, z);
}

// The rows first..last - 1 of the box, at most ROWS_AT_ONCE, counted from the first of its first
// layer.
INLINE int cellSpans(const Cell* cell, int first, int last, Axis x, Axis y, Spans* spans)
{
  const Box* box = &cell->box;
  if (cell->isSample)
  {
    spans->begin[0] = box->begin.x;
    spans->end[0] = box->end.x;
    spans->row[0] = box->begin.y;
    spans->layer[0] = box->begin.z;
    return ROWS;
  }
  const float depth = (float)(box->end.y - box->begin.y);
  const float8 number = (float8)(0, 1, 2, 3, 4, 5, 6, 7) + (float)first;
  const int8 layer = convert_int8((number + 0.5f) * (1 / depth));
  const float8 up = convert_float8(layer);
  const float8 along = number - up * depth;
  const float width = (float)(box->end.x - box->begin.x) + 0.5f;
  const float position[4] = { cell->position.x, cell->position.y, cell->position.z,
    cell->position.w };
  const float perRow[4] = { cell->perRow.x, cell->perRow.y, cell->perRow.z, cell->perRow.w };
  const float perLayer[4] = { cell->perLayer.x, cell->perLayer.y, cell->perLayer.z,
    cell->perLayer.w };
  const float notBegin[4] = { cell->notBegin.x, cell->notBegin.y, cell->notBegin.z,
    cell->notBegin.w };
  const float notEnd[4] = { cell->notEnd.x, cell->notEnd.y, cell->notEnd.z, cell->notEnd.w };
  float8 begin = (float8)(0.5f);
  float8 end = (float8)(width);
  for (int i = 0; i < 4; ++i)
  {
    const float8 crossing = position[i] - (perRow[i] * along + perLayer[i] * up);
    const float8 from = crossing + notBegin[i];
    const float8 to = crossing + notEnd[i];
    begin = MOST(from, begin);
    end = LEAST(to, end);
  }
  begin = LEAST(begin, (float8)(width));
  end = MOST(end, (float8)(0.5f));
  const int8 begins = convert_int8(begin);
  const int8 ends = convert_int8(end);
  const int8 sure = (fabs(begin - convert_float8(begins) - 0.5f) < cell->certainty) &
    (fabs(end - convert_float8(ends) - 0.5f) < cell->certainty);
  vstore8(begins + box->begin.x, 0, spans->begin);
  vstore8(ends + box->begin.x, 0, spans->end);
  vstore8(convert_int8(along) + box->begin.y, 0, spans->row);
  vstore8(layer + box->begin.z, 0, spans->layer);
  return any(~sure & (begins <= ends + 1) & (number < (float)last)) ? DOUBT : ROWS;
}

#endif
