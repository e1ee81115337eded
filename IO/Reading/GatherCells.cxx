// SPDX-License-Identifier: BSD-3-Clause
#include "Reading/PieceSource.h"

#include "Loading/ArrayFiles.h"
#include "Parallel/Poll.h"
#include "Predicates/ExactPredicates3.h"
#include "Resample/SimplexMesh.h"

#include <algorithm>
#include <limits>
#include <tuple>
#include <utility>

namespace tipp
{

namespace
{

struct PointOfPiece
{
  std::int64_t Id; ///< global id
  std::uint32_t Piece;
  std::uint8_t Ghost;
  std::int64_t Point;
};

/// Sorts values that consist of a few ascending runs, as a piece's ids do.
template <typename Value, typename Less>
void sortRuns(std::vector<Value>& values, const Less& less)
{
  std::vector<std::size_t> starts{ 0 };
  for (std::size_t i = 1; i < values.size(); ++i)
  {
    if (less(values[i], values[i - 1]))
    {
      starts.push_back(i);
    }
  }
  starts.push_back(values.size());
  std::vector<Value> merged(starts.size() > 2 ? values.size() : 0);
  while (starts.size() > 2)
  {
    std::vector<std::size_t> next;
    for (std::size_t run = 0; run + 1 < starts.size(); run += 2)
    {
      const auto at = [&](std::size_t i)
      { return values.begin() + std::ptrdiff_t(starts[std::min(i, starts.size() - 1)]); };
      std::merge(at(run), at(run + 1), at(run + 1), at(run + 2),
        merged.begin() + std::ptrdiff_t(starts[run]), less);
      next.push_back(starts[run]);
    }
    next.push_back(values.size());
    starts = std::move(next);
    values.swap(merged);
  }
}

/// Tuples of one of the pieces, and their targets.
struct TupleMoves
{
  std::vector<std::uint64_t> Sources;
  std::vector<std::uint64_t> Targets;

  void add(std::int64_t source, std::size_t target)
  {
    this->Sources.push_back(std::uint64_t(source));
    this->Targets.push_back(target);
  }
};

class Gathering
{
public:
  explicit Gathering(const std::vector<const Piece*>& pieces)
    : Pieces(pieces)
  {
    for (const Piece* const piece : pieces)
    {
      this->Indices.emplace_back(std::size_t(piece->Points), absent);
    }
  }

  Piece make(
    const std::vector<CellOfPiece>& owned, const std::vector<CellOfPiece>& ghosts, bool allPoints)
  {
    this->pick(owned, allPoints);
    Piece result;
    result.OwnedPoints = std::int64_t(this->Points.size());
    this->pick(ghosts, false);
    result.CellSize = this->Pieces.front()->CellSize;
    result.PointType = this->Pieces.front()->PointType;
    result.Points = std::int64_t(this->Points.size());
    result.OwnedCells = std::int64_t(owned.size());
    this->Cells = owned;
    this->Cells.insert(this->Cells.end(), ghosts.begin(), ghosts.end());
    result.Cells = std::int64_t(this->Cells.size());
    this->fillPoints(result);
    this->fillCells(result);
    return result;
  }

private:
  /// Appends the cells' points that are not in the result yet, by global id.
  void pick(const std::vector<CellOfPiece>& cells, bool allPoints)
  {
    if (cells.empty() && !allPoints)
    {
      return;
    }
    const auto mark = [](std::int64_t& index) { index = index == absent ? wanted : index; };
    for (const CellOfPiece& cell : cells)
    {
      pollAt(cell.Cell);
      const Piece& piece = *this->Pieces[cell.Piece];
      for (int corner = 0; corner < piece.CellSize; ++corner)
      {
        mark(this->Indices[cell.Piece][std::size_t(piece.corner(cell.Cell, corner))]);
      }
    }
    for (std::size_t p = 0; allPoints && p < this->Pieces.size(); ++p)
    {
      std::for_each_n(this->Indices[p].begin(), this->Pieces[p]->OwnedPoints, mark);
    }
    std::vector<PointOfPiece> found;
    for (std::size_t p = 0; p < this->Pieces.size(); ++p)
    {
      const Piece& piece = *this->Pieces[p];
      for (std::int64_t point = 0; point < piece.Points; ++point)
      {
        if (this->Indices[p][std::size_t(point)] == wanted)
        {
          found.push_back({ piece.PointIds.as<std::int64_t>()[point], std::uint32_t(p),
            piece.PointGhosts.as<std::uint8_t>()[point], point });
        }
      }
    }
    this->number(found);
  }

