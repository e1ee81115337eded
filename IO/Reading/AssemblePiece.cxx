// SPDX-License-Identifier: BSD-3-Clause
#include "Reading/AssemblePiece.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <tuple>
#include <utility>

namespace tipp
{
namespace
{

struct PointOfPiece
{
  std::int64_t Id; ///< global
  std::uint32_t Piece;
  std::uint8_t Ghost;
  std::int64_t Point;
};

class Assembly
{
public:
  explicit Assembly(const std::vector<const Piece*>& pieces)
    : Pieces(pieces)
  {
    for (const Piece* const piece : pieces)
    {
      this->Places.emplace_back(std::size_t(piece->Points), -1);
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
  /// Appends the cells' points that are not there yet, by global id.
  void pick(const std::vector<CellOfPiece>& cells, bool allPoints)
  {
    std::vector<PointOfPiece> found;
    const auto mark = [&](std::size_t p, std::int64_t point)
    {
      std::int64_t& place = this->Places[p][std::size_t(point)];
      if (place == -1)
      {
        place = -2;
        const Piece& piece = *this->Pieces[p];
        found.push_back({ piece.PointIds.as<std::int64_t>()[point], std::uint32_t(p),
          piece.PointGhosts.as<std::uint8_t>()[point], point });
      }
    };
    for (const CellOfPiece& cell : cells)
    {
      for (int corner = 0; corner < this->Pieces[cell.Piece]->CellSize; ++corner)
      {
        mark(cell.Piece, this->Pieces[cell.Piece]->corner(cell.Cell, corner));
      }
    }
    for (std::size_t p = 0; allPoints && p < this->Pieces.size(); ++p)
    {
      for (std::int64_t point = 0; point < this->Pieces[p]->OwnedPoints; ++point)
      {
        mark(p, point);
      }
    }
    this->number(found);
  }

  void number(std::vector<PointOfPiece>& found)
  {
    // The copy that is no ghost comes first.
    std::sort(found.begin(), found.end(),
      [](const PointOfPiece& a, const PointOfPiece& b)
      { return std::tie(a.Id, a.Ghost, a.Piece) < std::tie(b.Id, b.Ghost, b.Piece); });
    // Those of the cells before, sorted: a copy of one of them in another piece is no new point.
    const std::size_t before = this->Points.size();
    for (std::size_t i = 0; i < found.size(); ++i)
    {
      const PointOfPiece& point = found[i];
      std::int64_t& place = this->Places[point.Piece][std::size_t(point.Point)];
      const auto end = this->Points.begin() + std::ptrdiff_t(before);
      const auto old = std::lower_bound(this->Points.begin(), end, point.Id,
        [](const PointOfPiece& a, std::int64_t id) { return a.Id < id; });
      if (old != end && old->Id == point.Id)
      {
        old->Ghost = std::min(old->Ghost, point.Ghost);
        place = old - this->Points.begin();
        continue;
      }
      if (this->Points.size() == before || this->Points.back().Id != point.Id)
      {
        this->Points.push_back(point);
      }
      place = std::int64_t(this->Points.size()) - 1;
    }
  }

  void fillPoints(Piece& result) const
  {
    const std::size_t bytes = 3 * scalarSize(result.PointType);
    const std::size_t count = this->Points.size();
    result.Coordinates = RawBuffer(count * bytes);
    result.PointIds = RawBuffer(count * sizeof(std::int64_t));
    result.PointGhosts = RawBuffer(count);
    for (std::size_t i = 0; i < count; ++i)
    {
      const PointOfPiece& point = this->Points[i];
      std::memcpy(result.Coordinates.data() + i * bytes,
        this->Pieces[point.Piece]->Coordinates.data() + std::size_t(point.Point) * bytes, bytes);
      result.PointIds.as<std::int64_t>()[i] = point.Id;
      result.PointGhosts.as<std::uint8_t>()[i] = point.Ghost;
    }
    this->fillAttributes(result, true, count,
      [this](std::size_t i)
      { return std::make_pair(std::size_t(this->Points[i].Piece), this->Points[i].Point); });
  }

  void fillCells(Piece& result) const
  {
    const std::size_t count = this->Cells.size();
    constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
    const int corners = result.CellSize;
    result.WideIds = result.Points > most || result.Cells > most / corners;
    result.Connectivity = RawBuffer(count * std::size_t(corners) * (result.WideIds ? 8 : 4));
    result.CellIds = RawBuffer(count * sizeof(std::int64_t));
    for (std::size_t i = 0; i < count; ++i)
    {
      const CellOfPiece& cell = this->Cells[i];
      const Piece& piece = *this->Pieces[cell.Piece];
      result.CellIds.as<std::int64_t>()[i] = piece.CellIds.as<std::int64_t>()[cell.Cell];
      for (int corner = 0; corner < corners; ++corner)
      {
        const std::int64_t place =
          this->Places[cell.Piece][std::size_t(piece.corner(cell.Cell, corner))];
        const std::size_t at = i * std::size_t(corners) + std::size_t(corner);
        if (result.WideIds)
        {
          result.Connectivity.as<std::int64_t>()[at] = place;
        }
        else
        {
          result.Connectivity.as<std::int32_t>()[at] = std::int32_t(place);
        }
      }
    }
    this->fillAttributes(result, false, count,
      [this](std::size_t i) { return std::make_pair(this->Cells[i].Piece, this->Cells[i].Cell); });
  }

  /// source(i) is the piece and the tuple that the i-th comes from.
  template <typename Source>
  void fillAttributes(Piece& result, bool ofPoints, std::size_t count, const Source& source) const
  {
    const std::vector<Piece::Attribute>& first = this->Pieces.front()->Attributes;
    for (std::size_t a = 0; a < first.size(); ++a)
    {
      const StoredArray& description = first[a].Description;
      if (description.OfPoints != ofPoints)
      {
        continue;
      }
      const std::size_t bytes = std::size_t(description.Components) * scalarSize(description.Type);
      RawBuffer values(count * bytes);
      for (std::size_t i = 0; i < count; ++i)
      {
        const auto [piece, tuple] = source(i);
        std::memcpy(values.data() + i * bytes,
          this->Pieces[piece]->Attributes[a].Values.data() + std::size_t(tuple) * bytes, bytes);
      }
      result.Attributes.push_back({ description, std::move(values) });
    }
  }

  std::vector<const Piece*> Pieces;
  std::vector<std::vector<std::int64_t>> Places; ///< in the result; -1: not picked
  std::vector<PointOfPiece> Points;
  std::vector<CellOfPiece> Cells;
};

} // namespace

Piece assemblePiece(const std::vector<const Piece*>& pieces, const std::vector<CellOfPiece>& owned,
  const std::vector<CellOfPiece>& ghosts, bool allPoints)
{
  return Assembly(pieces).make(owned, ghosts, allPoints);
}

Piece mergePieces(const std::vector<const Piece*>& pieces)
{
  std::vector<CellOfPiece> owned;
  std::vector<std::int64_t> ids;
  for (std::size_t p = 0; p < pieces.size(); ++p)
  {
    for (std::int64_t cell = 0; cell < pieces[p]->OwnedCells; ++cell)
    {
      owned.push_back({ p, cell });
      ids.push_back(pieces[p]->CellIds.as<std::int64_t>()[cell]);
    }
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
  for (std::size_t i = 0; i < candidates.size(); ++i)
  {
    if (i == 0 || candidates[i].first != candidates[i - 1].first)
    {
      ghosts.push_back(candidates[i].second);
    }
  }
  return assemblePiece(pieces, owned, ghosts, true);
}

} // namespace tipp
