// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippBox2_h
#define tippBox2_h

namespace tipp
{

/// A closed axis-aligned box. Its bounds may be infinite; xmin <= xmax and ymin <= ymax.
struct Box2
{
  double xmin;
  double ymin;
  double xmax;
  double ymax;
};

} // namespace tipp

#endif
