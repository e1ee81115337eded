// SPDX-License-Identifier: BSD-3-Clause
#include "Output/TriangleOutput.h"

#include "Constraints/CrossedPart.h"
#include "Meshes/MeshFiles.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkTypeInt32Array.h"
#include "vtkTypeInt64Array.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cstring>
#include <utility>

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
    // If long and long long both have 64 bits, VTK's type may be the one that Value is not.
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
  const std::int64_t count = std::int64_t(cells + 1);
#pragma omp parallel for
  for (std::int64_t i = 0; i < count; ++i)
  {
    result[i] = Value(i * cellSize);
  }
  return result;
}

Buffer<std::int64_t> widened(const Buffer<std::int32_t>& ids)
{
  Buffer<std::int64_t> result(ids.size());
  const std::int64_t count = std::int64_t(ids.size());
#pragma omp parallel for
  for (std::int64_t i = 0; i < count; ++i)
  {
    result[i] = ids[i];
  }
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
  const auto array = takeArray<vtkIdTypeArray>(std::move(values));
  array->SetName(name.c_str());
  array->SetNumberOfComponents(components);
  return array;
}

vtkSmartPointer<vtkUnsignedCharArray> takeArray(
  const std::string& name, Buffer<unsigned char> values, int components)
{
  const auto array = takeArray<vtkUnsignedCharArray>(std::move(values));
  array->SetName(name.c_str());
  array->SetNumberOfComponents(components);
  return array;
}

template <typename Archive>
void serialize(Archive& archive, PointRows::Column& column)
{
  archive(column.Name, column.Type, column.Components, column.Size);
}

namespace
{

std::vector<PointRows::Column> columnsOf(vtkPointSet* input)
{
  std::vector<PointRows::Column> columns;
  vtkPointData* data = input->GetPointData();
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = data->GetArray(i);
    const bool isOwn = array && array != data->GetGlobalIds() && array->GetName() &&
      std::string(array->GetName()) != vtkDataSetAttributes::GhostArrayName();
    if (isOwn && array->GetDataTypeSize() > 0)
    {
      const int components = array->GetNumberOfComponents();
      columns.push_back({ array->GetName(), array->GetDataType(), components,
        std::size_t(components) * std::size_t(array->GetDataTypeSize()) });
    }
  }
  return columns;
}

/// The properties of a rank's points, or those that all ranks' points have in common.
struct PointKinds
{
  bool HasPoints = false;
  bool HasIds = false;
  bool HasDoubles = false;
  std::vector<PointRows::Column> Columns;
};

template <typename Archive>
void serialize(Archive& archive, PointKinds& kinds)
{
  archive(kinds.HasPoints, kinds.HasIds, kinds.HasDoubles, kinds.Columns);
}

bool same(const PointRows::Column& a, const PointRows::Column& b)
{
  return a.Name == b.Name && a.Type == b.Type && a.Components == b.Components;
}

} // namespace

PointRows::PointRows(Communicator& ranks, vtkPointSet* input)
{
  const bool hasPoints = input->GetNumberOfPoints() > 0;
  vtkDataArray* ids = hasPoints ? input->GetPointData()->GetGlobalIds() : nullptr;
  PointKinds mine;
  mine.HasPoints = hasPoints;
  mine.HasIds = ids != nullptr;
  mine.HasDoubles = hasPoints && input->GetPoints()->GetDataType() != VTK_FLOAT;
  mine.Columns = hasPoints ? columnsOf(input) : std::vector<Column>();
  PointKinds agreed;
  for (const PointKinds& other : ranks.gather(mine))
  {
    if (!other.HasPoints)
    {
      continue;
    }
    std::vector<Column>& common = agreed.Columns;
    common.erase(std::remove_if(common.begin(), common.end(),
                   [&](const Column& column)
                   {
                     return std::none_of(other.Columns.begin(), other.Columns.end(),
                       [&](const Column& of) { return same(column, of); });
                   }),
      common.end());
    common = agreed.HasPoints ? common : other.Columns;
    agreed.HasIds = other.HasIds && (agreed.HasIds || !agreed.HasPoints);
    agreed.HasDoubles = other.HasDoubles || agreed.HasDoubles;
    agreed.HasPoints = true;
  }
  agreed = ranks.broadcast(agreed);
  this->Doubles = agreed.HasDoubles;
  this->Columns = agreed.Columns;
  if (!hasPoints)
  {
    return;
  }
  this->Coordinates = input->GetPoints()->GetData();
  for (const Column& column : this->Columns)
  {
    this->Arrays.push_back(input->GetPointData()->GetArray(column.Name.c_str()));
    this->Values.push_back(static_cast<const char*>(this->Arrays.back()->GetVoidPointer(0)));
  }
  if (agreed.HasIds)
  {
    vtkNew<vtkIdTypeArray> exact; // a double would round ids beyond 2^53
    exact->DeepCopy(ids);
    const vtkIdType* values = exact->GetPointer(0);
    this->GlobalIds.assign(values, values + exact->GetNumberOfTuples());
  }
}

