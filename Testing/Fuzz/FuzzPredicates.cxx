// SPDX-License-Identifier: BSD-3-Clause
// Draws four points that are degenerate or an ulp away from it, and compares all predicates that
// apply to them with rational arithmetic.
#include "ExactOracle.h"
#include "FuzzDriver.h"
#include "NearDegenerate.h"

#include "Predicates/ExactPredicates.h"

#include <cstdio>
#include <utility>

namespace
{

using Points = NearDegenerate::Points;

tipp::Point2 drawOffset(NearDegenerate& draw)
{
  const tipp::Point2 offsets[] = { { 0, 0 }, { 0.3, -7 }, { -1e5, 3e5 }, { 1e3, 1e-3 },
    { -3, 1e6 } };
  return offsets[draw.integer(0, 4)];
}

Points drawQuadruple(NearDegenerate& draw)
{
  const double steps[] = { 1.0, 0.1, 1e-9 };
  const double step = steps[draw.integer(0, 2)];
  switch (draw.integer(0, 10))
  {
    case 0:
    case 1:
      return draw.lattice(draw.integer(3, 9), step, drawOffset(draw));
    case 2:
    case 3:
      return draw.cocircular(step, drawOffset(draw));
    case 4:
    case 5:
      return draw.collinear(step, drawOffset(draw));
    case 6:
      return scaled(draw.cocircular(0.1, { 0.3, 0 }), draw.integer(-1060, 1017));
    case 7:
      return scaled(draw.collinear(0.1, { 0.3, 0 }), draw.integer(-1060, 1014));
    case 8:
      return draw.unitCircle();
    case 9:
      return draw.integer(0, 9) == 0 ? draw.fewMagnitudes(-1074, 1020)
                                     : draw.fewMagnitudes(-100, 100);
    default:
      // Only one case in fifty, because rationals of thousands of bits are slow.
      return draw.integer(0, 49) == 0 ? draw.mixedExponents(-1030, 1000)
                                      : draw.mixedExponents(-40, 40);
  }
}

bool agree(Points q)
{
  const int turn = oracle::orientation(q[0], q[1], q[2]);
  tipp::CoordinateGrid grid;
  grid.analyse(q.data(), q.size());
  if (tipp::orientation(q[0], q[1], q[2]) != turn ||
    tipp::orientationExact(q[0], q[1], q[2]) != turn ||
    tipp::orientation(q[2], q[1], q[0]) != -turn || grid.orientation(q[0], q[1], q[2]) != turn)
  {
    return false;
  }
  if (turn == 0)
  {
    return true;
  }
  if (turn < 0)
  {
    std::swap(q[0], q[1]);
  }
  const int side = oracle::inCircle(q[0], q[1], q[2], q[3]);
  return tipp::inCircle(q[0], q[1], q[2], q[3]) == side &&
    tipp::inCircleExact(q[0], q[1], q[2], q[3]) == side &&
    grid.inCircle(q[0], q[1], q[2], q[3]) == side;
}

/// A case consists of a thousand draws.
bool passes(std::uint64_t seed, std::uint64_t number)
{
  NearDegenerate draw(unsigned(seed * 1000003 + number));
  for (int i = 0; i < 1000; ++i)
  {
    const Points q = drawQuadruple(draw);
    if (!agree(q))
    {
      std::printf("case %llu of seed %llu, quadruple %d:\n", (unsigned long long)number,
        (unsigned long long)seed, i);
      for (const tipp::Point2 p : q)
      {
        std::printf("  %a, %a\n", p.x, p.y);
      }
      return false;
    }
  }
  return true;
}

} // namespace

int main(int argc, char** argv)
{
  return tipp::test::fuzz("fuzzPredicates", argc, argv, passes);
}
