// SPDX-License-Identifier: BSD-3-Clause
// What the kernels of resampling share: the lattice of samples and the mesh.
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
#pragma OPENCL FP_CONTRACT OFF

#define ROUNDINGS 0x1p-47
#define SMALLEST 1e-280

// A LatticeAxis as s0 to s7: min, inverse, first, limit, error scale, error offset, delta, size.
typedef double8 Axis;

double clampPlace(Axis axis, double place)
{
  return fmin(axis.s3, fmax(0.5, place));
}
double placeOf(Axis axis, double v)
{
  return clampPlace(axis, (v - axis.s0) * axis.s1 - axis.s2 + 1);
}
double errorOf(Axis axis, double reach)
{
  return reach * axis.s4 + axis.s5;
}
double coordinateOf(Axis axis, int i)
{
  return axis.s0 + (i + axis.s2) * axis.s6;
}
bool certain(double place, double error)
{
  return fabs(place - (int)place - 0.5) < 0.5 - error;
}

typedef struct
{
  global const uchar* points;
  global const uchar* ids;
  int isFloat;
  int isWide;
  int corners;
  int u;
  int v;
} Mesh;

int idOf(const Mesh* mesh, long cell, int corner)
{
  const long at = cell * mesh->corners + corner;
  return mesh->isWide ? (int)((global const long*)mesh->ids)[at] : ((global const int*)mesh->ids)[at];
}
double coordinate(const Mesh* mesh, int id, int axis)
{
  const long at = 3 * (long)id + axis;
  return mesh->isFloat ? ((global const float*)mesh->points)[at]
                       : ((global const double*)mesh->points)[at];
}
double3 pointOf(const Mesh* mesh, int id)
{
  const double x = coordinate(mesh, id, mesh->u);
  const double y = coordinate(mesh, id, mesh->v);
  return (double3)(x, y, mesh->corners == 4 ? coordinate(mesh, id, 2) : 0.0);
}
