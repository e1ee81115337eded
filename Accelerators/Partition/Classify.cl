// SPDX-License-Identifier: BSD-3-Clause
// Algorithm 5 of the dissertation: candidate partitions of cells by bounding boxes, counted, listed
// and tested. A test answers APART or MEET only where rounding cannot have changed it; the caller
// decides the others exactly. Host side: ClassifyOnDevice.cxx.
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
#pragma OPENCL FP_CONTRACT OFF

#define APART 0
#define MEET 1
#define UNDECIDED 2

// 2^-53, the maximum relative error of one rounding.
#define EPSILON 0x1p-53
// More than the error of all of an expression's products below the normal range.
#define UNDERFLOW 1e-300

typedef struct
{
  double low[3];
  double high[3];
} Box;

// A tiling's arrays; see BoxTiling.h.
typedef struct
{
  int dimension;
  int axes;        // for a tree
  int children;    // children of a tree's inner node; 0 for a grid
  int3 counts;     // for a grid
  global const double* cuts;
  global const int* nodes;
  global const double* middles;
  double low[3];   // the domain
  double high[3];
} Tiling;

// ---- Bounding boxes

// False if a coordinate is not finite.
bool boundsOf(global const double* cell, int corners, int components, int dimension, Box* box)
{
  double check = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    double low = axis < dimension ? cell[axis] : 0.0;
    double high = low;
    for (int i = 0; i < corners && axis < dimension; ++i)
    {
      const double value = cell[i * components + axis];
      low = fmin(low, value);
      high = fmax(high, value);
      check += value * 0.0;
    }
    box->low[axis] = low;
    box->high[axis] = high;
  }
  return check == 0.0;
}

bool insideDomain(const Tiling* tiling, const Box* box)
{
  bool inside = true;
  for (int axis = 0; axis < tiling->dimension; ++axis)
  {
    inside = inside && tiling->low[axis] <= box->low[axis] && box->high[axis] <= tiling->high[axis];
  }
  return inside;
}

bool meetsDomain(const Tiling* tiling, const Box* box)
{
  bool meets = true;
  for (int axis = 0; axis < tiling->dimension; ++axis)
  {
    meets = meets && tiling->low[axis] <= box->high[axis] && box->low[axis] <= tiling->high[axis];
  }
  return meets;
}

// ---- Candidates: their number, the last one, and all of them if `ids` is given, ascending

// The index of the first of n ascending values that is not below (strict: that is above) the given
// one.
int firstFrom(global const double* values, int n, double value, bool strict)
{
  int first = 0;
  while (n > 0)
  {
    const int step = n / 2;
    const double middle = values[first + step];
    const bool below = strict ? middle <= value : middle < value;
    first = below ? first + step + 1 : first;
    n = below ? n - step - 1 : step;
  }
  return first;
}

int2 rangeAlong(global const double* cuts, int n, double low, double high)
{
  return (int2)(firstFrom(cuts + 1, n, low, false), firstFrom(cuts, n, high, true) - 1);
}

int listInGrid(const Tiling* tiling, const Box* box, global int* ids, int* last)
{
  const int3 n = tiling->counts;
  global const double* cuts = tiling->cuts;
  const int2 x = rangeAlong(cuts, n.x, box->low[0], box->high[0]);
  cuts += n.x + 1;
  const int2 y = rangeAlong(cuts, n.y, box->low[1], box->high[1]);
  cuts += n.y + 1;
  const int2 z = rangeAlong(cuts, n.z, box->low[2], box->high[2]);
  for (int k = z.x; ids != 0 && k <= z.y; ++k)
  {
    for (int j = y.x; j <= y.y; ++j)
    {
      for (int i = x.x; i <= x.y; ++i)
      {
        *ids++ = i + n.x * (j + n.y * k);
      }
    }
  }
  *last = x.y + n.x * (y.y + n.y * z.y);
  return max(0, x.y - x.x + 1) * max(0, y.y - y.x + 1) * max(0, z.y - z.x + 1);
}

bool childMeets(const Tiling* tiling, int node, int which, const Box* box)
{
  bool meets = true;
  for (int axis = 0; axis < 3; ++axis)
  {
    if ((tiling->axes >> axis & 1) != 0)
    {
      const double middle = tiling->middles[3 * (long)node + axis];
      meets = meets && ((which & 1) != 0 ? box->high[axis] >= middle : box->low[axis] <= middle);
      which >>= 1;
    }
  }
  return meets;
}

int listInTree(const Tiling* tiling, const Box* box, global int* ids, int* last)
{
  // As in BoxTiling::visitTree: 7 siblings on each of 24 levels.
  int stack[7 * 24 + 1];
  int size = 0;
  int count = 0;
  if (meetsDomain(tiling, box))
  {
    stack[size++] = 0;
  }
  while (size > 0)
  {
    const int node = stack[--size];
    const int child = tiling->nodes[node];
    if (child < 0)
    {
      *last = -1 - child;
      if (ids != 0)
      {
        ids[count] = *last;
      }
      ++count;
      continue;
    }
    for (int which = tiling->children - 1; which >= 0; --which)
    {
      if (childMeets(tiling, node, which, box))
      {
        stack[size++] = child + which;
      }
    }
  }
  return count;
}

