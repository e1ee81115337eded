// SPDX-License-Identifier: BSD-3-Clause
// The lattice of samples and the mesh, for the kernels of SampleCells.cl.
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

// A LatticeAxis; s0 to s7 are min, inverse, first, limit, error scale, error offset, delta, size.
typedef double8 Axis;

double coordinateOf(Axis axis, int i)
{
  return axis.s0 + (i + axis.s2) * axis.s6;
}
double4 coordinatesOf(Axis axis, int4 i)
{
  return axis.s0 + (convert_double4(i) + axis.s2) * axis.s6;
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
  double4 delta;
  double4 last; // index of the last sample
} Axes;

INLINE Axes axesOf(Axis a, Axis b, Axis c, Axis d)
{
  Axes axes;
  axes.origin = (double4)(a.s0, b.s0, c.s0, d.s0);
  axes.inverse = (double4)(a.s1, b.s1, c.s1, d.s1);
  axes.first = (double4)(a.s2, b.s2, c.s2, d.s2);
  axes.delta = (double4)(a.s6, b.s6, c.s6, d.s6);
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
  return axes->origin + (convert_double4(i) + axes->first) * axes->delta;
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

int idOf(const Mesh* mesh, long cell, int corner)
{
  return (int)mesh->ids[cell * CORNERS + corner];
}
double3 pointOf(const Mesh* mesh, int id)
{
  global const Real* p = mesh->points + 3 * (long)id;
  return CORNERS == 4 ? (double3)(p[0], p[1], p[2]) : (double3)(p[mesh->u], p[mesh->v], 0);
}
void loadIds(const Mesh* mesh, long cell, int* ids)
{
  for (int corner = 0; corner < CORNERS; ++corner)
  {
    ids[corner] = idOf(mesh, cell, corner);
  }
}
void loadPoints(const Mesh* mesh, const int* ids, double3* points)
{
#pragma unroll
  for (int corner = 0; corner < CORNERS; ++corner)
  {
    points[corner] = pointOf(mesh, ids[corner]);
  }
}
