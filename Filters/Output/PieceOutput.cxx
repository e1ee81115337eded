// SPDX-License-Identifier: BSD-3-Clause
#include "Output/PieceOutput.h"

#include "Output/CellBuffers.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataSetAttributes.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cstring>

namespace tipp
{
namespace
{

/// The sources of a piece's points, in the order of its points.
class PiecePoints
{
public:
  PiecePoints(const DistributedTriangulation& mine, int rank, const GhostTriangles* ghosts)
    : Mine(mine)
    , Ghosts(ghosts)
    , FirstOwn(mine.FirstIds[std::size_t(rank)])
    , Places(mine.Owned.size() + mine.Foreign.size(), -1)
  {
    const auto mark = [this](const auto& ids)
    {
      for (const auto place : ids)
      {
        this->Places[std::size_t(place)] = 0;
      }
    };
    mark(mine.Ids32);
    mark(mine.Ids64);
    if (ghosts)
    {
      for (const IdTriangle& triangle : ghosts->Triangles)
      {
        for (const std::int64_t id : triangle)
        {
          const std::ptrdiff_t place = this->placeOf(id);
          if (place >= 0)
          {
            this->Places[std::size_t(place)] = 0;
          }
        }
      }
    }
    for (std::int64_t& place : this->Places)
    {
      place = place < 0 ? -1 : this->Count++;
    }
  }

  std::int64_t count() const
  {
    return this->Count + (this->Ghosts ? std::int64_t(this->Ghosts->PointIds.size()) : 0);
  }
  std::int64_t ofPlace(std::size_t place) const { return this->Places[place]; }
  std::int64_t ofId(std::int64_t id) const
  {
    const std::ptrdiff_t place = this->placeOf(id);
    return place >= 0 ? this->Places[std::size_t(place)]
                      : this->Count + rankOf(this->Ghosts->PointIds, id);
  }

  /// Calls visit(point index in the piece, tuples, index in tuples, whether this rank owns the
  /// point).
  template <typename Visit>
  void forEach(Visit&& visit) const
  {
    const std::size_t own = this->Mine.Owned.size();
    for (std::size_t i = 0; i < this->Places.size(); ++i)
    {
      if (this->Places[i] >= 0)
      {
        const bool isOwn = i < own;
        visit(this->Places[i], isOwn ? this->Mine.Owned : this->Mine.Foreign, isOwn ? i : i - own,
          isOwn);
      }
    }
    for (std::size_t i = 0; this->Ghosts && i < this->Ghosts->PointIds.size(); ++i)
    {
      visit(this->Count + std::int64_t(i), this->Ghosts->Points, i, false);
    }
  }

private:
  static std::ptrdiff_t rankOf(const std::vector<std::int64_t>& ids, std::int64_t id)
  {
    return std::lower_bound(ids.begin(), ids.end(), id) - ids.begin();
  }
  /// The index of an internal id among owned and then foreign points, or -1.
  std::ptrdiff_t placeOf(std::int64_t id) const
  {
    const std::ptrdiff_t own = std::ptrdiff_t(this->Mine.Owned.size());
    if (id >= this->FirstOwn && id < this->FirstOwn + own)
    {
      return std::ptrdiff_t(id - this->FirstOwn);
    }
    const std::ptrdiff_t at = rankOf(this->Mine.ForeignIds, id);
    const bool found = at < std::ptrdiff_t(this->Mine.ForeignIds.size()) &&
      this->Mine.ForeignIds[std::size_t(at)] == id;
    return found ? own + at : -1;
  }

