// SPDX-License-Identifier: BSD-3-Clause
#include "Resample/BorderClaims.h"

#include "Predicates/ExactPredicates.h"
#include "Resample/Claims.h"

#include <utility>

namespace tipp
{
namespace
{

/// The signs of the components of the inner normal of an edge or face that the sample lies on.
struct Normal
{
  int X;
  int Y;
  int Z;

  bool admits(int move) const
  {
    if (this->X != 0)
    {
      return (this->X > 0) == ((move & 1) == 0);
    }
    if (this->Y != 0)
    {
      return (this->Y > 0) == ((move & 2) == 0);
    }
    return (this->Z > 0) == ((move & 4) == 0);
  }
};

int firstMove(const Normal* normals, int count, int moves)
{
  for (int move = 0; move < moves; ++move)
  {
    bool admitted = true;
    for (int i = 0; i < count; ++i)
    {
      admitted = admitted && normals[i].admits(move);
    }
    if (admitted)
    {
      return move;
    }
  }
  return closedOnly;
}

int sign(double low, double high)
{
  return (high > low) - (high < low);
}

} // namespace

int moveRank(const Point2 (&corners)[3], Point2 sample)
{
  Normal normals[3];
  int touched = 0;
  const int turn = orientation(corners[0], corners[1], corners[2]);
  for (int i = 0; i < 3; ++i)
  {
    const Point2 a = corners[i];
    const Point2 b = corners[(i + 1) % 3];
    if (orientation(a, b, sample) == 0)
    {
      normals[touched++] = { turn * sign(b.y, a.y), turn * sign(a.x, b.x), 0 };
    }
  }
  return firstMove(normals, touched, 4);
}

int moveRank(const Point3 (&corners)[4], Point3 sample)
{
  constexpr int faces[4][3] = { { 1, 3, 2 }, { 0, 2, 3 }, { 0, 3, 1 }, { 0, 1, 2 } };
  Normal normals[4];
  int touched = 0;
  const int side = orientation3(corners[0], corners[1], corners[2], corners[3]);
  for (const int(&face)[3] : faces)
  {
    const Point3 a = corners[face[0]];
    const Point3 b = corners[face[1]];
    const Point3 c = corners[face[2]];
    if (orientation3(a, b, c, sample) == 0)
    {
      normals[touched++] = { side * orientation({ a.y, a.z }, { b.y, b.z }, { c.y, c.z }),
        side * orientation({ a.z, a.x }, { b.z, b.x }, { c.z, c.x }),
        side * orientation({ a.x, a.y }, { b.x, b.y }, { c.x, c.y }) };
    }
  }
  return firstMove(normals, touched, 8);
}

namespace
{

/// Sorts touches by sample: each thread sorts a part, then the parts are merged.
void sort(std::vector<Touch>& touches, int threads)
{
  const auto border = [&](std::int64_t share)
  { return touches.begin() + std::ptrdiff_t(touches.size()) * share / threads; };
  forChunks(threads, 1, threads, {},
    [&](std::int64_t begin, std::int64_t end, int) { std::sort(border(begin), border(end)); });
  for (std::int64_t share = 1; share < threads; ++share)
  {
    std::inplace_merge(touches.begin(), border(share), border(share + 1));
  }
}

/// The cell of lowest key among those that touch a sample.
template <typename Access>
std::int32_t lowestCell(
  const Access& cells, const LatticeAxes& axes, const Touch* begin, const Touch* end)
{
  std::pair<CellKey, std::int32_t> lowest(noCellKey, begin->Cell);
  // Most samples are touched by one cell only.
  for (const Touch* touch = begin; end - begin > 1 && touch < end; ++touch)
  {
    const int rank = borderRank(cells, axes, touch->Sample, touch->Cell);
    lowest = std::min(lowest, { withRank(keyOf(cells, touch->Cell), rank), touch->Cell });
  }
  return lowest.second;
}

} // namespace

std::vector<BorderClaim> borderClaims(
  const SimplexMesh& mesh, const LatticeAxes& axes, std::vector<Touch> touches, int threads)
{
  sort(touches, threads);
  std::vector<BorderClaim> claims;
  std::vector<std::size_t> begins;
  for (std::size_t i = 0; i < touches.size(); ++i)
  {
    if (i == 0 || touches[i].Sample != touches[i - 1].Sample)
    {
      claims.push_back({ touches[i].Sample, touches[i].Cell });
      begins.push_back(i);
    }
  }
  begins.push_back(touches.size());
  withAccess(mesh,
    [&](const auto& access)
    {
      forChunks(std::int64_t(claims.size()), 1 << 8, threads, {},
        [&](std::int64_t begin, std::int64_t end, int)
        {
          for (auto i = std::size_t(begin); i < std::size_t(end); ++i)
          {
            claims[i].Cell =
              lowestCell(access, axes, touches.data() + begins[i], touches.data() + begins[i + 1]);
          }
        });
    });
  return claims;
}

} // namespace tipp
