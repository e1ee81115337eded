// SPDX-License-Identifier: BSD-3-Clause
#include "Output/TriangleOutput.h"

#include "Constraints/Insertion/CrossedPart.h"
#include "Meshes/MeshFiles.h"
#include "Output/PiecePoints.h"

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

/// The point type and arrays of one rank, or those that all ranks with points have in common.
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
    vtkNew<vtkIdTypeArray> exact; // doubles would round ids beyond 2^53
    exact->DeepCopy(ids);
    const vtkIdType* values = exact->GetPointer(0);
    this->GlobalIds.assign(values, values + exact->GetNumberOfTuples());
  }
}

void PointRows::describe(RankPointData& points) const
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

using TrianglePoints = PiecePoints<DistributedTriangulation, GhostTriangles>;

/// Returns the cell array "ConstraintEdges" of a piece's triangles, as constraintEdgesArray() makes
/// it.
vtkSmartPointer<vtkUnsignedCharArray> marksOf(const TrianglePoints& piece,
  const ConstraintSegments& segments, const Buffer<std::int64_t>& corners)
{
  std::vector<Point2> positions(std::size_t(piece.count()));
  piece.forEach([&](std::int64_t to, const PointTuples& tuples, std::size_t at, bool)
    { positions[std::size_t(to)] = tuples.Positions[at]; });
  auto marks = vtkSmartPointer<vtkUnsignedCharArray>::New();
  marks->SetName("ConstraintEdges");
  marks->SetNumberOfComponents(3);
  marks->SetNumberOfTuples(vtkIdType(corners.size() / 3));
  const PointsView view(positions);
  markEdges(view, segments, corners.data(), corners.size() / 3, marks->GetPointer(0));
  return marks;
}

void setLines(const TrianglePoints& piece, const ConstraintLines& lines, vtkIdType triangles,
  vtkPolyData* output)
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
  const TrianglePoints piece(mine, rank, ghosts);
  fillPoints(piece, rows, mine.RowSize, ghosts != nullptr, output);
  const std::size_t own = mine.triangleCount();
  const std::size_t more = ghosts ? ghosts->Cells.size() : 0;
  const std::size_t lines = marks.Lines ? marks.Lines->Ends.size() : 0;
  Buffer<std::int64_t> corners = cornersOf<std::int64_t>(piece, mine, 3, own, ghosts);
  if (marks.Flags)
  {
    output->GetCellData()->AddArray(marksOf(piece, *marks.Flags, corners));
  }
  if (marks.Lines)
  {
    setLines(piece, *marks.Lines, vtkIdType(own) + vtkIdType(more), output);
  }
  output->SetPolys(takeCells(std::move(corners), 3));
  // Lines are VTK's first cells, but their ids follow those of all triangles.
  setCellIds(
    marks.Lines ? mine.AllCells + marks.Lines->First : 0, lines, mine, own, ghosts, output);
  if (ghosts)
  {
    addCellGhosts(lines + own, more, output);
  }
}

} // namespace tipp
