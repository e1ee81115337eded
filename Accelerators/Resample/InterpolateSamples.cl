// SPDX-License-Identifier: BSD-3-Clause
// Interpolates samples in the cells that claim them. Host side: ResampleOnDevice.cxx.
#include "LatticeAndMesh.cl"

typedef struct
{
  double origin[3];
  double matrix[3][3];
  double normals[3][3];
  double reciprocals[3];
  int rows[3];
  int columns[3];
  int thin;
} Weights;

double cofactors(Weights* w, int d)
{
  if (d == 2)
  {
    w->normals[0][0] = w->matrix[1][1];
    w->normals[0][1] = -w->matrix[0][1];
    w->normals[1][0] = -w->matrix[1][0];
    w->normals[1][1] = w->matrix[0][0];
    return w->matrix[0][0] * w->matrix[1][1] - w->matrix[0][1] * w->matrix[1][0];
  }
  for (int i = 0; i < 3; ++i)
  {
    const int j = (i + 1) % 3;
    const int k = (i + 2) % 3;
    for (int axis = 0; axis < 3; ++axis)
    {
      const int p = (axis + 1) % 3;
      const int q = (axis + 2) % 3;
      w->normals[i][axis] = w->matrix[p][j] * w->matrix[q][k] - w->matrix[q][j] * w->matrix[p][k];
    }
  }
  return w->normals[0][0] * w->matrix[0][0] + w->normals[0][1] * w->matrix[1][0] +
    w->normals[0][2] * w->matrix[2][0];
}

void choosePivot(Weights* w, int d, int step)
{
  int row = step;
  int column = step;
  for (int i = step; i < d; ++i)
  {
    for (int j = step; j < d; ++j)
    {
      if (fabs(w->matrix[i][j]) > fabs(w->matrix[row][column]))
      {
        row = i;
        column = j;
      }
    }
  }
  int swap = w->rows[step];
  w->rows[step] = w->rows[row];
  w->rows[row] = swap;
  swap = w->columns[step];
  w->columns[step] = w->columns[column];
  w->columns[column] = swap;
  for (int i = 0; i < d; ++i)
  {
    const double value = w->matrix[step][i];
    w->matrix[step][i] = w->matrix[row][i];
    w->matrix[row][i] = value;
  }
  for (int i = 0; i < d; ++i)
  {
    const double value = w->matrix[i][step];
    w->matrix[i][step] = w->matrix[i][column];
    w->matrix[i][column] = value;
  }
}

void eliminate(Weights* w, int d)
{
  double first = 0;
  for (int step = 0; step < d; ++step)
  {
    choosePivot(w, d, step);
    first = step == 0 ? fabs(w->matrix[0][0]) : first;
    const bool flat = !(fabs(w->matrix[step][step]) > 4.4408920985006262e-16 * first);
    w->reciprocals[step] = flat ? 0 : 1 / w->matrix[step][step];
    for (int row = step + 1; row < d; ++row)
    {
      w->matrix[row][step] *= w->reciprocals[step];
      for (int column = step + 1; column < d; ++column)
      {
        w->matrix[row][column] -= w->matrix[row][step] * w->matrix[step][column];
      }
    }
  }
}

void setWeights(Weights* w, int d, const double (*corners)[3])
{
  double product = 1;
  for (int axis = 0; axis < d; ++axis)
  {
    double largest = 0;
    w->origin[axis] = corners[0][axis];
    w->rows[axis] = w->columns[axis] = axis;
    for (int i = 0; i < d; ++i)
    {
      w->matrix[axis][i] = corners[i + 1][axis] - corners[0][axis];
      largest = fmax(largest, fabs(w->matrix[axis][i]));
    }
    product *= largest;
  }
  const double determinant = cofactors(w, d);
  w->thin = !(fabs(determinant) * 64 > product) || product < 1e-280;
  if (w->thin)
  {
    eliminate(w, d);
    return;
  }
  const double inverse = 1 / determinant;
  for (int i = 0; i < d; ++i)
  {
    for (int axis = 0; axis < d; ++axis)
    {
      w->normals[i][axis] *= inverse;
    }
  }
}

