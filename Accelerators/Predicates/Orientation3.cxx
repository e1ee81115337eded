// SPDX-License-Identifier: BSD-3-Clause
#include "Predicates/Orientation3.h"

#include "Predicates/CommonExponent.h"

namespace tipp
{

int orientation3Exact(Point3 a, Point3 b, Point3 c, Point3 d)
{
  // Each product has an x, a y and a z: the axes may have different powers of two.
  auto x = toCommonExponent<4>({ a.x, b.x, c.x, d.x });
  auto y = toCommonExponent<4>({ a.y, b.y, c.y, d.y });
  auto z = toCommonExponent<4>({ a.z, b.z, c.z, d.z });
  for (int i = 1; i < 4; ++i)
  {
    x[i] -= x[0];
    y[i] -= y[0];
    z[i] -= z[0];
  }
  const mpz_class determinant = x[3] * (y[1] * z[2] - z[1] * y[2]) +
    y[3] * (z[1] * x[2] - x[1] * z[2]) + z[3] * (x[1] * y[2] - y[1] * x[2]);
  return sgn(determinant);
}

} // namespace tipp
