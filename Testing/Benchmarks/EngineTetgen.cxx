// SPDX-License-Identifier: BSD-3-Clause
#include "Engines3D.h"

#define TETLIBRARY
#include <tetgen.h>

#include <algorithm>

namespace tipp
{
namespace benchmark
{

std::size_t tetrahedralizeByTetgen(const std::vector<Point3>& points)
{
  tetgenio in;
  in.numberofpoints = int(points.size());
  in.pointlist = new REAL[3 * points.size()];
  REAL* at = in.pointlist;
  for (const Point3& p : points)
  {
    at = std::copy_n(&p.x, 3, at);
  }
  tetgenio out;
  char quietly[] = "Q";
  tetrahedralize(quietly, &in, &out);
  return std::size_t(out.numberoftetrahedra);
}

} // namespace benchmark
} // namespace tipp
