// SPDX-License-Identifier: BSD-3-Clause
#include "OutOfCore/PieceResult.h"

#include "OutOfCore/ScratchFiles.h"
#include "Predicates/ExactPredicates.h"
#include "Triangulation/TriangleSink.h"

#include <algorithm>
#include <stdexcept>

namespace tipp
{
namespace
{

enum SectionKind : std::uint32_t
{
  InteriorSection,
  FiguresSection,
  HullSection,
  BorderSection,
  CrossedSection,
  MessageSection
};

Box3 boxOf(const Box2& box)
{
  Box3 result;
  result.Min = { box.xmin, box.ymin, 0 };
  result.Max = { box.xmax, box.ymax, 0 };
  return result;
}

} // namespace

/// Finds the pieces that the triangle meets, as indices in the mesh, ascending.
void BorderSorter::findMet(const BoundaryTriangle& triangle)
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
      "Points are outside of the bounds that the first pass found: the input has changed; "
      "start again.");
  }
}

void BorderSorter::add(const BoundaryTriangle& triangle)
{
  const double longest = this->Work.MaximumEdge * this->Work.Factor;
  if (longest > 0 && !this->Work.Constraints &&
    hasLongEdge(triangle[0].Position, triangle[1].Position, triangle[2].Position, longest))
  {
    return;
  }
  this->findMet(triangle);
  const auto owner = static_cast<PartitionIndex>(this->Work.Plan.number(this->Met.front()));
  this->Borders[owner].add({ triangle[0].Id, triangle[1].Id, triangle[2].Id }, this->Met);
}

void append(BordersByOwner&& from, BordersByOwner& to)
{
  for (auto& [owner, added] : from)
  {
    BorderTriangles& border = to[owner];
    const std::uint64_t before = border.Borrowers.size();
    border.Corners.insert(border.Corners.end(), added.Corners.begin(), added.Corners.end());
    border.Borrowers.insert(border.Borrowers.end(), added.Borrowers.begin(), added.Borrowers.end());
    for (const std::uint64_t end : added.BorrowerEnds)
    {
      border.BorrowerEnds.push_back(before + end);
    }
  }
}

std::uint64_t writeResult(const std::string& path, const PieceResult& result)
{
  SectionFileWriter file(path);
  file.add({ InteriorSection, 0 }, packed(result.Interior));
  file.add({ FiguresSection, 0 }, packed(result.Figures));
  file.add({ HullSection, 0 }, packed(result.HullVertices));
  for (const auto& [owner, triangles] : result.Borders)
  {
    file.add({ BorderSection, owner }, packed(triangles));
  }
  if (!result.Crossed.Triangles.empty() || !result.Crossed.Touches.empty())
  {
    file.add({ CrossedSection, 0 }, packed(result.Crossed));
  }
  for (const auto& [to, messages] : result.Sent)
  {
    SaveArchive writer;
    for (const auto& [partition, message] : messages)
    {
      writer(partition, message);
    }
    file.add({ MessageSection, to }, writer.take());
  }
  return file.finish();
}

bool StoredResult::hasMessages(PartitionIndex to) const
{
  return this->File.has({ MessageSection, to });
}

SentMessages StoredResult::readMessages(PartitionIndex to) const
{
  const Bytes bytes = this->File.read({ MessageSection, to });
  SentMessages messages;
  for (LoadArchive reader(bytes); reader.left() > 0;)
  {
    messages.emplace_back(reader.get<PartitionIndex>(), VertexMessage{});
    reader(messages.back().second);
  }
  return messages;
}

bool StoredResult::hasBorder(PartitionIndex owner) const
{
  return this->File.has({ BorderSection, owner });
}

BorderTriangles StoredResult::readBorder(PartitionIndex owner) const
{
  return unpacked<BorderTriangles>(this->File.read({ BorderSection, owner }));
}

std::vector<BoundaryVertex> StoredResult::readHullVertices() const
{
  return unpacked<std::vector<BoundaryVertex>>(this->File.read({ HullSection, 0 }));
}

CrossedPart StoredResult::readCrossed() const
{
  CrossedPart crossed;
  if (this->File.has({ CrossedSection, 0 }))
  {
    crossed = unpacked<CrossedPart>(this->File.read({ CrossedSection, 0 }));
  }
  return crossed;
}

PieceFigures StoredResult::readFigures() const
{
  return unpacked<PieceFigures>(this->File.read({ FiguresSection, 0 }));
}

PieceInterior StoredResult::readInterior() const
{
  return unpacked<PieceInterior>(this->File.read({ InteriorSection, 0 }));
}

} // namespace tipp