  void number(std::vector<PointOfPiece>& found)
  {
    // Among the copies of a point, the one that is not a ghost sorts first.
    sortRuns(found,
      [](const PointOfPiece& a, const PointOfPiece& b)
      { return std::tie(a.Id, a.Ghost, a.Piece) < std::tie(b.Id, b.Ghost, b.Piece); });
    // Points of the previous cells, sorted: their copies in other pieces are not new points.
    const std::size_t before = this->Points.size();
    for (std::size_t i = 0; i < found.size(); ++i)
    {
      const PointOfPiece& point = found[i];
      std::int64_t& index = this->Indices[point.Piece][std::size_t(point.Point)];
      const auto end = this->Points.begin() + std::ptrdiff_t(before);
      const auto old = std::lower_bound(this->Points.begin(), end, point.Id,
        [](const PointOfPiece& a, std::int64_t id) { return a.Id < id; });
      if (old != end && old->Id == point.Id)
      {
        old->Ghost = std::min(old->Ghost, point.Ghost);
        index = old - this->Points.begin();
        continue;
      }
      if (this->Points.size() == before || this->Points.back().Id != point.Id)
      {
        this->Points.push_back(point);
      }
      index = std::int64_t(this->Points.size()) - 1;
    }
  }

  void fillPoints(Piece& result) const
  {
    const std::size_t count = this->Points.size();
    std::vector<TupleMoves> moves(this->Pieces.size());
    result.PointGhosts = Buffer<char>(count);
    for (std::size_t i = 0; i < count; ++i)
    {
      const PointOfPiece& point = this->Points[i];
      moves[point.Piece].add(point.Point, i);
      result.PointGhosts.as<std::uint8_t>()[i] = point.Ghost;
    }
    result.Coordinates = this->gather(moves, count, 3 * scalarSize(result.PointType),
      [](const Piece& piece) { return piece.Coordinates.data(); });
    result.PointIds = this->gather(
      moves, count, sizeof(std::int64_t), [](const Piece& piece) { return piece.PointIds.data(); });
    this->gatherAttributes(result, true, moves, count);
  }

  void fillCells(Piece& result) const
  {
    const std::size_t count = this->Cells.size();
    constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
    result.WideIds = result.Points > most || result.Cells > most / result.CellSize;
    result.WideIds ? this->fillConnectivity<std::int64_t>(result)
                   : this->fillConnectivity<std::int32_t>(result);
    std::vector<TupleMoves> moves(this->Pieces.size());
    for (std::size_t i = 0; i < count; ++i)
    {
      moves[this->Cells[i].Piece].add(this->Cells[i].Cell, i);
    }
    result.CellIds = this->gather(
      moves, count, sizeof(std::int64_t), [](const Piece& piece) { return piece.CellIds.data(); });
    this->gatherAttributes(result, false, moves, count);
  }

  template <typename Id>
  void fillConnectivity(Piece& result) const
  {
    const int corners = result.CellSize;
    result.Connectivity = Buffer<char>(this->Cells.size() * std::size_t(corners) * sizeof(Id));
    Id* id = result.Connectivity.as<Id>();
    for (const CellOfPiece& cell : this->Cells)
    {
      for (int corner = 0; corner < corners; ++corner, ++id)
      {
        const std::int64_t point = this->Pieces[cell.Piece]->corner(cell.Cell, corner);
        *id = Id(this->Indices[cell.Piece][std::size_t(point)]);
      }
    }
  }

  void gatherAttributes(
    Piece& result, bool ofPoints, const std::vector<TupleMoves>& moves, std::size_t count) const
  {
    const std::vector<Piece::Attribute>& first = this->Pieces.front()->Attributes;
    for (std::size_t a = 0; a < first.size(); ++a)
    {
      const StoredArray& description = first[a].Description;
      if (description.OfPoints == ofPoints)
      {
        const std::size_t bytes =
          std::size_t(description.Components) * scalarSize(description.Type);
        result.Attributes.push_back({ description,
          this->gather(moves, count, bytes,
            [a](const Piece& piece) { return piece.Attributes[a].Values.data(); }) });
      }
    }
  }

