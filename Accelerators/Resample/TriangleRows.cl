// SPDX-License-Identifier: BSD-3-Clause
// TriangleRows.h for a device; the third axis is not looked at. After CellRows.cl.
#if CORNERS == 3

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
} Cell;

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

// What range() of LatticeAxis gives along both axes.
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
  // orientation(a, c, b) with the filter of Orientation.h.
  const double l = (a.x - b.x) * (c.y - b.y);
  const double r = (a.y - b.y) * (c.x - b.x);
  const double bound = 3.3306690738754716e-16 * (fabs(l) + fabs(r)) + 1e-300;
  // Coordinates that are not finite make that false.
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
