// SPDX-License-Identifier: BSD-3-Clause
#include "Pipeline/MeshOutput.h"

#include "Constraints/Insertion/CrossedPart.h"
#include "Parallel/ParallelFor.h"
#include "Pipeline/InputPoints.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkTypeInt32Array.h"
#include "vtkTypeInt64Array.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <stdexcept>
#include <utility>
#include <vector>

namespace tipp
{
namespace
{

template <typename Array, typename Value>
vtkSmartPointer<Array> takeArray(Buffer<Value> buffer)
{
  auto array = vtkSmartPointer<Array>::New();
  if (!buffer.empty())
  {
    // If long and long long both have 64 bits, Value and VTK's type may be different ones of the
    // two.
    static_assert(sizeof(Value) == sizeof(typename Array::ValueType), "same integers");
    const vtkIdType size = vtkIdType(buffer.size());
    void* memory = buffer.release();
    array->SetArray(
      static_cast<typename Array::ValueType*>(memory), size, 0, Array::VTK_DATA_ARRAY_FREE);
  }
  return array;
}

template <typename Value>
Buffer<Value> offsets(std::size_t cells, int cellSize)
{
  Buffer<Value> result(cells + 1);
  forIndices(
    std::int64_t(cells + 1), [&](std::int64_t i) { result[std::size_t(i)] = Value(i * cellSize); });
  return result;
}

Buffer<std::int64_t> widened(const Buffer<std::int32_t>& ids)
{
  Buffer<std::int64_t> result(ids.size());
  forIndices(std::int64_t(ids.size()),
    [&](std::int64_t i) { result[std::size_t(i)] = ids[std::size_t(i)]; });
  return result;
}

template <typename Array, typename Value>
vtkSmartPointer<vtkCellArray> makeCells(Buffer<Value> ids, int cellSize)
{
  const auto starts = takeArray<Array>(offsets<Value>(ids.size() / cellSize, cellSize));
  const auto connectivity = takeArray<Array>(std::move(ids));
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  cells->SetData(starts.Get(), connectivity.Get());
  return cells;
}

} // namespace

vtkSmartPointer<vtkCellArray> takeCells(
  Buffer<std::int32_t> ids, int cellSize, std::int64_t largestOffset32)
{
  return std::int64_t(ids.size()) > largestOffset32
    ? makeCells<vtkTypeInt64Array>(widened(ids), cellSize)
    : makeCells<vtkTypeInt32Array>(std::move(ids), cellSize);
}

vtkSmartPointer<vtkCellArray> takeCells(Buffer<std::int64_t> ids, int cellSize)
{
  return makeCells<vtkTypeInt64Array>(std::move(ids), cellSize);
}

vtkSmartPointer<vtkIdTypeArray> takeArray(
  const std::string& name, Buffer<std::int64_t> values, int components)
{
  auto array = takeArray<vtkIdTypeArray>(std::move(values));
  array->SetName(name.c_str());
  array->SetNumberOfComponents(components);
  return array;
}

vtkSmartPointer<vtkUnsignedCharArray> takeArray(
  const std::string& name, Buffer<unsigned char> values, int components)
{
  auto array = takeArray<vtkUnsignedCharArray>(std::move(values));
  array->SetName(name.c_str());
  array->SetNumberOfComponents(components);
  return array;
}

void addNeighborIds(Buffer<std::int64_t> ids, int corners, vtkDataSet* output)
{
  ids.truncate(std::size_t(corners) * std::size_t(output->GetNumberOfCells()));
  output->GetCellData()->AddArray(takeArray("NeighborIds", std::move(ids), corners));
}

namespace
{

/// One rank's part of a mesh, as its output has it: its cells, then the ghost cells. The points are
/// those that the rank owns and uses, then those of other ranks that its cells use, then those that
/// only ghost cells use. `Mesh` is a DistributedTriangulation or DistributedTetrahedralization. An
/// id is an internal id (index among all ranks' points); a local index counts the owned points and
/// then those of other ranks that the mesh uses.
template <typename Mesh, typename Ghosts>
class OutputPart
{
public:
  /// The cells have `size` corners each. `ghosts` may be null. Both meshes must outlive the object.
  OutputPart(const Mesh& mine, std::size_t size, std::size_t cells, int rank, const Ghosts* ghosts)
    : Mine(mine)
    , CellSize(size)
    , Cells(cells)
    , Others(ghosts)
    , FirstOwn(mine.FirstIds[std::size_t(rank)])
    , Indices(mine.Owned.size() + mine.Ghosts.size(), -1)
  {
    mine.forEachCorner([this](std::int64_t index) { this->Indices[std::size_t(index)] = 0; });
    for (std::size_t i = 0; i < this->ghostCells(); ++i)
    {
      for (const std::int64_t id : ghosts->Cells[i])
      {
        const std::ptrdiff_t index = this->localIndexOf(id);
        if (index >= 0)
        {
          this->Indices[std::size_t(index)] = 0;
        }
      }
    }
    for (std::int64_t& index : this->Indices)
    {
      index = index < 0 ? -1 : this->Count++;
    }
  }

