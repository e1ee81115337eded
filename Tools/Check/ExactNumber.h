// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippExactNumber_h
#define tippExactNumber_h

// The Python wheel is built without GMP, which would be larger than all of the checker.
#ifdef TIPP_CHECK_WITHOUT_GMP

#include "Predicates/Dyadic.h"

namespace tipp
{

inline bool operator==(const Dyadic& a, const Dyadic& b)
{
  return compare(a, b) == 0;
}
inline bool operator!=(const Dyadic& a, const Dyadic& b)
{
  return compare(a, b) != 0;
}
inline bool operator<(const Dyadic& a, const Dyadic& b)
{
  return compare(a, b) < 0;
}
inline bool operator>(const Dyadic& a, const Dyadic& b)
{
  return compare(a, b) > 0;
}
inline bool operator<=(const Dyadic& a, const Dyadic& b)
{
  return compare(a, b) <= 0;
}
inline bool operator>=(const Dyadic& a, const Dyadic& b)
{
  return compare(a, b) >= 0;
}
inline Dyadic abs(const Dyadic& a)
{
  return a.sign() < 0 ? -a : a;
}

namespace check
{
/// A number whose sums, differences and products are exact.
using ExactNumber = Dyadic;
} // namespace check
} // namespace tipp

#else

#include <gmpxx.h>

namespace tipp
{
namespace check
{
/// A number whose sums, differences and products are exact.
using ExactNumber = mpq_class;
} // namespace check
} // namespace tipp

#endif

#endif