int listOf(const Tiling* tiling, const Box* box, global int* ids, int* last)
{
  return tiling->children == 0 ? listInGrid(tiling, box, ids, last)
                               : listInTree(tiling, box, ids, last);
}

// ---- Separating axes, with bounds of the rounding errors

// Compares the intervals of cell and box along an axis, each end with an error of at most `error`.
int compareAlongAxis(double cellLow, double cellHigh, double boxLow, double boxHigh, double error)
{
  // After an overflow the result is undecided.
  if (!isfinite(error) || !isfinite(cellLow + cellHigh) || !isfinite(boxLow + boxHigh))
  {
    return UNDECIDED;
  }
  if (boxLow - cellHigh > error || cellLow - boxHigh > error)
  {
    return APART;
  }
  return cellHigh - boxLow >= error && boxHigh - cellLow >= error ? MEET : UNDECIDED;
}

int both(int first, int second)
{
  if (first == APART || second == APART)
  {
    return APART;
  }
  return first == MEET && second == MEET ? MEET : UNDECIDED;
}

// Compares c and d (which may be c again) with the rectangle along the normal of the line through a
// and b. A value ex (y - ay) - ey (x - ax) is off by 4 EPSILON of the sum of its products'
// magnitudes, and a difference of two values rounds once more; 12 are allowed for at each end.
int compareAcrossEdge(double2 a, double2 b, double2 c, double2 d, double2 low, double2 high)
{
  const double2 e = b - a;
  const double cValue = e.x * (c.y - a.y) - e.y * (c.x - a.x);
  const double dValue = e.x * (d.y - a.y) - e.y * (d.x - a.x);
  const double2 near = low - a;
  const double2 far = high - a;
  const double boxHigh = fmax(e.x * near.y, e.x * far.y) - fmin(e.y * near.x, e.y * far.x);
  const double boxLow = fmin(e.x * near.y, e.x * far.y) - fmax(e.y * near.x, e.y * far.x);
  const double x = fmax(fmax(fabs(near.x), fabs(far.x)), fmax(fabs(c.x - a.x), fabs(d.x - a.x)));
  const double y = fmax(fmax(fabs(near.y), fabs(far.y)), fmax(fabs(c.y - a.y), fabs(d.y - a.y)));
  const double error = 24.0 * EPSILON * (fabs(e.x) * y + fabs(e.y) * x) + UNDERFLOW;
  return compareAlongAxis(fmin(0.0, fmin(cValue, dValue)), fmax(0.0, fmax(cValue, dValue)), boxLow,
    boxHigh, error);
}

// Compares d with the box along the normal of the plane through a, b and c. A component of the
// normal is off by 4 EPSILON of its products' magnitudes, a value by 8 EPSILON of the products of
// these and the reach, a difference of two a little more; 24 are allowed for at each end. A
// component of the normal may lose 2^-1073 below the normal range, which the reach multiplies.
int compareAcrossFace(double3 a, double3 b, double3 c, double3 d, double3 low, double3 high)
{
  const double3 u = b - a;
  const double3 v = c - a;
  const double3 w = d - a;
  const double3 left = u.yzx * v.zxy;
  const double3 right = u.zxy * v.yzx;
  const double3 n = left - right;
  const double3 size = fabs(left) + fabs(right);
  const double3 near = low - a;
  const double3 far = high - a;
  const double3 most = fmax(n * near, n * far);
  const double3 least = fmin(n * near, n * far);
  const double3 reach_ = fmax(fmax(fabs(near), fabs(far)), fabs(w));
  const double value = n.x * w.x + n.y * w.y + n.z * w.z;
  const double error =
    48.0 * EPSILON * (size.x * reach_.x + size.y * reach_.y + size.z * reach_.z) +
    UNDERFLOW * (1.0 + reach_.x + reach_.y + reach_.z);
  return compareAlongAxis(fmin(0.0, value), fmax(0.0, value), least.x + least.y + least.z,
    most.x + most.y + most.z, error);
}

bool holds(double2 low, double2 high, double2 p)
{
  return low.x <= p.x && p.x <= high.x && low.y <= p.y && p.y <= high.y;
}

// The caller has checked, by exact comparisons, that the cell's bounding box meets the box.
int testInPlane(global const double* cell, int components, double2 low, double2 high)
{
  const double2 a = (double2)(cell[0], cell[1]);
  const double2 b = (double2)(cell[components], cell[components + 1]);
  const double2 c = (double2)(cell[2 * components], cell[2 * components + 1]);
  if (holds(low, high, a) || holds(low, high, b) || holds(low, high, c))
  {
    return MEET;
  }
  int verdict = compareAcrossEdge(a, b, c, c, low, high);
  verdict = both(verdict, compareAcrossEdge(b, c, a, a, low, high));
  return both(verdict, compareAcrossEdge(c, a, b, b, low, high));
}