  std::size_t ghostCells() const { return this->Others ? this->Others->Cells.size() : 0; }

  /// The number of points of the part.
  std::int64_t count() const
  {
    return this->Count + (this->Others ? std::int64_t(this->Others->PointIds.size()) : 0);
  }
  /// Returns the index in the part of a local index.
  std::int64_t ofLocalIndex(std::int64_t index) const { return this->Indices[std::size_t(index)]; }

  /// Calls visit(index in the part, tuples, index in tuples, whether this rank owns the point) for
  /// all points of the part.
  template <typename Visit>
  void forEachPoint(const Visit& visit) const
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

  /// Returns the corners of the cells, the ghosts last, as indices of the part's points.
  template <typename Id>
  Buffer<Id> corners() const
  {
    Buffer<Id> corners(this->CellSize * (this->Cells + this->ghostCells()));
    Id* to = corners.data();
    this->Mine.forEachCorner([&](std::int64_t index) { *to++ = Id(this->ofLocalIndex(index)); });
    for (std::size_t i = 0; i < this->ghostCells(); ++i)
    {
      const auto* const cell = this->Others->Cells[i].data();
      to = std::transform(
        cell, cell + this->CellSize, to, [this](std::int64_t id) { return Id(this->ofId(id)); });
    }
    return corners;
  }