void solveWeights(const Weights* w, int d, const double* sample, double* weights)
{
  if (!w->thin)
  {
    for (int i = 0; i < d; ++i)
    {
      double rest = 0;
      for (int axis = 1; axis < d; ++axis)
      {
        rest += w->normals[i][axis] * (sample[axis] - w->origin[axis]);
      }
      weights[i] = w->normals[i][0] * (sample[0] - w->origin[0]) + rest;
    }
    return;
  }
  double right[3];
  for (int i = 0; i < d; ++i)
  {
    const int axis = w->rows[i];
    right[i] = sample[axis] - w->origin[axis];
    for (int k = 0; k < i; ++k)
    {
      right[i] -= w->matrix[i][k] * right[k];
    }
  }
  for (int i = d - 1; i >= 0; --i)
  {
    for (int k = i + 1; k < d; ++k)
    {
      right[i] -= w->matrix[i][k] * right[k];
    }
    right[i] *= w->reciprocals[i];
    weights[w->columns[i]] = right[i];
  }
}

bool precedes(const double* a, const double* b, int d)
{
  for (int axis = 0; axis < d; ++axis)
  {
    if (a[axis] != b[axis])
    {
      return a[axis] < b[axis];
    }
  }
  return false;
}

// The cell's corners in lexicographic order and their ids.
void loadSorted(const Mesh* mesh, long cell, double (*corners)[3], int* ids)
{
  const int d = CORNERS - 1;
  for (int i = 0; i <= d; ++i)
  {
    ids[i] = idOf(mesh, cell, i);
    const double3 p = pointOf(mesh, ids[i]);
    corners[i][0] = p.x;
    corners[i][1] = p.y;
    corners[i][2] = p.z;
  }
  for (int end = d; end > 0; --end)
  {
    for (int i = 0; i < end; ++i)
    {
      if (precedes(corners[i + 1], corners[i], d))
      {
        for (int axis = 0; axis < 3; ++axis)
        {
          const double swap = corners[i][axis];
          corners[i][axis] = corners[i + 1][axis];
          corners[i + 1][axis] = swap;
        }
        const int id = ids[i];
        ids[i] = ids[i + 1];
        ids[i + 1] = id;
      }
    }
  }
}

// Computes the corner ids and weights of `count` samples from `first` on; each work item does
// `share` consecutive ones. The first id is -1 for a sample that no cell of this piece (from
// firstCell on) claims.
kernel void weighSamples(global const Real* points, global const Id* ids, int u, int v, Axis x, Axis y, Axis z, long cells, long firstCell,
  int share, long first, long count, global const int* claims, global int* cornerIds,
  global double* weights)
{
  const Mesh mesh = { points, ids, u, v };
  const int d = CORNERS - 1;
  const long begin = get_global_id(0) * (long)share;
  long known = -1;
  Weights w;
  int sorted[4];
  for (long i = begin; i < min(begin + share, count); ++i)
  {
    const long cell = claims[first + i] - firstCell;
    if (cell < 0 || cell >= cells)
    {
      cornerIds[i * CORNERS] = -1;
      continue;
    }
    if (cell != known)
    {
      double corners[4][3];
      loadSorted(&mesh, cell, corners, sorted);
      setWeights(&w, d, corners);
      known = cell;
    }
    const long row = (first + i) / (long)x.s7;
    const double sample[3] = { coordinateOf(x, (int)((first + i) % (long)x.s7)),
      coordinateOf(y, (int)(row % (long)y.s7)),
      coordinateOf(z, d == 3 ? (int)(row / (long)y.s7) : 0) };
    double solved[3];
    solveWeights(&w, d, sample, solved);
    for (int corner = 0; corner <= d; ++corner)
    {
      cornerIds[i * CORNERS + corner] = sorted[corner];
    }
    for (int axis = 0; axis < d; ++axis)
    {
      weights[i * d + axis] = solved[axis];
    }
  }
}

// Interpolates one floating-point array, with a work item per sample.
kernel void interpolateArray(global const uchar* values, int isFloat, int components,
  long first, long count, global const int* cornerIds, global const double* weights,
  global uchar* samples)
{
  const long i = get_global_id(0);
  if (i >= count || cornerIds[i * CORNERS] < 0)
  {
    return;
  }
  const int d = CORNERS - 1;
  for (int component = 0; component < components; ++component)
  {
    double at[4];
    for (int corner = 0; corner < CORNERS; ++corner)
    {
      const long index = cornerIds[i * CORNERS + corner] * (long)components + component;
      at[corner] = isFloat ? ((global const float*)values)[index] : ((global const double*)values)[index];
    }
    double sum = weights[i * d] * (at[1] - at[0]);
    for (int axis = 1; axis < d; ++axis)
    {
      sum += weights[i * d + axis] * (at[axis + 1] - at[0]);
    }
    const long to = (first + i) * components + component;
    if (isFloat)
    {
      ((global float*)samples)[to] = (float)(at[0] + sum);
    }
    else
    {
      ((global double*)samples)[to] = at[0] + sum;
    }
  }
}