int testEdges(const double2* p, double2 low, double2 high)
{
  int verdict = compareAcrossEdge(p[0], p[1], p[2], p[3], low, high);
  verdict = both(verdict, compareAcrossEdge(p[0], p[2], p[1], p[3], low, high));
  verdict = both(verdict, compareAcrossEdge(p[0], p[3], p[1], p[2], low, high));
  verdict = both(verdict, compareAcrossEdge(p[1], p[2], p[0], p[3], low, high));
  verdict = both(verdict, compareAcrossEdge(p[1], p[3], p[0], p[2], low, high));
  return both(verdict, compareAcrossEdge(p[2], p[3], p[0], p[1], low, high));
}

int testInSpace(global const double* cell, int corners, double3 low, double3 high)
{
  double3 p[4];
  for (int i = 0; i < 4; ++i)
  {
    // A triangle in space is treated as a flat tetrahedron.
    p[i] = vload3(min(i, corners - 1), cell);
    if (holds(low.xy, high.xy, p[i].xy) && low.z <= p[i].z && p[i].z <= high.z)
    {
      return MEET;
    }
  }
  int verdict = compareAcrossFace(p[0], p[1], p[2], p[3], low, high);
  verdict = both(verdict, compareAcrossFace(p[0], p[1], p[3], p[2], low, high));
  verdict = both(verdict, compareAcrossFace(p[0], p[2], p[3], p[1], low, high));
  verdict = both(verdict, compareAcrossFace(p[1], p[2], p[3], p[0], low, high));
  for (int turn = 0; turn < 3 && verdict != APART; ++turn) // projected along z, x and y
  {
    const double2 shadow[4] = { p[0].xy, p[1].xy, p[2].xy, p[3].xy };
    verdict = both(verdict, testEdges(shadow, low.xy, high.xy));
    for (int i = 0; i < 4; ++i)
    {
      p[i] = p[i].yzx;
    }
    low = low.yzx;
    high = high.yzx;
  }
  return verdict;
}

// ---- Kernels

#define TILING_ARGUMENTS                                                                           \
  int dimension, int axes, int children, int nx, int ny, int nz, global const double *cuts,        \
    global const int *nodes, global const double *middles, global const double *domain

#define TILING(name)                                                                               \
  const Tiling name = { dimension, axes, children, (int3)(nx, ny, nz), cuts, nodes, middles,       \
    { domain[0], domain[1], domain[2] }, { domain[3], domain[4], domain[5] } }

// Per cell: 1, and its owner, if it lies in one box; 0 if it lies outside or is not finite; else
// the number of boxes to test, or -1 for a single one if the bounding box extends beyond the
// domain.
kernel void countCandidates(TILING_ARGUMENTS, global const double* cells, int corners,
  int components, uint count, global int* counts, global int* owners)
{
  const size_t cell = get_global_id(0);
  if (cell >= count)
  {
    return;
  }
  TILING(tiling);
  Box box;
  int candidates = 0;
  int last = -1;
  if (boundsOf(cells + cell * corners * components, corners, components, dimension, &box))
  {
    candidates = listOf(&tiling, &box, 0, &last);
    candidates = candidates == 1 && !insideDomain(&tiling, &box) ? -1 : candidates;
  }
  counts[cell] = candidates;
  owners[cell] = last;
}

// Writes the candidates of the cells listed[i] to ids from starts[i] on, and the cell of each.
kernel void listCandidates(TILING_ARGUMENTS, global const double* cells, int corners,
  int components, uint count, global const uint* listed, global const ulong* starts,
  global int* ids, global uint* idCells)
{
  const size_t i = get_global_id(0);
  if (i >= count)
  {
    return;
  }
  TILING(tiling);
  const size_t cell = listed[i];
  Box box;
  int last;
  boundsOf(cells + cell * corners * components, corners, components, dimension, &box);
  const int candidates = listOf(&tiling, &box, ids + starts[i], &last);
  for (int k = 0; k < candidates; ++k)
  {
    idCells[starts[i] + k] = listed[i];
  }
}

// One work item per candidate, because cells have different numbers of them.
kernel void testCandidates(int dimension, global const double* boxes, global const double* cells,
  int corners, int components, ulong count, global const int* ids, global const uint* idCells,
  global uchar* verdicts)
{
  const size_t i = get_global_id(0);
  if (i >= count)
  {
    return;
  }
  global const double* cell = cells + (size_t)idCells[i] * corners * components;
  global const double* box = boxes + 6 * (size_t)ids[i];
  const double3 low = (double3)(box[0], box[1], box[2]);
  const double3 high = (double3)(box[3], box[4], box[5]);
  verdicts[i] = dimension == 2 ? testInPlane(cell, components, low.xy, high.xy)
                               : testInSpace(cell, corners, low, high);
}
