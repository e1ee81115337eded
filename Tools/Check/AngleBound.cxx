// SPDX-License-Identifier: BSD-3-Clause
#include "Check/AngleBound.h"

#include "Check/ExactVector.h"

#include <algorithm>
#include <stdexcept>

namespace tipp
{
namespace check
{
namespace
{

constexpr long firstBits = 192;

} // namespace

AngleBound::AngleBound(const std::string& degrees)
  : Degrees(degrees)
{
  constexpr int most = 60; // every triangle has an angle of at most 60 degrees
  if (this->Degrees.isAbove(most))
  {
    throw std::invalid_argument("the angle " + degrees +
      " is above 60 degrees, which no triangle reaches at all corners; give a smaller one.");
  }
  this->Square = this->Degrees.squaredCosine(firstBits);
  this->RoundSquare = this->Square.roundLow();
}

/// For the vectors u and v from the apex, an angle below 90 degrees is below the bound if and only
/// if u.v > 0 and (u.v)^2 > c |u|^2 |v|^2, c being the squared cosine of the bound, which is at
/// least 1/4.
///
/// In doubles, with e = 2^-53: differences have a relative error of e, so u.v has an error of at
/// most 4.01 e |u| |v|, as |ux vx| + |uy vy| <= |u| |v|, and (u.v)^2 one of at most
/// 9.1 e |u|^2 |v|^2. c |u|^2 |v|^2 has a relative error of at most 12.1 e: 4 for each square, 1
/// for each of two products and 2 for c. Together this is less than 22 e |u|^2 |v|^2, and with the
/// error of that product itself less than 32 e = 2^-48 times its computed value. If u.v > 0 is
/// decided wrongly, |u.v| is at most 4.01 e |u| |v|, so the angle is not below the bound, and the
/// comparison says so. The squares' range excludes underflow and overflow.
bool AngleBound::isBelow(Position apex, Position p, Position q) const
{
  const double ux = p.x - apex.x;
  const double uy = p.y - apex.y;
  const double vx = q.x - apex.x;
  const double vy = q.y - apex.y;
  const double u = ux * ux + uy * uy;
  const double v = vx * vx + vy * vy;
  constexpr double least = 0x1p-450;
  constexpr double most = 0x1p450;
  if (!(std::min(u, v) >= least && std::max(u, v) <= most))
  {
    return this->isBelowExactly(apex, p, q);
  }
  const double dot = ux * vx + uy * vy;
  const double excess = dot * dot - this->RoundSquare * u * v;
  const double error = 0x1p-48 * u * v;
  return dot > 0 && (excess > error || (excess >= -error && this->isBelowExactly(apex, p, q)));
}

bool AngleBound::isBelowExactly(Position apex, Position p, Position q) const
{
  const ExactVector u(apex, p);
  const ExactVector v(apex, q);
  const ExactNumber dot = u.dot(v);
  if (dot <= 0)
  {
    return false;
  }
  const ExactNumber square = dot * dot;
  const ExactNumber product = u.square() * v.square();
  Enclosure bound = this->Square;
  // The sides are rational: they equal a squared cosine only if that is rational, and then its
  // enclosure is one number. Otherwise more digits decide sooner or later.
  for (long bits = firstBits; square > bound.Low * product; bits *= 2)
  {
    if (square > bound.High * product)
    {
      return true;
    }
    bound = this->Degrees.squaredCosine(2 * bits);
  }
  return false;
}

} // namespace check
} // namespace tipp
