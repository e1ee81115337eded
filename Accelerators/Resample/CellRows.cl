// SPDX-License-Identifier: BSD-3-Clause
// Which samples of its rows a cell answers: TriangleRows.h and TetrahedronRows.h for a device, as far
// as rounding could not change a count. After LatticeAndMesh.cl.
#define NOTHING 0
#define ROWS 1
#define DOUBT 2

typedef struct
{
  int columnBegin;
  int columnEnd;
  int rowBegin;
  int rowEnd;
  int layerBegin;
  int layerEnd;
} Box;

// What range() of LatticeAxis gives along three axes at once, of which the third of a triangle is not
// looked at; DOUBT if that is not certain.
INLINE int setBox(Box* box, double3 low, double3 high, double3 error, Axis x, Axis y, Axis z)
{
  const double3 origin = (double3)(x.s0, y.s0, z.s0);
  const double3 inverse = (double3)(x.s1, y.s1, z.s1);
  const double3 shift = 1 - (double3)(x.s2, y.s2, z.s2);
  const double3 limit = (double3)(x.s3, y.s3, z.s3);
  const double3 first = fmin(limit, fmax(0.5, (low - origin) * inverse + shift));
  const double3 last = fmin(limit, fmax(0.5, (high - origin) * inverse + shift));
  const int3 begin = convert_int3(first);
  const int3 end = convert_int3(last);
  const long3 sure = (fabs(first - convert_double3(begin) - 0.5) < 0.5 - error) &
    (fabs(last - convert_double3(end) - 0.5) < 0.5 - error);
  const int3 empty = convert_int3(sure) & (begin >= end);
  box->columnBegin = begin.x;
  box->columnEnd = end.x;
  box->rowBegin = begin.y;
  box->rowEnd = end.y;
#if CORNERS == 3
  box->layerBegin = 0;
  box->layerEnd = 1;
  return empty.x | empty.y ? NOTHING : sure.x & sure.y ? ROWS : DOUBT;
#else
  box->layerBegin = begin.z;
  box->layerEnd = end.z;
  return any(empty) ? NOTHING : all(sure) ? ROWS : DOUBT;
#endif
}

typedef struct
{
  double2 low;
  double slope;
} Edge;

typedef struct
{
  Edge edges[3]; // the long one, the short ones below and above the middle corner
  double middle;
  double top;
  double error;
  int longIsLeft;
  Box box;
} Triangle;

Edge edgeOf(double3 low, double3 high)
{
  Edge edge;
  edge.low = low.xy;
  edge.slope = (high.x - low.x) / (high.y - low.y);
  return edge;
}

// Without branches, of which half would be mispredicted.
void lowFirst(double3* a, double3* b)
{
  const bool swap = b->y < a->y;
  const double3 low = swap ? *b : *a;
  const double3 high = swap ? *a : *b;
  *a = low;
  *b = high;
}

