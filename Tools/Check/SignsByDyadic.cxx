// SPDX-License-Identifier: BSD-3-Clause
// Signs of determinants: in double precision where its error leaves no doubt, else exactly. The
// bounds of errors are those of Shewchuk, Adaptive Precision Floating-Point Arithmetic (1997),
// rounded up by an eighth or more.
#include "Check/ExactNumber.h"
#include "Check/ExactTests.h"

#include <array>
#include <cmath>
#include <cstddef>

namespace tipp
{
namespace check
{
namespace
{

template <typename Number>
int signOf(const Number& value)
{
  return value > Number(0) ? 1 : value < Number(0) ? -1 : 0;
}

/// A determinant, and the sum of the sizes of its products.
struct Estimate
{
  double Value;
  double Size;

  /// Whether the sign is certain, with an error of `error` times the size.
  bool isCertain(double error) const { return std::fabs(this->Value) > error * this->Size; }
};

/// Returns whether products of up to five of these differences neither overflow nor lose digits.
template <std::size_t N>
bool areMultiplied(const std::array<double, N>& differences)
{
  bool are = true;
  for (const double difference : differences)
  {
    const double size = std::fabs(difference);
    are = are && (size == 0 || (size > 1e-50 && size < 1e50));
  }
  return are;
}

/// The rows of a determinant: differences of coordinates, exact or rounded.
template <typename Number, std::size_t N>
using Row = std::array<Number, N>;

template <typename Number>
Row<Number, 2> rowOf(Position p, Position from)
{
  return { Number(p.x) - Number(from.x), Number(p.y) - Number(from.y) };
}

template <typename Number>
Row<Number, 3> rowOf(const Position3& p, const Position3& from)
{
  return { Number(p.x) - Number(from.x), Number(p.y) - Number(from.y),
    Number(p.z) - Number(from.z) };
}

template <typename Number>
Number squareOf(const Row<Number, 2>& a)
{
  return a[0] * a[0] + a[1] * a[1];
}

template <typename Number>
Number squareOf(const Row<Number, 3>& a)
{
  return a[0] * a[0] + a[1] * a[1] + a[2] * a[2];
}

/// The 2 x 2 minor of columns i and j.
template <typename Number, std::size_t N>
Number minorOf(const Row<Number, N>& a, const Row<Number, N>& b, std::size_t i, std::size_t j)
{
  return a[i] * b[j] - a[j] * b[i];
}

/// The sum of the sizes of the minor's products.
template <std::size_t N>
double minorSize(const Row<double, N>& a, const Row<double, N>& b, std::size_t i, std::size_t j)
{
  return std::fabs(a[i] * b[j]) + std::fabs(a[j] * b[i]);
}

template <typename Number>
Number determinant(const Row<Number, 3>& a, const Row<Number, 3>& b, const Row<Number, 3>& c)
{
  return a[2] * minorOf(b, c, 0, 1) + b[2] * minorOf(c, a, 0, 1) + c[2] * minorOf(a, b, 0, 1);
}

double sizeOf(const Row<double, 3>& a, const Row<double, 3>& b, const Row<double, 3>& c)
{
  return std::fabs(a[2]) * minorSize(b, c, 0, 1) + std::fabs(b[2]) * minorSize(c, a, 0, 1) +
    std::fabs(c[2]) * minorSize(a, b, 0, 1);
}

template <typename Number>
Number circleOf(const Row<Number, 2>& a, const Row<Number, 2>& b, const Row<Number, 2>& c)
{
  return squareOf(a) * minorOf(b, c, 0, 1) + squareOf(b) * minorOf(c, a, 0, 1) +
    squareOf(c) * minorOf(a, b, 0, 1);
}

double circleSize(const Row<double, 2>& a, const Row<double, 2>& b, const Row<double, 2>& c)
{
  return squareOf(a) * minorSize(b, c, 0, 1) + squareOf(b) * minorSize(c, a, 0, 1) +
    squareOf(c) * minorSize(a, b, 0, 1);
}

/// Positive if the origin is inside the sphere of the four, whose turn is positive.
template <typename Number>
Number sphereOf(const Row<Number, 3>& a, const Row<Number, 3>& b, const Row<Number, 3>& c,
  const Row<Number, 3>& d)
{
  return squareOf(a) * determinant(b, c, d) - squareOf(b) * determinant(a, c, d) +
    squareOf(c) * determinant(a, b, d) - squareOf(d) * determinant(a, b, c);
}

double sphereSize(const Row<double, 3>& a, const Row<double, 3>& b, const Row<double, 3>& c,
  const Row<double, 3>& d)
{
  return squareOf(a) * sizeOf(b, c, d) + squareOf(b) * sizeOf(a, c, d) +
    squareOf(c) * sizeOf(a, b, d) + squareOf(d) * sizeOf(a, b, c);
}

} // namespace

int turn(Position a, Position b, Position c)
{
  const auto u = rowOf<double>(b, a);
  const auto v = rowOf<double>(c, a);
  const Estimate estimate{ minorOf(u, v, 0, 1), minorSize(u, v, 0, 1) };
  constexpr double error = 4e-16;
  if (areMultiplied<4>({ u[0], u[1], v[0], v[1] }) && estimate.isCertain(error))
  {
    return signOf(estimate.Value);
  }
  return signOf(minorOf(rowOf<ExactNumber>(b, a), rowOf<ExactNumber>(c, a), 0, 1));
}

int inCircle(Position a, Position b, Position c, Position d)
{
  const auto u = rowOf<double>(a, d);
  const auto v = rowOf<double>(b, d);
  const auto w = rowOf<double>(c, d);
  const Estimate estimate{ circleOf(u, v, w), circleSize(u, v, w) };
  constexpr double error = 1.5e-15;
  if (areMultiplied<6>({ u[0], u[1], v[0], v[1], w[0], w[1] }) && estimate.isCertain(error))
  {
    return signOf(estimate.Value);
  }
  return signOf(
    circleOf(rowOf<ExactNumber>(a, d), rowOf<ExactNumber>(b, d), rowOf<ExactNumber>(c, d)));
}

int turn(const Position3& a, const Position3& b, const Position3& c, const Position3& d)
{
  const auto u = rowOf<double>(b, a);
  const auto v = rowOf<double>(c, a);
  const auto w = rowOf<double>(d, a);
  const Estimate estimate{ determinant(u, v, w), sizeOf(u, v, w) };
  constexpr double error = 1e-15;
  if (areMultiplied<9>({ u[0], u[1], u[2], v[0], v[1], v[2], w[0], w[1], w[2] }) &&
    estimate.isCertain(error))
  {
    return signOf(estimate.Value);
  }
  return signOf(
    determinant(rowOf<ExactNumber>(b, a), rowOf<ExactNumber>(c, a), rowOf<ExactNumber>(d, a)));
}

int inSphere(const Position3& a, const Position3& b, const Position3& c, const Position3& d,
  const Position3& e)
{
  const auto p = rowOf<double>(a, e);
  const auto q = rowOf<double>(b, e);
  const auto r = rowOf<double>(c, e);
  const auto s = rowOf<double>(d, e);
  const Estimate estimate{ sphereOf(p, q, r, s), sphereSize(p, q, r, s) };
  constexpr double error = 2.5e-15;
  if (areMultiplied(p) && areMultiplied(q) && areMultiplied(r) && areMultiplied(s) &&
    estimate.isCertain(error))
  {
    return signOf(estimate.Value);
  }
  return signOf(sphereOf(rowOf<ExactNumber>(a, e), rowOf<ExactNumber>(b, e),
    rowOf<ExactNumber>(c, e), rowOf<ExactNumber>(d, e)));
}

bool areCollinear(const Position3& a, const Position3& b, const Position3& c)
{
  const auto u = rowOf<ExactNumber>(b, a);
  const auto v = rowOf<ExactNumber>(c, a);
  return signOf(minorOf(u, v, 0, 1)) == 0 && signOf(minorOf(u, v, 1, 2)) == 0 &&
    signOf(minorOf(u, v, 0, 2)) == 0;
}

} // namespace check
} // namespace tipp
