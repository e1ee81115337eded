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

// What range() of LatticeAxis gives; DOUBT if that is not certain.
int rangeOf(Axis axis, double low, double high, double error, int* begin, int* end)
{
  const double first = placeOf(axis, low);
  const double last = placeOf(axis, high);
  *begin = (int)first;
  *end = (int)last;
  return !certain(first, error) || !certain(last, error) ? DOUBT
    : *begin < *end                                      ? ROWS
                                                         : NOTHING;
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

int setTriangle(Triangle* t, double3 a, double3 b, double3 c, Axis u, Axis v)
{
  if (!(isfinite(a.x) && isfinite(a.y) && isfinite(b.x) && isfinite(b.y) && isfinite(c.x) &&
        isfinite(c.y)))
  {
    return NOTHING;
  }
  const double left = fmin(fmin(a.x, b.x), c.x);
  const double right = fmax(fmax(a.x, b.x), c.x);
  t->error = errorOf(u, fmax(-left, right));
  const int columns = rangeOf(u, left, right, t->error, &t->box.columnBegin, &t->box.columnEnd);
  if (columns == NOTHING)
  {
    return NOTHING;
  }
  double3 swap;
  if (b.y < a.y)
  {
    swap = a; a = b; b = swap;
  }
  if (c.y < b.y)
  {
    swap = b; b = c; c = swap;
  }
  if (b.y < a.y)
  {
    swap = a; a = b; b = swap;
  }
  const int rows = rangeOf(
    v, a.y, c.y, errorOf(v, fmax(-a.y, c.y)), &t->box.rowBegin, &t->box.rowEnd);
  if (rows == NOTHING)
  {
    return NOTHING;
  }
  t->box.layerBegin = 0;
  t->box.layerEnd = 1;
  // orientation(a, c, b) with the filter of Orientation.h.
  const double l = (a.x - b.x) * (c.y - b.y);
  const double r = (a.y - b.y) * (c.x - b.x);
  const double bound = 3.3306690738754716e-16 * (fabs(l) + fabs(r)) + 1e-300;
  if (columns == DOUBT || rows == DOUBT || !(fabs(l - r) > bound))
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

int triangleSpan(const Triangle* t, int row, Axis u, Axis v, int* begin, int* end)
{
  const double y = coordinateOf(v, row);
  const Edge* other = &t->edges[y >= t->middle ? 2 : 1];
  const Edge* whole = &t->edges[0];
  const double xLong = whole->low.x + (y - whole->low.y) * whole->slope;
  const double xOther = other->low.x + (y - other->low.y) * other->slope;
  const double atLong = placeOf(u, xLong);
  const double atOther = placeOf(u, xOther);
  if (!(y < t->top) || !isfinite(xLong) || !isfinite(xOther) || !certain(atLong, t->error) || !certain(atOther, t->error))
  {
    return DOUBT;
  }
  *begin = t->longIsLeft ? (int)atLong : (int)atOther;
  *end = t->longIsLeft ? (int)atOther : (int)atLong;
  return ROWS;
}

typedef struct
{
  double place;
  double perY;
  double perZ;
  double y;
  double z;
  double error;
  int direction;
} Face;

typedef struct
{
  Face faces[4];
  Box box;
} Tetrahedron;

int setFace(Face* face, double3 a, double3 b, double3 c, double3 size, double reach, Axis x)
{
  const double3 u = b - a;
  const double3 v = c - a;
  const double nx = u.y * v.z - u.z * v.y;
  const double ny = u.z * v.x - u.x * v.z;
  const double nz = u.x * v.y - u.y * v.x;
  const double scale = x.s1 / nx;
  face->place = (a.x - x.s0) * x.s1 - x.s2 + 1;
  face->perY = ny * scale;
  face->perZ = nz * scale;
  face->y = a.y;
  face->z = a.z;
  face->direction = nx > 0 ? 1 : -1;
  face->error = errorOf(x, reach) + (ROUNDINGS * size.x * size.y * size.z + SMALLEST) * fabs(scale);
  return fabs(nx) > ROUNDINGS * size.y * size.z + SMALLEST &&
      isfinite(face->error + face->perY + face->perZ)
    ? ROWS
    : DOUBT;
}

int setTetrahedron(Tetrahedron* t, double3 a, double3 b, double3 c, double3 d, Axis x, Axis y, Axis z)
{
  const double3 low = fmin(fmin(a, b), fmin(c, d));
  const double3 high = fmax(fmax(a, b), fmax(c, d));
  const double3 check = (a - a) + (b - b) + (c - c) + (d - d);
  if (check.x != 0 || check.y != 0 || check.z != 0)
  {
    return NOTHING;
  }
  const double3 reach = fmax(-low, high);
  Box* box = &t->box;
  const int columns = rangeOf(x, low.x, high.x, errorOf(x, reach.x), &box->columnBegin, &box->columnEnd);
  const int rows = rangeOf(y, low.y, high.y, errorOf(y, reach.y), &box->rowBegin, &box->rowEnd);
  const int layers = rangeOf(z, low.z, high.z, errorOf(z, reach.z), &box->layerBegin, &box->layerEnd);
  if (columns == NOTHING || rows == NOTHING || layers == NOTHING)
  {
    return NOTHING;
  }
  const double3 size = high - low;
  const double3 u = b - a;
  const double3 v = c - a;
  const double3 w = d - a;
  const double volume = w.x * (u.y * v.z - u.z * v.y) + w.y * (u.z * v.x - u.x * v.z) +
    w.z * (u.x * v.y - u.y * v.x);
  if (columns == DOUBT || rows == DOUBT || layers == DOUBT ||
    !(fabs(volume) > ROUNDINGS * size.x * size.y * size.z + SMALLEST))
  {
    return DOUBT;
  }
  if (volume < 0)
  {
    const double3 swap = a;
    a = b;
    b = swap;
  }
  const int known = setFace(&t->faces[0], b, d, c, size, reach.x, x) == ROWS &&
    setFace(&t->faces[1], a, c, d, size, reach.x, x) == ROWS &&
    setFace(&t->faces[2], a, d, b, size, reach.x, x) == ROWS &&
    setFace(&t->faces[3], a, b, c, size, reach.x, x) == ROWS;
  return known ? ROWS : DOUBT;
}

int tetrahedronSpan(
  const Tetrahedron* t, int row, int layer, Axis x, Axis y, Axis z, int* begin, int* end)
{
  *begin = t->box.columnBegin;
  *end = t->box.columnEnd;
  bool known = true;
  for (int i = 0; i < 4; ++i)
  {
    const Face* face = &t->faces[i];
    const double place = clampPlace(x, face->place - (face->perY * (coordinateOf(y, row) - face->y) +
      face->perZ * (coordinateOf(z, layer) - face->z)));
    known = known && certain(place, face->error);
    const int count = (int)place;
    *begin = face->direction > 0 ? max(*begin, count) : *begin;
    *end = face->direction > 0 ? *end : min(*end, count);
  }
  return known ? ROWS : DOUBT;
}

// The spans of one cell.
#if CORNERS == 3
typedef Triangle Cell;
#else
typedef Tetrahedron Cell;
#endif

int setCell(Cell* cell, const Mesh* mesh, long i, Axis x, Axis y, Axis z)
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

int cellSpan(const Cell* cell, int row, int layer, Axis x, Axis y, Axis z, int* begin, int* end)
{
#if CORNERS == 3
  return triangleSpan(cell, row, x, y, begin, end);
#else
  return tetrahedronSpan(cell, row, layer, x, y, z, begin, end);
#endif
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