  /// Appends an array of `count` tuples; data(piece) returns a piece's own values.
  template <typename Data>
  Buffer<char> gather(const std::vector<TupleMoves>& moves, std::size_t count, std::size_t bytes,
    const Data& data) const
  {
    Buffer<char> values(count * bytes);
    for (std::size_t p = 0; p < moves.size(); ++p)
    {
      scatterTuples(data(*this->Pieces[p]), moves[p].Sources.data(), values.data(),
        moves[p].Targets.data(), moves[p].Sources.size(), bytes);
    }
    return values;
  }

  static constexpr std::int64_t absent = -1;
  static constexpr std::int64_t wanted = -2;

  std::vector<const Piece*> Pieces;
  /// By piece and point: the index in the result; or absent or wanted.
  std::vector<std::vector<std::int64_t>> Indices;
  std::vector<PointOfPiece> Points;
  std::vector<CellOfPiece> Cells;
};

constexpr std::uint8_t insideRange =
  0x80; ///< marks points inside the range, which have no side bits

Point3 pointOf(const Piece& piece, std::int64_t point)
{
  Point3 p{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const std::size_t at = 3 * std::size_t(point) + axis;
    p[axis] = piece.PointType == Scalar::Float32 ? double(piece.Coordinates.as<float>()[at])
                                                 : piece.Coordinates.as<double>()[at];
  }
  return p;
}

} // namespace

Piece gatherCells(const std::vector<const Piece*>& pieces, const std::vector<CellOfPiece>& owned,
  const std::vector<CellOfPiece>& ghosts, bool allPoints)
{
  return Gathering(pieces).make(owned, ghosts, allPoints);
}

Piece mergePieces(const std::vector<const Piece*>& pieces)
{
  std::vector<CellOfPiece> owned;
  std::vector<std::int64_t> ids;
  const bool borrows = std::any_of(pieces.begin(), pieces.end(),
    [](const Piece* piece) { return piece->Cells > piece->OwnedCells; });
  for (std::size_t p = 0; p < pieces.size(); ++p)
  {
    for (std::int64_t cell = 0; cell < pieces[p]->OwnedCells; ++cell)
    {
      owned.push_back({ p, cell });
    }
    const std::int64_t* const first = pieces[p]->CellIds.as<std::int64_t>();
    ids.insert(ids.end(), first, first + (borrows ? pieces[p]->OwnedCells : 0));
  }
  std::sort(ids.begin(), ids.end());
  // Ghosts that none of the pieces owns, each once.
  std::vector<std::pair<std::int64_t, CellOfPiece>> candidates;
  for (std::size_t p = 0; p < pieces.size(); ++p)
  {
    for (std::int64_t cell = pieces[p]->OwnedCells; cell < pieces[p]->Cells; ++cell)
    {
      const std::int64_t id = pieces[p]->CellIds.as<std::int64_t>()[cell];
      if (!std::binary_search(ids.begin(), ids.end(), id))
      {
        candidates.push_back({ id, { p, cell } });
      }
    }
  }
  std::stable_sort(candidates.begin(), candidates.end(),
    [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<CellOfPiece> ghosts;
  const auto end = std::unique(candidates.begin(), candidates.end(),
    [](const auto& a, const auto& b) { return a.first == b.first; });
  std::for_each(candidates.begin(), end,
    [&ghosts](const auto& candidate) { ghosts.push_back(candidate.second); });
  return gatherCells(pieces, owned, ghosts, true);
}

Piece mergePieces(const std::vector<Piece>& pieces)
{
  std::vector<const Piece*> pointers;
  for (const Piece& piece : pieces)
  {
    pointers.push_back(&piece);
  }
  return mergePieces(pointers);
}

RangeFilter::RangeFilter(const PartitionedMesh& mesh, const Box3& range)
  : Mesh(mesh)
  , Range(boundedBox(range, mesh.CellSize - 1))
{
  // Clip to the domain, outside of which there are no cells, so that the predicates get numbers of
  // the mesh's own magnitude.
  const Box3 domain = boundedBox(mesh.Domain, mesh.CellSize - 1);
  const bool apart = !this->Range.meets(domain);
  for (std::size_t axis = 0; axis < 3 && !apart; ++axis)
  {
    this->Range.Min[axis] = std::max(this->Range.Min[axis], domain.Min[axis]);
    this->Range.Max[axis] = std::min(this->Range.Max[axis], domain.Max[axis]);
  }
  for (std::size_t i = 0; i < mesh.Pieces.size() && !apart; ++i)
  {
    if (this->boxOfPiece(i).meets(this->Range))
    {
      this->Open.push_back(i);
    }
  }
}

bool RangeFilter::meets(const Piece& piece, std::int64_t cell, const Box3& box) const
{
  const auto corner = [&](int i) { return pointOf(piece, piece.corner(cell, i)); };
  const Point3 a = corner(0);
  const Point3 b = corner(1);
  const Point3 c = corner(2);
  return piece.CellSize == 3 ? triangleMeetsBox({ a.x, a.y }, { b.x, b.y }, { c.x, c.y }, box)
                             : tetrahedronMeetsBox(a, b, c, corner(3), box);
}

bool RangeFilter::isLowerPieceMet(const Piece& piece, std::int64_t cell, std::size_t number) const
{
  for (const std::size_t other : this->Open)
  {
    if (other >= number)
    {
      return false;
    }
    if (this->meets(piece, cell, this->boxOfPiece(other)))
    {
      return true;
    }
  }
  return false;
}

void RangeFilter::setPointGhosts(Piece& piece, std::size_t number) const
{
  auto* const ghosts = piece.PointGhosts.as<std::uint8_t>();
  for (std::int64_t point = 0; point < piece.Points; ++point)
  {
    if (ghosts[point] == 0)
    {
      continue;
    }
    Point3 at = pointOf(piece, point);
    at.z = piece.CellSize == 3 ? 0 : at.z;
    const auto owner = std::find_if(this->Open.begin(), this->Open.end(),
      [&](std::size_t other) { return this->boxOfPiece(other).contains(at); });
    ghosts[point] = owner != this->Open.end() && *owner != number ? 1 : 0;
  }
}

std::vector<std::uint8_t> RangeFilter::sidesOfPoints(const Piece& piece) const
{
  const std::size_t axes = piece.CellSize == 3 ? 2 : 3;
  std::vector<std::uint8_t> sides(std::size_t(piece.Points));
  for (std::int64_t point = 0; point < piece.Points; ++point)
  {
    const Point3 at = pointOf(piece, point);
    int beyond = 0;
    bool within = true; // false for NaN
    for (std::size_t axis = 0; axis < axes; ++axis)
    {
      beyond |= int(at[axis] < this->Range.Min[axis]) << (2 * axis);
      beyond |= int(at[axis] > this->Range.Max[axis]) << (2 * axis + 1);
      within = within && at[axis] >= this->Range.Min[axis] && at[axis] <= this->Range.Max[axis];
    }
    sides[std::size_t(point)] = std::uint8_t(within ? insideRange : beyond);
  }
  return sides;
}

bool RangeFilter::meetsRange(
  const Piece& piece, std::int64_t cell, const std::vector<std::uint8_t>& sides) const
{
  int common = 0xff;
  bool inside = false;
  for (int corner = 0; corner < piece.CellSize; ++corner)
  {
    const int beyond = sides[std::size_t(piece.corner(cell, corner))];
    common &= beyond;
    inside = inside || beyond == insideRange;
  }
  return inside || (common == 0 && this->meets(piece, cell, this->Range));
}

Piece RangeFilter::apply(const Piece& piece, std::size_t number, bool borrowed) const
{
  const std::vector<std::uint8_t> sides = this->sidesOfPoints(piece);
  std::vector<CellOfPiece> owned;
  std::vector<CellOfPiece> ghosts;
  for (std::int64_t cell = 0; cell < piece.Cells; ++cell)
  {
    pollAt(cell);
    if (!this->meetsRange(piece, cell, sides))
    {
      continue;
    }
    if (cell < piece.OwnedCells || !this->isLowerPieceMet(piece, cell, number))
    {
      owned.push_back({ 0, cell });
    }
    else if (borrowed)
    {
      ghosts.push_back({ 0, cell });
    }
  }
  Piece kept = gatherCells({ &piece }, owned, ghosts, false);
  this->setPointGhosts(kept, number);
  return kept;
}

} // namespace tipp
