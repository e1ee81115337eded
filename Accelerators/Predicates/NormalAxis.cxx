// SPDX-License-Identifier: BSD-3-Clause
#include "Predicates/NormalAxis.h"

#include <array>
#include <cstddef>
#include <gmpxx.h>

namespace tipp
{

int normalAxis(const Point3& a, const Point3& b, const Point3& c)
{
  using Vector = std::array<mpq_class, 3>;
  const auto difference = [&a](const Point3& p)
  {
    return Vector{ mpq_class(p.x) - mpq_class(a.x), mpq_class(p.y) - mpq_class(a.y),
      mpq_class(p.z) - mpq_class(a.z) };
  };
  const Vector ab = difference(b);
  const Vector ac = difference(c);
  int longest = 0;
  mpq_class length = -1;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const std::size_t u = (axis + 1) % 3;
    const std::size_t v = (axis + 2) % 3;
    const mpq_class component = abs(mpq_class(ab[u] * ac[v] - ab[v] * ac[u]));
    if (component >= length)
    {
      length = component;
      longest = int(axis);
    }
  }
  return longest;
}

} // namespace tipp
