// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPoint3_h
#define tippPoint3_h

namespace tipp
{

struct Point3
{
  double x;
  double y;
  double z;
};

} // namespace tipp

#endif