INLINE int setTriangle(Triangle* t, double3 a, double3 b, double3 c, Axis u, Axis v)
{
  const double left = fmin(fmin(a.x, b.x), c.x);
  const double right = fmax(fmax(a.x, b.x), c.x);
  t->error = errorOf(u, fmax(-left, right));
  lowFirst(&a, &b);
  lowFirst(&b, &c);
  lowFirst(&a, &b);
  const double3 error = (double3)(t->error, errorOf(v, fmax(-a.y, c.y)), 0);
  const int box =
    setBox(&t->box, (double3)(left, a.y, 0), (double3)(right, c.y, 0), error, u, v, v);
  if (box == NOTHING)
  {
    return NOTHING;
  }
  // orientation(a, c, b) with the filter of Orientation.h.
  const double l = (a.x - b.x) * (c.y - b.y);
  const double r = (a.y - b.y) * (c.x - b.x);
  const double bound = 3.3306690738754716e-16 * (fabs(l) + fabs(r)) + 1e-300;
  // Coordinates that are not finite make that false.
  if (box == DOUBT || !(fabs(l - r) > bound))
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

INLINE int triangleSpan(const Triangle* t, int row, Axis u, Axis v, int* begin, int* end)
{
  const double y = coordinateOf(v, row);
  const Edge* other = &t->edges[y >= t->middle ? 2 : 1];
  const Edge* whole = &t->edges[0];
  const double xLong = whole->low.x + (y - whole->low.y) * whole->slope;
  const double xOther = other->low.x + (y - other->low.y) * other->slope;
  const double atLong = placeOf(u, xLong);
  const double atOther = placeOf(u, xOther);
  if (!(y < t->top) || !isfinite(xLong + xOther) || !certain(atLong, t->error) ||
    !certain(atOther, t->error))
  {
    return DOUBT;
  }
  *begin = t->longIsLeft ? (int)atLong : (int)atOther;
  *end = t->longIsLeft ? (int)atOther : (int)atLong;
  return ROWS;
}

// Faces side by side: where each crosses the first row, in steps from the box's first column, and how
// many steps before that for each row and each layer. In single precision: see TetrahedronLanes.h.
typedef struct
{
  float4 place;
  float4 perRow;
  float4 perLayer;
  float4 notBegin;
  float4 notEnd;
  float certainty;
  Box box;
} Tetrahedron;

#define BEYOND 1e30f

// The corners a, b, c of the faces turn counter-clockwise seen from inside.
INLINE int setFaces(Tetrahedron* t, const double3 a, const double3 b, const double3 c, const double3 d,
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
  const double4 place = (ax - x.s0) * x.s1 - x.s2 + 1 -
    (ny * scale * (coordinateOf(y, box->rowBegin) - ay) +
      nz * scale * (coordinateOf(z, box->layerBegin) - az)) - (double)box->columnBegin;
  const double area = ROUNDINGS * size.y * size.z;
  const double4 error = 2 * (errors.x + (area * size.x + SMALLEST) * fabs(scale)) +
    fabs(perRow) * errors.y + fabs(perLayer) * errors.z +
    0x1p-21 * (fabs(place) + fabs(perRow) * (double)(box->rowEnd - box->rowBegin) +
      fabs(perLayer) * (double)(box->layerEnd - box->layerBegin));
  if (!all((fabs(nx) > area + SMALLEST) & (error < 0.25)))
  {
    return DOUBT;
  }
  t->place = convert_float4(place);
  t->perRow = convert_float4(perRow);
  t->perLayer = convert_float4(perLayer);
  const int4 forward = convert_int4(nx > 0);
  t->notBegin = select((float4)(-BEYOND), (float4)(0), forward);
  t->notEnd = select((float4)(0), (float4)(BEYOND), forward);
  const double2 worst = fmax(error.lo, error.hi);
  t->certainty = (float)(0.5 - 0x1p-20 - fmax(worst.x, worst.y));
  return ROWS;
}

INLINE int setTetrahedron(Tetrahedron* t, double3 a, double3 b, double3 c, double3 d, Axis x, Axis y, Axis z)
{
  const double3 low = fmin(fmin(a, b), fmin(c, d));
  const double3 high = fmax(fmax(a, b), fmax(c, d));
  const double3 reach = fmax(-low, high);
  const double3 error =
    (double3)(errorOf(x, reach.x), errorOf(y, reach.y), errorOf(z, reach.z));
  const int box = setBox(&t->box, low, high, error, x, y, z);
  if (box == NOTHING)
  {
    return NOTHING;
  }
  const double3 size = high - low;
  const double3 u = b - a;
  const double3 v = c - a;
  const double3 w = d - a;
  const double volume = w.x * (u.y * v.z - u.z * v.y) + w.y * (u.z * v.x - u.x * v.z) +
    w.z * (u.x * v.y - u.y * v.x);
  // Coordinates that are not finite make that false.
  if (box == DOUBT || !(fabs(volume) > ROUNDINGS * size.x * size.y * size.z + SMALLEST))
  {
    return DOUBT;
  }
  if (volume < 0)
  {
    const double3 swap = a;
    a = b;
    b = swap;
  }
  return setFaces(t, a, b, c, d, size, error, x, y, z);
}

// The spans of one cell.
#if CORNERS == 3
typedef Triangle Cell;
#else
typedef Tetrahedron Cell;
#endif

INLINE int setCell(Cell* cell, const Mesh* mesh, long i, Axis x, Axis y, Axis z)
{
  const double3 a = pointOf(mesh, idOf(mesh, i, 0));
  const double3 b = pointOf(mesh, idOf(mesh, i, 1));
  const double3 c = pointOf(mesh, idOf(mesh, i, 2));
#if CORNERS == 3
  return setTriangle(cell, a, b, c, x, y);
#else
  return setTetrahedron(cell, a, b, c, pointOf(mesh, idOf(mesh, i, 3)), x, y, z);
#endif
}

#define ROWS_AT_ONCE 8

// What rows of a cell answer; a row without samples does not begin before it ends.
typedef struct
{
  int begin[ROWS_AT_ONCE];
  int end[ROWS_AT_ONCE];
  int row[ROWS_AT_ONCE];
  int layer[ROWS_AT_ONCE];
} Spans;

// The rows first..last - 1, at most eight, counted from the first of the box's first layer.
INLINE int cellSpans(const Cell* cell, int first, int last, Axis x, Axis y, Spans* spans)
{
  const Box* box = &cell->box;
#if CORNERS == 3
  int state = ROWS;
  for (int i = 0; i < last - first && i < ROWS_AT_ONCE; ++i)
  {
    spans->row[i] = box->rowBegin + first + i;
    spans->layer[i] = 0;
    const int told = triangleSpan(cell, spans->row[i], x, y, &spans->begin[i], &spans->end[i]);
    state = told == DOUBT ? DOUBT : state;
  }
  return state;
#else
  const float depth = (float)(box->rowEnd - box->rowBegin);
  const float8 number = (float8)(0, 1, 2, 3, 4, 5, 6, 7) + (float)first;
  const int8 layer = convert_int8((number + 0.5f) * (1 / depth));
  const float8 up = convert_float8(layer);
  const float8 along = number - up * depth;
  const float width = (float)(box->columnEnd - box->columnBegin) + 0.5f;
  const float place[4] = { cell->place.x, cell->place.y, cell->place.z, cell->place.w };
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
    const float8 crossing = place[i] - (perRow[i] * along + perLayer[i] * up);
    begin = fmax(crossing + notBegin[i], begin);
    end = fmin(crossing + notEnd[i], end);
  }
  begin = fmin(begin, (float8)(width));
  end = fmax(end, (float8)(0.5f));
  const int8 begins = convert_int8(begin);
  const int8 ends = convert_int8(end);
  const int8 sure = (fabs(begin - convert_float8(begins) - 0.5f) < cell->certainty) &
    (fabs(end - convert_float8(ends) - 0.5f) < cell->certainty);
  vstore8(begins + box->columnBegin, 0, spans->begin);
  vstore8(ends + box->columnBegin, 0, spans->end);
  vstore8(convert_int8(along) + box->rowBegin, 0, spans->row);
  vstore8(layer + box->layerBegin, 0, spans->layer);
  return any(~sure & (begins <= ends + 1) & (number < (float)last)) ? DOUBT : ROWS;
#endif
}

// How many rows a cell's box has.
int rowsOf(const Box* box)
{
  return (box->rowEnd - box->rowBegin) * (box->layerEnd - box->layerBegin);
}

// How many samples a cell's box has.
long samplesOf(const Box* box)
{
  return (long)(box->columnEnd - box->columnBegin) * (box->rowEnd - box->rowBegin) *
    (box->layerEnd - box->layerBegin);
}

// Of a row's first sample.
long placeOfRow(int row, int layer, Axis x, Axis y)
{
  return ((long)layer * (long)y.s7 + row) * (long)x.s7;
}