  /// Sets the points of `output`, their data, global ids and, with ghosts, vtkGhostType.
  void fillPoints(const PointRows& rows, vtkPointSet* output) const
  {
    const vtkIdType count = vtkIdType(this->count());
    vtkPointData* const data = output->GetPointData();
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
      data->AddArray(array);
      values.push_back(static_cast<char*>(array->GetVoidPointer(0)));
    }
    this->forEachPoint(
      [&](std::int64_t to, const auto& tuples, std::size_t at, bool isOwn)
      {
        const char* row = tuples.Rows.data() + at * this->Mine.RowSize;
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
    data->SetGlobalIds(ids);
    if (this->Others)
    {
      data->AddArray(ghost);
    }
  }

  /// Sets the global ids of the cells of `output` and, with ghosts, vtkGhostType. The first
  /// `lines` cells are lines, with ids from `firstLine` on.
  void addCellIds(std::size_t lines, std::int64_t firstLine, vtkPointSet* output) const
  {
    const std::size_t own = lines + this->Cells;
    const vtkIdType count = vtkIdType(own) + vtkIdType(this->ghostCells());
    vtkNew<vtkIdTypeArray> ids;
    ids->SetName("GlobalCellIds");
    ids->SetNumberOfValues(count);
    vtkIdType* const begin = ids->GetPointer(0);
    std::iota(begin, begin + lines, vtkIdType(firstLine));
    std::iota(begin + lines, begin + own, vtkIdType(this->Mine.FirstCell));
    output->GetCellData()->SetGlobalIds(ids);
    if (this->Others)
    {
      std::copy(this->Others->Numbers.begin(), this->Others->Numbers.end(), begin + own);
      vtkNew<vtkUnsignedCharArray> ghost;
      ghost->SetName(vtkDataSetAttributes::GhostArrayName());
      ghost->SetNumberOfValues(count);
      unsigned char* const types = ghost->GetPointer(0);
      std::fill(types, types + own, static_cast<unsigned char>(0));
      std::fill(types + own, types + count,
        static_cast<unsigned char>(vtkDataSetAttributes::DUPLICATECELL));
      output->GetCellData()->AddArray(ghost);
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
  /// Returns the index in the part of an internal id.
  std::int64_t ofId(std::int64_t id) const
  {
    const std::ptrdiff_t index = this->localIndexOf(id);
    return index >= 0 ? this->Indices[std::size_t(index)]
                      : this->Count + rankOf(this->Others->PointIds, id);
  }

  const Mesh& Mine;
  const std::size_t CellSize;
  const std::size_t Cells;
  const Ghosts* Others;
  const std::int64_t FirstOwn;
  std::vector<std::int64_t> Indices; ///< by local index: the index in the part, or -1
  std::int64_t Count = 0;
};

using TriangleOutputPart = OutputPart<DistributedTriangulation, GhostTriangles>;

/// Returns the cell array "ConstraintEdges" of a part's triangles, as constraintEdgesArray() makes
/// it.
vtkSmartPointer<vtkUnsignedCharArray> marksOf(const TriangleOutputPart& part,
  const ConstraintSegments& segments, const Buffer<std::int64_t>& corners)
{
  std::vector<Point2> positions(std::size_t(part.count()));
  part.forEachPoint([&](std::int64_t to, const PointTuples& tuples, std::size_t at, bool)
    { positions[std::size_t(to)] = tuples.Positions[at]; });
  auto marks = vtkSmartPointer<vtkUnsignedCharArray>::New();
  marks->SetName("ConstraintEdges");
  marks->SetNumberOfComponents(3);
  marks->SetNumberOfTuples(vtkIdType(corners.size() / 3));
  const PointsView view(positions);
  markEdges(view, segments, corners.data(), corners.size() / 3, marks->GetPointer(0));
  return marks;
}

void setLines(const TriangleOutputPart& part, const ConstraintLines& lines, vtkIdType triangles,
  vtkPolyData* output)
{
  Buffer<std::int64_t> ends(2 * lines.Ends.size());
  std::int64_t* to = ends.data();
  for (const auto& line : lines.Ends)
  {
    to = std::transform(line.begin(), line.end(), to,
      [&part](std::int64_t index) { return part.ofLocalIndex(index); });
  }
  output->SetLines(takeCells(std::move(ends), 2));
  vtkNew<vtkIdTypeArray> cells;
  cells->SetName("ConstraintId");
  cells->SetNumberOfValues(vtkIdType(lines.Cells.size()) + triangles);
  cells->FillValue(-1);
  std::copy(lines.Cells.begin(), lines.Cells.end(), cells->GetPointer(0));
  output->GetCellData()->AddArray(cells);
}

} // namespace

void fillOutput(const DistributedTriangulation& mine, int rank, const PointRows& rows,
  const GhostTriangles* ghosts, const ConstraintMarks& marks, vtkPolyData* output)
{
  const std::size_t own = mine.triangleCount();
  const TriangleOutputPart part(mine, 3, own, rank, ghosts);
  part.fillPoints(rows, output);
  Buffer<std::int64_t> corners = part.corners<std::int64_t>();
  if (marks.Flags)
  {
    output->GetCellData()->AddArray(marksOf(part, *marks.Flags, corners));
  }
  if (marks.Lines)
  {
    setLines(part, *marks.Lines, vtkIdType(own) + vtkIdType(part.ghostCells()), output);
  }
  output->SetPolys(takeCells(std::move(corners), 3));
  // Lines are VTK's first cells, but their ids follow those of all triangles.
  marks.Lines
    ? part.addCellIds(marks.Lines->Ends.size(), mine.AllCells + marks.Lines->First, output)
    : part.addCellIds(0, 0, output);
}

void fillOutput(const DistributedTetrahedralization& mine, int rank, const PointRows& rows,
  const GhostTetrahedra* ghosts, vtkUnstructuredGrid* output)
{
  const std::size_t size = mine.cellSize();
  const OutputPart<DistributedTetrahedralization, GhostTetrahedra> part(
    mine, size, mine.cellCount(), rank, ghosts);
  if (part.count() > std::numeric_limits<std::int32_t>::max())
  {
    throw std::length_error("a piece has more than 2,147,483,647 points; use more ranks.");
  }
  part.fillPoints(rows, output);
  output->SetCells(
    size == 3 ? VTK_TRIANGLE : VTK_TETRA, takeCells(part.corners<std::int32_t>(), int(size)));
  part.addCellIds(0, 0, output);
}

} // namespace tipp
