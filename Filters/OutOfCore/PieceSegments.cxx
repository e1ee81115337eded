// SPDX-License-Identifier: BSD-3-Clause
#include "OutOfCore/PieceSegments.h"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <set>
#include <unordered_set>
#include <utility>

namespace tipp
{
namespace
{

std::string pathOf(const std::string& file)
{
  return file + ".segments";
}

std::vector<ConstraintSegment> cuttingOnes(const std::vector<ConstraintSegment>& segments)
{
  std::vector<ConstraintSegment> cutting;
  std::copy_if(segments.begin(), segments.end(), std::back_inserter(cutting),
    [](const ConstraintSegment& segment) { return segment.Role != SegmentRole::Line; });
  return cutting;
}

} // namespace

PieceSegments::PieceSegments(const std::string& file, const PiecePlan& plan, double factor,
  const std::vector<ConstraintSegment>& segments, int threads)
  : Plan(plan)
  , Factor(factor)
  , Rows(pathOf(file), std::size_t(plan.pieces()), sizeof(Row),
      [&]
      {
        Spill spill(pathOf(file), 0, std::size_t(plan.pieces()), sizeof(Row));
        spill.protect();
        this->writeRows(spill, segments, threads);
        return std::vector<SpilledRows>{ spill.close() };
      }())
  , Cutting(cuttingOnes(segments))
{
}

PieceSegments::PieceSegments(
  const std::string& file, const PiecePlan& plan, double factor, LoadArchive& archive)
  : Plan(plan)
  , Factor(factor)
  , Rows(pathOf(file), std::size_t(plan.pieces()), sizeof(Row), archive.get<SpilledRows>())
  , Cutting(archive.get<std::vector<ConstraintSegment>>())
{
}

void PieceSegments::save(SaveArchive& archive) const
{
  archive(this->Rows.content(), this->Cutting.list());
}

/// Returns a box of segments in the plan's coordinates.
Box2 PieceSegments::planned(const Box2& box) const
{
  return { box.xmin * this->Factor, box.ymin * this->Factor, box.xmax * this->Factor,
    box.ymax * this->Factor };
}

void PieceSegments::writeRows(
  Spill& spill, const std::vector<ConstraintSegment>& segments, int threads) const
{
  struct Place
  {
    std::size_t Segment;
    PartitionIndex Piece;
  };
  constexpr std::size_t most = std::size_t(1) << 16;
  std::vector<Place> places; // a segment may meet many pieces
  const auto write = [&]
  {
    spill.add(
      places.size(), threads, [&](std::size_t i) { return std::int64_t(places[i].Piece); },
      [&](std::size_t i, char* to)
      {
        const Row row{ segments[places[i].Segment], std::int64_t(places[i].Segment) };
        std::memcpy(to, &row, sizeof row);
      });
    places.clear();
  };
  for (std::size_t i = 0; i < segments.size(); ++i)
  {
    const ConstraintSegment& segment = segments[i];
    if (segment.Role == SegmentRole::Hole)
    {
      continue; // a hole's outline is no edge of the triangulation
    }
    const Point2 a{ segment.A.x * this->Factor, segment.A.y * this->Factor };
    const Point2 b{ segment.B.x * this->Factor, segment.B.y * this->Factor };
    this->Plan.Pieces.visitNear(boxOf(a, b),
      [&](PartitionIndex piece) {
        lineMayMeet(a, b, this->Plan.Pieces.box(piece)) ? places.push_back({ i, piece }) : void();
      });
    places.size() >= most ? write() : void();
  }
  places.empty() ? void() : write();
}

std::uint64_t PieceSegments::bytesOf(PartitionIndex piece) const
{
  // The segments and their tree; their ends among the points; the data of editors.
  constexpr std::uint64_t each = 48 + 64 + 48 + 96;
  return each * std::uint64_t(this->count(piece));
}

void PieceSegments::visit(PartitionIndex piece, const std::function<void(const Row&)>& visit) const
{
  constexpr std::size_t most = 4096;
  this->Rows.read(std::size_t(piece), most,
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

ConstraintSegments PieceSegments::read(PartitionIndex piece) const
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

ConstraintSegments PieceSegments::readNear(const std::vector<Box2>& boxes) const
{
  std::vector<SegmentTree::Item> items;
  std::set<PartitionIndex> pieces;
  for (const Box2& box : boxes)
  {
    items.push_back({ { box.xmin, box.ymin }, { box.xmax, box.ymax }, 0 });
    this->Plan.Pieces.visitNear(
      this->planned(box), [&pieces](PartitionIndex piece) { pieces.insert(piece); });
  }
  const SegmentTree tree(std::move(items));
  std::vector<ConstraintSegment> segments;
  std::vector<std::int64_t> names;
  std::unordered_set<std::int64_t> known; // a long segment is in many pieces
  for (const PartitionIndex piece : pieces)
  {
    this->visit(piece,
      [&](const Row& row)
      {
        bool isNear = false;
        tree.visitNear(boxOf(row.Segment.A, row.Segment.B),
          [&isNear](const SegmentTree::Item&)
          {
            isNear = true;
            return false;
          });
        if (isNear && known.insert(row.Name).second)
        {
          segments.push_back(row.Segment);
          names.push_back(row.Name);
        }
      });
  }
  return { segments, names };
}

} // namespace tipp
