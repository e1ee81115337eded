// SPDX-License-Identifier: BSD-3-Clause
// The points of one rank's piece of a mesh, for a VTK data set.
#ifndef tippPiecePoints_h
#define tippPiecePoints_h

#include "Output/TriangleOutput.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkSmartPointer.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <vector>

namespace tipp
{

/// Numbers the points of a piece: those that the rank owns and uses, those of other ranks that its
/// cells use, and those that only ghost cells use. `Mesh` is a DistributedTriangulation or
/// DistributedTetrahedralization; `ghosts` may be null. An id is an internal id (index among all
/// ranks' points); a local index counts the owned points and then those of other ranks that the
/// mesh uses.
template <typename Mesh, typename Ghosts>
class PiecePoints
{
public:
  PiecePoints(const Mesh& mine, int rank, const Ghosts* ghosts)
    : Mine(mine)
    , Others(ghosts)
    , FirstOwn(mine.FirstIds[std::size_t(rank)])
    , Indices(mine.Owned.size() + mine.Ghosts.size(), -1)
  {
    mine.forEachCorner([this](std::int64_t index) { this->Indices[std::size_t(index)] = 0; });
    if (ghosts)
    {
      for (const auto& cell : ghosts->Cells)
      {
        for (const std::int64_t id : cell)
        {
          const std::ptrdiff_t index = this->localIndexOf(id);
          if (index >= 0)
          {
            this->Indices[std::size_t(index)] = 0;
          }
        }
      }
    }
    for (std::int64_t& index : this->Indices)
    {
      index = index < 0 ? -1 : this->Count++;
    }
  }

  /// The number of points of the piece.
  std::int64_t count() const
  {
    return this->Count + (this->Others ? std::int64_t(this->Others->PointIds.size()) : 0);
  }
  /// Returns the index in the piece of a local index.
  std::int64_t ofLocalIndex(std::size_t index) const { return this->Indices[index]; }
  /// Returns the index in the piece of an internal id.
  std::int64_t ofId(std::int64_t id) const
  {
    const std::ptrdiff_t index = this->localIndexOf(id);
    return index >= 0 ? this->Indices[std::size_t(index)]
                      : this->Count + rankOf(this->Others->PointIds, id);
  }

  /// Calls visit(index in the piece, tuples, index in tuples, whether this rank owns the point) for
  /// all points of the piece.
  template <typename Visit>
  void forEach(Visit&& visit) const
  {
    const std::size_t own = this->Mine.Owned.size();
    for (std::size_t i = 0; i < this->Indices.size(); ++i)
    {
      if (this->Indices[i] >= 0)
      {
        const bool isOwn = i < own;
        visit(this->Indices[i], isOwn ? this->Mine.Owned : this->Mine.Ghosts, isOwn ? i : i - own,
          isOwn);
      }
    }
    for (std::size_t i = 0; this->Others && i < this->Others->PointIds.size(); ++i)
    {
      visit(this->Count + std::int64_t(i), this->Others->Points, i, false);
    }
  }

private:
  static std::ptrdiff_t rankOf(const std::vector<std::int64_t>& ids, std::int64_t id)
  {
    return std::lower_bound(ids.begin(), ids.end(), id) - ids.begin();
  }
  /// Returns the local index of an internal id, or -1.
  std::ptrdiff_t localIndexOf(std::int64_t id) const
  {
    const std::ptrdiff_t own = std::ptrdiff_t(this->Mine.Owned.size());
    if (id >= this->FirstOwn && id < this->FirstOwn + own)
    {
      return std::ptrdiff_t(id - this->FirstOwn);
    }
    const std::ptrdiff_t at = rankOf(this->Mine.GhostIds, id);
    const bool found =
      at < std::ptrdiff_t(this->Mine.GhostIds.size()) && this->Mine.GhostIds[std::size_t(at)] == id;
    return found ? own + at : -1;
  }

  const Mesh& Mine;
  const Ghosts* Others;
  const std::int64_t FirstOwn;
  std::vector<std::int64_t> Indices; ///< by local index: the index in the piece, or -1
  std::int64_t Count = 0;
};

/// Sets the points of `output`, their data and their global ids. `rowSize`: bytes of a row.
template <typename Points>
void fillPoints(const Points& piece, const PointRows& rows, std::size_t rowSize, bool withGhosts,
  vtkPointSet* output)
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
    [&](std::int64_t to, const auto& tuples, std::size_t at, bool isOwn)
    {
      const char* row = tuples.Rows.data() + at * rowSize;
      double position[3];
      std::memcpy(position, row, sizeof(position));
      row += sizeof(position);
      points->SetPoint(to, position);
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

/// Returns the corners of a piece's cells, as indices of its points: of the cells of `mine`, which
/// have `size` corners each and `own` in all, and of the ghosts, which may be null.
template <typename Id, typename Mesh, typename Ghosts>
Buffer<Id> cornersOf(const PiecePoints<Mesh, Ghosts>& piece, const Mesh& mine, std::size_t size,
  std::size_t own, const Ghosts* ghosts)
{
  Buffer<Id> corners(size * (own + (ghosts ? ghosts->Cells.size() : 0)));
  Id* to = corners.data();
  mine.forEachCorner(
    [&](std::int64_t index) { *to++ = Id(piece.ofLocalIndex(std::size_t(index))); });
  for (std::size_t i = 0; ghosts && i < ghosts->Cells.size(); ++i)
  {
    const auto* const cell = ghosts->Cells[i].data();
    to = std::transform(cell, cell + size, to, [&](std::int64_t id) { return Id(piece.ofId(id)); });
  }
  return corners;
}

/// Sets the global ids of cells: of `lines`, the first of which has the id `firstLine`, then of the
/// `own` cells of `mine`, and of the ghosts, which may be null.
template <typename Mesh, typename Ghosts>
void setCellIds(std::int64_t firstLine, std::size_t lines, const Mesh& mine, std::size_t own,
  const Ghosts* ghosts, vtkDataSet* output)
{
  vtkNew<vtkIdTypeArray> ids;
  ids->SetName("GlobalCellIds");
  const std::size_t cells = lines + own + (ghosts ? ghosts->Numbers.size() : 0);
  ids->SetNumberOfValues(vtkIdType(cells));
  vtkIdType* const begin = ids->GetPointer(0);
  std::iota(begin, begin + lines, vtkIdType(firstLine));
  std::iota(begin + lines, begin + lines + own, vtkIdType(mine.FirstCell));
  if (ghosts)
  {
    std::copy(ghosts->Numbers.begin(), ghosts->Numbers.end(), begin + lines + own);
  }
  output->GetCellData()->SetGlobalIds(ids);
}

/// Adds the cell array vtkGhostType: the first `own` cells are the piece's own, the others copies.
inline void addCellGhosts(std::size_t own, std::size_t copies, vtkDataSet* output)
{
  vtkNew<vtkUnsignedCharArray> ghost;
  ghost->SetName(vtkDataSetAttributes::GhostArrayName());
  ghost->SetNumberOfValues(vtkIdType(own) + vtkIdType(copies));
  std::fill_n(ghost->GetPointer(0), own, static_cast<unsigned char>(0));
  std::fill_n(ghost->GetPointer(0) + own, copies,
    static_cast<unsigned char>(vtkDataSetAttributes::DUPLICATECELL));
  output->GetCellData()->AddArray(ghost);
}

} // namespace tipp

#endif
