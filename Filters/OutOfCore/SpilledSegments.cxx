// SPDX-License-Identifier: BSD-3-Clause
#include "OutOfCore/SpilledSegments.h"

#include "Arrays/IndexMap.h"

#include <cstring>
#include <set>
#include <utility>

namespace tipp
{
namespace
{

std::string pathOf(const std::string& file)
{
  return file + ".segments";
}

} // namespace

SpilledSegments::SpilledSegments(const std::string& file, const PiecePlan& plan, double factor,
  const std::function<void(const VisitSegment&)>& forEach, int threads)
  : Plan(plan)
  , Factor(factor)
  , Cutting(std::vector<ConstraintSegment>())
{
  const auto pieces = std::size_t(plan.pieces());
  Spill spill(pathOf(file), 0, pieces, sizeof(Row));
  spill.protect();
  struct RowOfPiece
  {
    Row Content;
    PartitionIndex Piece;
  };
  constexpr std::size_t most = std::size_t(1) << 14;
  std::vector<RowOfPiece> rows; // a segment may meet many pieces
  const auto writeRows = [&]
  {
    spill.add(
      rows.size(), threads, [&](std::size_t i) { return std::int64_t(rows[i].Piece); },
      [&](std::size_t i, char* to) { std::memcpy(to, &rows[i].Content, sizeof(Row)); });
    rows.clear();
  };
  std::vector<ConstraintSegment> cutting;
  std::int64_t name = 0;
  forEach(
    [&](const ConstraintSegment& segment)
    {
      const Row row{ segment, name++ };
      if (segment.Role != SegmentRole::Line)
      {
        cutting.push_back(segment);
      }
      if (segment.Role == SegmentRole::Hole)
      {
        return; // a hole's outline is no edge of the triangulation
      }
      const Point2 a{ segment.A.x * factor, segment.A.y * factor };
      const Point2 b{ segment.B.x * factor, segment.B.y * factor };
      plan.Pieces.visitNear(Box2::of(a, b),
        [&](PartitionIndex piece)
        {
          if (lineMayMeet(a, b, plan.Pieces.box(piece)))
          {
            rows.push_back({ row, piece });
          }
        });
      if (rows.size() >= most)
      {
        writeRows();
      }
    });
  if (!rows.empty())
  {
    writeRows();
  }
  this->Rows = std::make_unique<Spill>(
    pathOf(file), pieces, sizeof(Row), std::vector<SpilledRows>{ spill.close() });
  this->Cutting = ConstraintSegments(cutting);
}

SpilledSegments::SpilledSegments(
  const std::string& file, const PiecePlan& plan, double factor, LoadArchive& archive)
  : Plan(plan)
  , Factor(factor)
  , Rows(std::make_unique<Spill>(
      pathOf(file), std::size_t(plan.pieces()), sizeof(Row), archive.get<SpilledRows>()))
  , Cutting(archive.get<std::vector<ConstraintSegment>>())
{
}

void SpilledSegments::save(SaveArchive& archive) const
{
  archive(this->Rows->content(), this->Cutting.list());
}

std::uint64_t SpilledSegments::bytesOf(PartitionIndex piece) const
{
  // The segments and their tree; their ends among the points; the data of editors.
  constexpr std::uint64_t each = 48 + 64 + 48 + 96;
  return each * std::uint64_t(this->count(piece));
}

void SpilledSegments::visit(
  PartitionIndex piece, const std::function<void(const Row&)>& visit) const
{
  constexpr std::size_t most = 4096;
  this->Rows->read(std::size_t(piece), most,
    [&](const char* rows, std::size_t count)
    {
      for (std::size_t i = 0; i < count; ++i)
      {
        Row row;
        std::memcpy(&row, rows + i * sizeof row, sizeof row);
        visit(row);
      }
    });
}

ConstraintSegments SpilledSegments::read(PartitionIndex piece) const
{
  std::vector<ConstraintSegment> segments;
  std::vector<std::int64_t> names;
  segments.reserve(std::size_t(this->count(piece)));
  names.reserve(segments.capacity());
  this->visit(piece,
    [&](const Row& row)
    {
      segments.push_back(row.Segment);
      names.push_back(row.Name);
    });
  return { segments, names };
}

ConstraintSegments SpilledSegments::readNear(const std::vector<Box2>& boxes) const
{
  std::vector<SegmentTree::Item> items;
  std::set<PartitionIndex> pieces;
  for (const Box2& box : boxes)
  {
    items.push_back({ box.Min, box.Max, 0 });
    this->Plan.Pieces.visitNear(
      scaled(box, this->Factor), [&pieces](PartitionIndex piece) { pieces.insert(piece); });
  }
  const SegmentTree tree(std::move(items));
  std::vector<ConstraintSegment> segments;
  std::vector<std::int64_t> names;
  IndexMap known; // a long segment is in many pieces
  for (const PartitionIndex piece : pieces)
  {
    this->visit(piece,
      [&](const Row& row)
      {
        bool isNear = false;
        tree.visitNear(Box2::of(row.Segment.A, row.Segment.B),
          [&isNear](const SegmentTree::Item&)
          {
            isNear = true;
            return false;
          });
        if (isNear && known.insert(row.Name).IsNew)
        {
          segments.push_back(row.Segment);
          names.push_back(row.Name);
        }
      });
  }
  return { segments, names };
}

} // namespace tipp
