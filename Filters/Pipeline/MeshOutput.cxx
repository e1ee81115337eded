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
#include <array>
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
  /// `added`: by owned point: not 0 if it belongs to the part even if no cell uses it; may be
  /// empty.
  OutputPart(const Mesh& mine, std::size_t size, std::size_t cells, int rank, const Ghosts* ghosts,
    const std::vector<char>& added = {})
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
    for (std::size_t i = 0; i < added.size(); ++i)
    {
      this->Indices[i] = added[i] != 0 ? 0 : this->Indices[i];
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
  /// `newIndices`: by point of the part: its index in the output; -1: it is left out. Empty: all
  /// are output.
  void fillPoints(const PointRows& rows, vtkPointSet* output,
    const std::vector<std::int64_t>& newIndices = {}) const
  {
    const bool areAll = newIndices.empty();
    const vtkIdType count = areAll ? vtkIdType(this->count())
                                   : vtkIdType(std::count_if(newIndices.begin(), newIndices.end(),
                                       [](std::int64_t newIndex) { return newIndex >= 0; }));
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
      [&](std::int64_t index, const auto& tuples, std::size_t at, bool isOwn)
      {
        const std::int64_t to = areAll ? index : newIndices[std::size_t(index)];
        if (to < 0)
        {
          return;
        }
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
    if (this->Others && areAll)
    {
      data->AddArray(ghost);
    }
  }

  /// Returns the share of the alpha shape of all ranks' cells that this rank outputs, by the part's
  /// points. `isAdded`: see the constructor. The part must have ghosts.
  template <std::size_t Corners>
  AlphaShape<std::int32_t> alphaShare(double alpha, const std::vector<char>& isAdded) const
  {
    // Points are in the order of global ids, as in memory: it affects rounding.
    const auto count = std::size_t(this->count());
    std::vector<PointId> ids(count);
    std::vector<Point3> positions(count);
    std::vector<char> isMine(count, 0);
    this->forEachPoint(
      [&](std::int64_t index, const auto& tuples, std::size_t at, bool isOwn)
      {
        const auto i = std::size_t(index);
        ids[i] = tuples.GlobalIds[at];
        std::memcpy(&positions[i], tuples.Rows.data() + at * this->Mine.RowSize, sizeof(Point3));
        isMine[i] = isOwn && isAdded[at] != 0;
      });
    std::vector<std::int32_t> order(count);
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(),
      [&ids](std::int32_t a, std::int32_t b)
      { return std::make_pair(ids[std::size_t(a)], a) < std::make_pair(ids[std::size_t(b)], b); });
    std::vector<std::int32_t> number(count); // of a point in this order
    for (std::size_t i = 0; i < count; ++i)
    {
      number[std::size_t(order[i])] = std::int32_t(i);
    }
    Buffer<std::int32_t> cells = this->corners<std::int32_t>();
    this->findResponsible(cells, isMine);
    std::transform(cells.begin(), cells.end(), cells.begin(),
      [&number](std::int32_t point) { return number[std::size_t(point)]; });
    std::vector<char> covered(count);
    for (std::size_t i = 0; i < count; ++i)
    {
      covered[i] = isMine[std::size_t(order[i])] == 0;
    }
    const auto pointAt = [&](PointId point, double* p)
    { std::memcpy(p, &positions[std::size_t(order[std::size_t(point)])], sizeof(Point3)); };
    AlphaShape<std::int32_t> shape = alphaShape<Corners>(cells, pointAt, alpha, covered);
    const auto keepMine = [&](Buffer<std::int32_t>& of, std::size_t size)
    {
      std::int32_t* to = of.data();
      for (const std::int32_t* cell = of.begin(); cell != of.end(); cell += size)
      {
        if (covered[std::size_t(*std::min_element(cell, cell + size))] == 0)
        {
          to = std::transform(cell, cell + size, to,
            [&order](std::int32_t point) { return order[std::size_t(point)]; });
        }
      }
      of.truncate(std::size_t(to - of.data()));
    };
    keepMine(shape.Tetrahedra, 4);
    keepMine(shape.Triangles, 3);
    keepMine(shape.Lines, 2);
    keepMine(shape.Vertices, 1);
    return shape;
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
  /// Sets isMine[p] for the points p of cells, of which this rank has the one with the lowest
  /// number. It knows all cells at such a point. `cells`: by points of the part.
  void findResponsible(const Buffer<std::int32_t>& cells, std::vector<char>& isMine) const
  {
    constexpr std::int64_t none = std::numeric_limits<std::int64_t>::max();
    std::vector<std::int64_t> lowest(isMine.size(), none);
    for (std::size_t corner = 0; corner < cells.size(); ++corner)
    {
      const std::size_t cell = corner / this->CellSize;
      std::int64_t& of = lowest[std::size_t(cells[corner])];
      of = std::min(of,
        cell < this->Cells ? this->Mine.FirstCell + std::int64_t(cell)
                           : this->Others->Numbers[cell - this->Cells]);
    }
    const std::int64_t end = this->Mine.FirstCell + std::int64_t(this->Cells);
    for (std::size_t p = 0; p < isMine.size(); ++p)
    {
      const bool isFirst = this->Mine.FirstCell <= lowest[p] && lowest[p] < end;
      isMine[p] = isFirst ? 1 : isMine[p];
    }
  }

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

void requireShortIndices(std::int64_t points)
{
  if (points > std::numeric_limits<std::int32_t>::max())
  {
    throw std::length_error("a piece has more than 2,147,483,647 points; use more ranks.");
  }
}

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
  requireShortIndices(part.count());
  part.fillPoints(rows, output);
  output->SetCells(
    size == 3 ? VTK_TRIANGLE : VTK_TETRA, takeCells(part.corners<std::int32_t>(), int(size)));
  part.addCellIds(0, 0, output);
}

namespace
{

/// Returns for each owned point whether it is in no cell of any rank, and no duplicate. Collective.
template <typename Mesh>
std::vector<char> findIsolated(Communicator& ranks, const Mesh& mine)
{
  std::vector<char> isIsolated(mine.Owned.size(), 1);
  const auto setUsed = [&isIsolated](std::int64_t index)
  {
    if (std::size_t(index) < isIsolated.size())
    {
      isIsolated[std::size_t(index)] = 0;
    }
  };
  mine.forEachCorner(setUsed);
  const std::int64_t first = mine.FirstIds[std::size_t(ranks.rank())];
  for (const std::vector<std::int64_t>& ids : findUsedByOthers(ranks, mine))
  {
    std::for_each(ids.begin(), ids.end(), [&](std::int64_t id) { setUsed(id - first); });
  }
  for (std::size_t i = 0; i < isIsolated.size(); ++i)
  {
    const auto found = std::lower_bound(
      mine.Duplicates.begin(), mine.Duplicates.end(), Duplicate{ mine.Owned.GlobalIds[i], 0 });
    const bool isDuplicate = found != mine.Duplicates.end() &&
      found->Point == mine.Owned.GlobalIds[i] && found->Representative != found->Point;
    isIsolated[i] = isDuplicate ? 0 : isIsolated[i];
  }
  return isIsolated;
}

/// Sets the points of the output, and returns the cells of the alpha shape that this rank outputs.
/// Collective.
template <typename Mesh, typename Ghosts>
AlphaShape<std::int32_t> fillAlphaPoints(Communicator& ranks, const Mesh& mine, std::size_t size,
  std::size_t cells, const PointRows& rows, const Ghosts& ghosts, const AlphaOptions& options,
  vtkPointSet* output)
{
  const std::vector<char> isIsolated = findIsolated(ranks, mine);
  const OutputPart<Mesh, Ghosts> part(mine, size, cells, ranks.rank(), &ghosts, isIsolated);
  requireShortIndices(part.count());
  AlphaShape<std::int32_t> shape = size == 3
    ? part.template alphaShare<3>(options.Alpha, isIsolated)
    : part.template alphaShare<4>(options.Alpha, isIsolated);
  std::vector<std::int64_t> newIndices(std::size_t(part.count()), -1);
  for (const auto& [list, isWanted] : { std::make_pair(&shape.Tetrahedra, options.Tetrahedra),
         std::make_pair(&shape.Triangles, options.Triangles),
         std::make_pair(&shape.Lines, options.Lines),
         std::make_pair(&shape.Vertices, options.Vertices) })
  {
    list->truncate(isWanted ? list->size() : 0);
    std::for_each(list->begin(), list->end(),
      [&newIndices](std::int32_t point) { newIndices[std::size_t(point)] = 0; });
  }
  std::int64_t used = 0;
  for (std::int64_t& newIndex : newIndices)
  {
    newIndex = newIndex < 0 ? -1 : used++;
  }
  for (Buffer<std::int32_t>* const list :
    { &shape.Tetrahedra, &shape.Triangles, &shape.Lines, &shape.Vertices })
  {
    std::transform(list->begin(), list->end(), list->begin(),
      [&newIndices](std::int32_t point) { return std::int32_t(newIndices[std::size_t(point)]); });
  }
  part.fillPoints(rows, output, newIndices);
  return shape;
}

/// Numbers the cells of all ranks' outputs. Collective.
void numberCells(Communicator& ranks, vtkPointSet* output)
{
  const vtkIdType count = output->GetNumberOfCells();
  vtkNew<vtkIdTypeArray> ids;
  ids->SetName("GlobalCellIds");
  ids->SetNumberOfValues(count);
  const std::int64_t first = firstIndices(ranks, count)[std::size_t(ranks.rank())];
  std::iota(ids->GetPointer(0), ids->GetPointer(0) + count, vtkIdType(first));
  output->GetCellData()->SetGlobalIds(ids);
}

} // namespace

void setAlphaCells(AlphaShape<std::int32_t>&& shape, vtkUnstructuredGrid* output)
{
  const std::size_t count = shape.Tetrahedra.size() / 4 + shape.Triangles.size() / 3 +
    shape.Lines.size() / 2 + shape.Vertices.size();
  output->Allocate(vtkIdType(count));
  const auto add = [output](const Buffer<std::int32_t>& cells, int type, int size)
  {
    for (const std::int32_t* cell = cells.begin(); cell != cells.end(); cell += size)
    {
      std::array<vtkIdType, 4> points;
      std::copy_n(cell, size, points.begin());
      output->InsertNextCell(type, size, points.data());
    }
  };
  add(shape.Tetrahedra, VTK_TETRA, 4);
  add(shape.Triangles, VTK_TRIANGLE, 3);
  add(shape.Lines, VTK_LINE, 2);
  add(shape.Vertices, VTK_VERTEX, 1);
}

void fillAlphaOutput(Communicator& ranks, const DistributedTriangulation& mine,
  const PointRows& rows, const GhostTriangles& ghosts, const AlphaOptions& options,
  vtkPolyData* output)
{
  AlphaShape<std::int32_t> shape =
    fillAlphaPoints(ranks, mine, 3, mine.triangleCount(), rows, ghosts, options, output);
  output->SetPolys(takeCells(std::move(shape.Triangles), 3));
  output->SetLines(takeCells(std::move(shape.Lines), 2));
  output->SetVerts(takeCells(std::move(shape.Vertices), 1));
  numberCells(ranks, output);
}

void fillAlphaOutput(Communicator& ranks, const DistributedTetrahedralization& mine,
  const PointRows& rows, const GhostTetrahedra& ghosts, const AlphaOptions& options,
  vtkUnstructuredGrid* output)
{
  setAlphaCells(
    fillAlphaPoints(ranks, mine, mine.cellSize(), mine.cellCount(), rows, ghosts, options, output),
    output);
  numberCells(ranks, output);
}

} // namespace tipp