void PointRows::describe(RankPoints& points) const
{
  points.GlobalIds = this->GlobalIds.empty() ? nullptr : this->GlobalIds.data();
  points.RowSize = 3 * sizeof(double);
  for (const Column& column : this->Columns)
  {
    points.RowSize += column.Size;
  }
  points.PackRow = [this](std::size_t i, char* to)
  {
    double position[3];
    this->Coordinates->GetTuple(vtkIdType(i), position);
    std::memcpy(to, position, sizeof(position));
    to += sizeof(position);
    for (std::size_t c = 0; c < this->Columns.size(); ++c)
    {
      const std::size_t size = this->Columns[c].Size;
      std::memcpy(to, this->Values[c] + i * size, size);
      to += size;
    }
  };
}

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
    , Indices(mine.Owned.size() + mine.Foreign.size(), -1)
  {
    const auto mark = [this](const auto& ids)
    {
      for (const auto index : ids)
      {
        this->Indices[std::size_t(index)] = 0;
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

  std::int64_t count() const
  {
    return this->Count + (this->Ghosts ? std::int64_t(this->Ghosts->PointIds.size()) : 0);
  }
  std::int64_t ofLocalIndex(std::size_t index) const { return this->Indices[index]; }
  std::int64_t ofId(std::int64_t id) const
  {
    const std::ptrdiff_t index = this->localIndexOf(id);
    return index >= 0 ? this->Indices[std::size_t(index)]
                      : this->Count + rankOf(this->Ghosts->PointIds, id);
  }

  /// Calls visit(point index in the piece, tuples, index in tuples, whether this rank owns the
  /// point).
  template <typename Visit>
  void forEach(Visit&& visit) const
  {
    const std::size_t own = this->Mine.Owned.size();
    for (std::size_t i = 0; i < this->Indices.size(); ++i)
    {
      if (this->Indices[i] >= 0)
      {
        const bool isOwn = i < own;
        visit(this->Indices[i], isOwn ? this->Mine.Owned : this->Mine.Foreign, isOwn ? i : i - own,
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
  std::ptrdiff_t localIndexOf(std::int64_t id) const
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
  std::vector<std::int64_t> Indices; ///< of owned, then foreign points: index in the piece, or -1
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

/// "ConstraintEdges" of triangles, as constraintEdgesArray() makes it.
vtkSmartPointer<vtkUnsignedCharArray> marksOf(
  const PiecePoints& piece, const ConstraintSegments& segments, const Buffer<std::int64_t>& corners)
{
  std::vector<Point2> positions(std::size_t(piece.count()));
  piece.forEach([&](std::int64_t to, const PointTuples& tuples, std::size_t at, bool)
    { positions[std::size_t(to)] = tuples.Positions[at]; });
  auto marks = vtkSmartPointer<vtkUnsignedCharArray>::New();
  marks->SetName("ConstraintEdges");
  marks->SetNumberOfComponents(3);
  marks->SetNumberOfTuples(vtkIdType(corners.size() / 3));
  const PointsView view(positions.empty() ? nullptr : &positions.front().x, positions.size(), 2);
  markEdges(view, segments, corners.data(), corners.size() / 3, marks->GetPointer(0));
  return marks;
}

void setLines(
  const PiecePoints& piece, const ConstraintLines& lines, vtkIdType triangles, vtkPolyData* output)
{
  Buffer<std::int64_t> ends(2 * lines.Ends.size());
  std::int64_t* to = ends.data();
  for (const auto& line : lines.Ends)
  {
    to = std::transform(line.begin(), line.end(), to,
      [&piece](std::int64_t index) { return piece.ofLocalIndex(std::size_t(index)); });
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

void fillPiece(const DistributedTriangulation& mine, int rank, const PointRows& rows,
  const GhostTriangles* ghosts, const PieceMarks& marks, vtkPolyData* output)
{
  const PiecePoints piece(mine, rank, ghosts);
  fillPoints(piece, rows, mine.RowSize, ghosts != nullptr, output);
  const std::size_t own = mine.triangleCount();
  const std::size_t more = ghosts ? ghosts->Triangles.size() : 0;
  const std::size_t lines = marks.Lines ? marks.Lines->Ends.size() : 0;
  Buffer<std::int64_t> corners(3 * (own + more));
  std::int64_t* to = corners.data();
  const auto add = [&](const auto& ids)
  {
    for (const auto index : ids)
    {
      *to++ = piece.ofLocalIndex(std::size_t(index));
    }
  };
  add(mine.Ids32);
  add(mine.Ids64);
  vtkNew<vtkIdTypeArray> numbers; // lines are the first cells but get ids after all triangles
  numbers->SetName("GlobalCellIds");
  numbers->SetNumberOfValues(vtkIdType(lines + own + more));
  vtkIdType* number = numbers->GetPointer(0);
  for (std::size_t i = 0; i < lines; ++i)
  {
    *number++ = vtkIdType(mine.AllTriangles + marks.Lines->First + std::int64_t(i));
  }
  for (std::size_t i = 0; i < own; ++i)
  {
    *number++ = vtkIdType(mine.FirstTriangle + std::int64_t(i));
  }
  for (std::size_t i = 0; i < more; ++i)
  {
    *number++ = vtkIdType(ghosts->Numbers[i]);
    for (const std::int64_t id : ghosts->Triangles[i])
    {
      *to++ = piece.ofId(id);
    }
  }
  if (marks.Flags)
  {
    output->GetCellData()->AddArray(marksOf(piece, *marks.Flags, corners));
  }
  if (marks.Lines)
  {
    setLines(piece, *marks.Lines, vtkIdType(own + more), output);
  }
  output->SetPolys(takeCells(std::move(corners), 3));
  output->GetCellData()->SetGlobalIds(numbers);
  if (ghosts)
  {
    vtkNew<vtkUnsignedCharArray> ghost;
    ghost->SetName(vtkDataSetAttributes::GhostArrayName());
    ghost->SetNumberOfValues(vtkIdType(lines + own + more));
    std::fill_n(ghost->GetPointer(0), lines + own, static_cast<unsigned char>(0));
    std::fill_n(ghost->GetPointer(0) + lines + own, more,
      static_cast<unsigned char>(vtkDataSetAttributes::DUPLICATECELL));
    output->GetCellData()->AddArray(ghost);
  }
}

} // namespace tipp