  const DistributedTriangulation& Mine;
  const GhostTriangles* Ghosts;
  const std::int64_t FirstOwn;
  std::vector<std::int64_t> Places; ///< of owned, then foreign points: index in the piece, or -1
  std::int64_t Count = 0;
};

void fillPoints(const PiecePoints& piece, const PointRows& rows, std::size_t rowSize,
  bool withGhosts, vtkPolyData* output)
{
  const vtkIdType count = vtkIdType(piece.count());
  vtkNew<vtkPoints> points;
  points->SetDataType(rows.areDoubles() ? VTK_DOUBLE : VTK_FLOAT);
  points->SetNumberOfPoints(count);
  vtkNew<vtkIdTypeArray> ids;
  ids->SetName("GlobalPointIds");
  ids->SetNumberOfValues(count);
  vtkNew<vtkUnsignedCharArray> ghost;
  ghost->SetName(vtkDataSetAttributes::GhostArrayName());
  ghost->SetNumberOfValues(count);
  std::vector<char*> values;
  for (const PointRows::Column& column : rows.columns())
  {
    auto array = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(column.Type));
    array->SetName(column.Name.c_str());
    array->SetNumberOfComponents(column.Components);
    array->SetNumberOfTuples(count);
    output->GetPointData()->AddArray(array);
    values.push_back(static_cast<char*>(array->GetVoidPointer(0)));
  }
  piece.forEach(
    [&](std::int64_t to, const PointTuples& tuples, std::size_t at, bool isOwn)
    {
      const char* row = tuples.Rows.data() + at * rowSize;
      double place[3];
      std::memcpy(place, row, sizeof(place));
      row += sizeof(place);
      points->SetPoint(to, place);
      ids->SetValue(to, tuples.GlobalIds[at]);
      ghost->SetValue(to, isOwn ? 0 : vtkDataSetAttributes::DUPLICATEPOINT);
      for (std::size_t c = 0; c < values.size(); ++c)
      {
        const std::size_t size = rows.columns()[c].Size;
        std::memcpy(values[c] + std::size_t(to) * size, row, size);
        row += size;
      }
    });
  output->SetPoints(points);
  output->GetPointData()->SetGlobalIds(ids);
  if (withGhosts)
  {
    output->GetPointData()->AddArray(ghost);
  }
}

} // namespace

void fillPiece(const DistributedTriangulation& mine, int rank, const PointRows& rows,
  const GhostTriangles* ghosts, vtkPolyData* output)
{
  const PiecePoints piece(mine, rank, ghosts);
  fillPoints(piece, rows, mine.RowSize, ghosts != nullptr, output);
  const std::size_t own = mine.triangleCount();
  const std::size_t more = ghosts ? ghosts->Triangles.size() : 0;
  Buffer<std::int64_t> corners(3 * (own + more));
  std::int64_t* to = corners.data();
  const auto add = [&](const auto& ids)
  {
    for (const auto place : ids)
    {
      *to++ = piece.ofPlace(std::size_t(place));
    }
  };
  add(mine.Ids32);
  add(mine.Ids64);
  vtkNew<vtkIdTypeArray> numbers;
  numbers->SetName("GlobalCellIds");
  numbers->SetNumberOfValues(vtkIdType(own) + vtkIdType(more));
  for (std::size_t i = 0; i < own; ++i)
  {
    numbers->SetValue(vtkIdType(i), mine.FirstTriangle + std::int64_t(i));
  }
  for (std::size_t i = 0; i < more; ++i)
  {
    numbers->SetValue(vtkIdType(own) + vtkIdType(i), ghosts->Numbers[i]);
    for (const std::int64_t id : ghosts->Triangles[i])
    {
      *to++ = piece.ofId(id);
    }
  }
  output->SetPolys(takeCells(std::move(corners), 3));
  output->GetCellData()->SetGlobalIds(numbers);
  if (ghosts)
  {
    vtkNew<vtkUnsignedCharArray> ghost;
    ghost->SetName(vtkDataSetAttributes::GhostArrayName());
    ghost->SetNumberOfValues(vtkIdType(own) + vtkIdType(more));
    for (std::size_t i = 0; i < own + more; ++i)
    {
      ghost->SetValue(vtkIdType(i), i < own ? 0 : vtkDataSetAttributes::DUPLICATECELL);
    }
    output->GetCellData()->AddArray(ghost);
  }
}

} // namespace tipp
