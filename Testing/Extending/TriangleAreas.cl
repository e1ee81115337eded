// SPDX-License-Identifier: BSD-3-Clause
// Computes twice the area of each triangle, from x and y of its three corners. The host code is in
// DeviceKernel.cxx.
#pragma OPENCL EXTENSION cl_khr_fp64 : enable

kernel void twiceAreas(global const double* corners, uint triangles, global double* areas)
{
  const uint t = get_global_id(0);
  if (t >= triangles)
  {
    return; // the global size is rounded up to whole work groups
  }
  const double2 a = vload2(3 * t, corners);
  const double2 u = vload2(3 * t + 1, corners) - a;
  const double2 v = vload2(3 * t + 2, corners) - a;
  areas[t] = u.x * v.y - u.y * v.x;
}
