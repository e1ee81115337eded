// SPDX-License-Identifier: BSD-3-Clause
#include "OutOfCore/PieceBorders.h"

#include "Predicates/CellBox.h"
#include "Triangulation/TriangleSink.h"

#include <algorithm>
#include <stdexcept>

namespace tipp
{
namespace
{

Box3 boxOf(const Box2& box)
{
  Box3 result;
  result.Min = { box.xmin, box.ymin, 0 };
  result.Max = { box.xmax, box.ymax, 0 };
  return result;
}

} // namespace

/// The pieces that the triangle meets, by their numbers in the mesh, ascending.
void PieceBorders::findMet(const BoundaryTriangle& triangle)
{
  const Point2 a = triangle[0].Position;
  const Point2 b = triangle[1].Position;
  const Point2 c = triangle[2].Position;
  const PiecePlan& plan = this->Work.Plan;
  this->Met.clear();
  plan.Pieces.visitMet(Circumdisk(a, b, c),
    [&](PartitionIndex piece)
    {
      if (triangleMeetsBox(a, b, c, boxOf(plan.Pieces.box(piece))))
      {
        this->Met.push_back(std::int32_t(plan.number(piece)));
      }
    });
  std::sort(this->Met.begin(), this->Met.end());
  if (this->Met.empty())
  {
    throw std::runtime_error(
      "Points lie outside of the bounds that were found at first: the input has changed meanwhile; "
      "start again.");
  }
}

void PieceBorders::add(const BoundaryTriangle& triangle)
{
  const double longest = this->Work.MaximumEdge * this->Work.Factor;
  if (longest > 0 &&
    hasLongEdge(triangle[0].Position, triangle[1].Position, triangle[2].Position, longest))
  {
    return;
  }
  this->findMet(triangle);
  const auto owner = static_cast<PartitionIndex>(this->Work.Plan.number(this->Met.front()));
  BorderTriangles& border = this->Borders[owner];
  border.Corners.push_back({ triangle[0].Id, triangle[1].Id, triangle[2].Id });
  border.Borrowers.insert(border.Borrowers.end(), this->Met.begin() + 1, this->Met.end());
  border.BorrowerEnds.push_back(border.Borrowers.size());
}

void PieceBorders::appendTo(std::map<PartitionIndex, BorderTriangles>& borders) const
{
  for (const auto& [owner, added] : this->Borders)
  {
    BorderTriangles& border = borders[owner];
    const std::uint64_t before = border.Borrowers.size();
    border.Corners.insert(border.Corners.end(), added.Corners.begin(), added.Corners.end());
    border.Borrowers.insert(border.Borrowers.end(), added.Borrowers.begin(), added.Borrowers.end());
    for (const std::uint64_t end : added.BorrowerEnds)
    {
      border.BorrowerEnds.push_back(before + end);
    }
  }
}

} // namespace tipp
