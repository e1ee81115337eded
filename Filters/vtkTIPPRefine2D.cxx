// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTIPPRefine2D.h"

#include "Files/PagedMemory.h"
#include "Parallel/ParallelFor.h"
#include "Pipeline/FilterPipeline.h"
#include "Pipeline/InputPoints.h"
#include "Pipeline/MeshOutput.h"
#include "Pipeline/SourceData.h"
#include "Refinement/MeshPoints.h"
#include "Sampling/SimplexParts.h"
#include "Vtk/DataSets.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <utility>

vtkStandardNewMacro(vtkTIPPRefine2D);

namespace
{

double limitOf(double largest)
{
  return largest > 0 ? largest : std::numeric_limits<double>::infinity();
}

/// Throws std::invalid_argument unless a property is finite and in its range.
void requireRange(const char* name, double value, double most)
{
  tipp::requireFinite({ { name, value } });
  if (!(value >= 0 && value <= most))
  {
    std::ostringstream text;
    text << name << " is " << value << "; give ";
    most < VTK_DOUBLE_MAX ? text << "a number from 0 to " << most << "." : text << "0 or more.";
    throw std::invalid_argument(text.str());
  }
}

tipp::Scalar scalarOf(vtkDataArray* array)
{
  using tipp::Scalar;
  if (array->GetDataType() == VTK_FLOAT || array->GetDataType() == VTK_DOUBLE)
  {
    return array->GetDataType() == VTK_FLOAT ? Scalar::Float32 : Scalar::Float64;
  }
  const bool isSigned = array->GetDataTypeMin() < 0;
  switch (array->GetDataTypeSize())
  {
    case 1:
      return isSigned ? Scalar::Int8 : Scalar::UInt8;
    case 2:
      return isSigned ? Scalar::Int16 : Scalar::UInt16;
    case 4:
      return isSigned ? Scalar::Int32 : Scalar::UInt32;
    default:
      return isSigned ? Scalar::Int64 : Scalar::UInt64;
  }
}

/// Sets the tuples of new points, which follow the first `points` ones.
void blend(const tipp::Buffer<tipp::PointBlend>& blends, vtkIdType points, vtkAbstractArray* array)
{
  vtkDataArray* const numbers = vtkDataArray::SafeDownCast(array);
  if (numbers && numbers->HasStandardMemoryLayout() && numbers->GetDataType() != VTK_BIT)
  {
    tipp::blendTuples(blends, std::size_t(points), scalarOf(numbers),
      std::size_t(numbers->GetNumberOfComponents()), numbers->GetVoidPointer(0));
    return;
  }
  vtkNew<vtkIdList> ids;
  ids->SetNumberOfIds(3);
  for (std::size_t i = 0; i < blends.size(); ++i)
  {
    std::copy(blends[i].Ids.begin(), blends[i].Ids.end(), ids->GetPointer(0));
    std::array<double, 3> weights = blends[i].Weights;
    array->InterpolateTuple(points + vtkIdType(i), ids, array, weights.data());
  }
}

/// Sets the output's points and point data: the input's, followed by the new points.
void setPoints(vtkPolyData* input, const tipp::PointsMesh& mesh, vtkPolyData* output)
{
  const vtkIdType points = input->GetNumberOfPoints();
  if (mesh.Blends.empty())
  {
    output->SetPoints(input->GetPoints());
    output->GetPointData()->PassData(input->GetPointData());
    return;
  }
  const vtkIdType total = points + vtkIdType(mesh.Blends.size());
  vtkNew<vtkDoubleArray> positions;
  positions->SetNumberOfComponents(3);
  positions->SetNumberOfTuples(total);
  positions->InsertTuples(0, points, 0, input->GetPoints()->GetData());
  blend(mesh.Blends, points, positions);
  double* to = positions->GetPointer(3 * points);
  for (std::size_t i = 0; i < mesh.Blends.size(); ++i, to += 3)
  {
    to[0] = mesh.NewXY[2 * i];
    to[1] = mesh.NewXY[2 * i + 1];
  }
  vtkNew<vtkPoints> all;
  all->SetData(positions);
  output->SetPoints(all);
  vtkPointData* const data = output->GetPointData();
  data->InterpolateAllocate(input->GetPointData(), total);
  data->SetNumberOfTuples(total);
  data->CopyData(input->GetPointData(), 0, points, 0);
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    blend(mesh.Blends, points, data->GetAbstractArray(i));
  }
}

/// The array of edge lengths at the points of a data set, as doubles.
std::vector<double> lengthsOf(vtkPointSet* data, const std::string& name, const char* what)
{
  vtkDataArray* const array = data->GetPointData()->GetArray(name.c_str());
  if (!array || array->GetNumberOfComponents() != 1)
  {
    throw std::runtime_error(std::string(what) + " has no point array '" + name +
      "' of one component, which SizeArrayName names.");
  }
  std::vector<double> lengths(std::size_t(data->GetNumberOfPoints()));
  for (std::size_t i = 0; i < lengths.size(); ++i)
  {
    lengths[i] = array->GetComponent(vtkIdType(i), 0);
  }
  return lengths;
}

/// The triangles of the second input, with the lengths at its points.
class SizeInput
{
public:
  SizeInput(vtkPointSet* data, const std::string& name, int threads)
    : Parts(tipp::makeSimplices(data, { 0, 1 }, threads))
    , Lengths(lengthsOf(data, name, "the mesh of sizes"))
  {
    const tipp::SimplexMesh& mesh = this->Parts.Triangles.Mesh;
    if (mesh.Cells == 0)
    {
      throw std::runtime_error("the mesh of sizes has no triangles; triangulate its points first.");
    }
    tipp::withAccess(mesh,
      [&](const auto& access)
      {
        for (std::int64_t cell = 0; cell < mesh.Cells; ++cell)
        {
          if (!mesh.Hidden || !mesh.Hidden[cell])
          {
            const auto* const ids = access.ids(cell);
            this->Corners.insert(this->Corners.end(), ids, ids + 3);
          }
        }
      });
  }

  tipp::LengthSurface surface() const
  {
    const tipp::SimplexMesh& mesh = this->Parts.Triangles.Mesh;
    const auto count = std::size_t(mesh.PointCount);
    return { mesh.Float ? tipp::PointsView(static_cast<const float*>(mesh.Points), count, 3)
                        : tipp::PointsView(static_cast<const double*>(mesh.Points), count, 3),
      this->Corners.data(), std::int64_t(this->Corners.size() / 3), this->Lengths.data() };
  }

private:
  tipp::SimplexParts Parts;
  std::vector<double> Lengths;
  std::vector<std::int32_t> Corners;
};

/// A cell array that is `forLines` for lines, which come first; set the values of triangles.
template <typename Array>
typename Array::ValueType* addCellArray(const char* name, vtkIdType lines,
  typename Array::ValueType forLines, vtkIdType triangles, vtkPolyData* output)
{
  vtkNew<Array> array;
  array->SetName(name);
  array->SetNumberOfValues(lines + triangles);
  std::fill_n(array->GetPointer(0), lines, forLines);
  output->GetCellData()->AddArray(array);
  return array->GetPointer(lines);
}

} // namespace

vtkTIPPRefine2D::vtkTIPPRefine2D()
{
  this->SetNumberOfInputPorts(2);
}

void vtkTIPPRefine2D::SetSizeData(vtkPointSet* data)
{
  this->SetInputData(1, data);
}

void vtkTIPPRefine2D::AddHole(double x, double y)
{
  this->Holes.push_back({ x, y });
  this->Modified();
}

void vtkTIPPRefine2D::ClearHoles()
{
  if (!this->Holes.empty())
  {
    this->Holes.clear();
    this->Modified();
  }
}

void vtkTIPPRefine2D::AddRegion(double x, double y, double area)
{
  this->Regions.push_back({ x, y, area });
  this->Modified();
}

void vtkTIPPRefine2D::ClearRegions()
{
  if (!this->Regions.empty())
  {
    this->Regions.clear();
    this->Modified();
  }
}

int vtkTIPPRefine2D::FillInputPortInformation(int port, vtkInformation* info)
{
  return tipp::acceptInput(info, port == 0 ? "vtkPolyData" : "vtkPointSet", port > 0);
}

int vtkTIPPRefine2D::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  return tipp::askForWholeInputs(inputs, 2);
}

int vtkTIPPRefine2D::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkPolyData* const input = vtkPolyData::GetData(inputs[0]);
  vtkPolyData* const output = vtkPolyData::GetData(outputs);
  output->Initialize();
  return tipp::triangulateReported(this, nullptr, this->NumberOfThreads, "Meshing", input, outputs,
    [&] { this->Execute(input, vtkPointSet::GetData(inputs[1]), output); }, {});
}

/// The request but for constraints and sizes.
tipp::MeshRequest vtkTIPPRefine2D::Request() const
{
  requireRange("MinimumAngle", this->MinimumAngle, tipp::RefinementOptions::LargestAngle);
  requireRange("MaximumArea", this->MaximumArea, VTK_DOUBLE_MAX);
  requireRange("ShortestEdge", this->ShortestEdge, VTK_DOUBLE_MAX);
  requireRange("MostPoints", double(this->MostPoints), VTK_DOUBLE_MAX);
  requireRange("SmoothingRounds", this->SmoothingRounds, VTK_DOUBLE_MAX);
  for (const auto& region : this->Regions)
  {
    requireRange("The area of a region", region[2], VTK_DOUBLE_MAX);
  }
  tipp::MeshRequest request;
  request.Crossings = this->SplitCrossings ? tipp::CrossingRule::Split : tipp::CrossingRule::Refuse;
  request.IsConvex = this->Convex != 0;
  request.HasValues = true;
  request.SmoothingRounds = this->SmoothingRounds;
  tipp::RefinementOptions& options = request.Refinement;
  options.MinimumAngle = this->MinimumAngle;
  options.LargestArea = limitOf(this->MaximumArea);
  for (const auto& [x, y, area] : this->Regions)
  {
    options.Regions.push_back({ { x, y }, limitOf(area) });
  }
  options.ShortestEdge = this->ShortestEdge;
  options.KeepsBorder = this->KeepBorder != 0;
  options.KeepsSegments = this->KeepSegments != 0;
  options.MostPoints = this->MostPoints;
  options.Threads = this->NumberOfThreads;
  return request;
}

void vtkTIPPRefine2D::Execute(vtkPolyData* input, vtkPointSet* sizes, vtkPolyData* output)
{
  tipp::checkDataSet(input, "the input", this->NumberOfThreads);
  tipp::MeshRequest request = this->Request();
  tipp::SourceConstraints source = tipp::readConstraints(input, {});
  for (const auto& [x, y] : this->Holes)
  {
    source.Holes.push_back({ x, y });
  }
  request.Source = &source;
  std::vector<double> lengths;
  std::optional<SizeInput> sizeInput;
  tipp::LengthSurface surface;
  if (sizes)
  {
    tipp::checkDataSet(sizes, "the mesh of sizes", this->NumberOfThreads);
    sizeInput.emplace(sizes, this->SizeArrayName, tipp::threadCount(this->NumberOfThreads));
    surface = sizeInput->surface();
    request.Surface = &surface;
  }
  else if (!this->SizeArrayName.empty())
  {
    lengths = lengthsOf(input, this->SizeArrayName, "the input");
    request.Lengths = lengths.data();
  }
  tipp::Monitor monitor(this);
  request.Refinement.Progress = [&monitor](double fraction) { return monitor(fraction); };
  const tipp::ProjectedPoints projected(input->GetPoints(), nullptr);
  std::vector<std::string> warnings;
  const std::unique_ptr<tipp::PagedMemory> memory = tipp::limitedMemory(
    this->ScratchFolder, std::uint64_t(this->MemoryLimit), "set ScratchFolder to another folder");
  request.Refinement.Memory = memory.get();
  tipp::PointsMesh mesh = tipp::meshPoints(projected.view(), request, warnings);
  if (mesh.Aborted || !monitor(1))
  {
    return;
  }
  tipp::warn(this, warnings);
  setPoints(input, mesh, output);
  this->AddCells(mesh, source.Cells, output);
}

/// Adds the triangles and, before them, the segments, with the cell arrays. `cells`: of each
/// constraint.
void vtkTIPPRefine2D::AddCells(
  tipp::PointsMesh& mesh, const std::vector<std::int64_t>& cells, vtkPolyData* output) const
{
  tipp::RefinedMesh& refined = mesh.Mesh;
  const auto triangles = vtkIdType(refined.triangleCount());
  const auto lines = this->GenerateSegments ? vtkIdType(refined.Segments.size()) : 0;
  if (this->GenerateSegments)
  {
    std::fill_n(addCellArray<vtkIdTypeArray>("ConstraintId", lines, -1, triangles, output),
      triangles, vtkIdType(-1));
    auto* const numbers =
      vtkIdTypeArray::SafeDownCast(output->GetCellData()->GetArray("ConstraintId"));
    tipp::Buffer<std::int32_t> ids(2 * std::size_t(lines));
    for (vtkIdType i = 0; i < lines; ++i)
    {
      const tipp::IdSegment& segment = refined.Segments[std::size_t(i)];
      ids[2 * std::size_t(i)] = std::int32_t(segment.A);
      ids[2 * std::size_t(i) + 1] = std::int32_t(segment.B);
      numbers->SetValue(i, segment.Constraint < 0 ? -1 : cells[std::size_t(segment.Constraint)]);
    }
    output->SetLines(tipp::takeCells(std::move(ids), 2));
  }
  if (!this->Regions.empty())
  {
    std::copy(refined.RegionOf.begin(), refined.RegionOf.end(),
      addCellArray<vtkIntArray>("Region", lines, -1, triangles, output));
  }
  unsigned char* const outside =
    addCellArray<vtkUnsignedCharArray>("OutsideBounds", lines, NOT_OUTSIDE, triangles, output);
  std::fill_n(outside, triangles, (unsigned char)(NOT_OUTSIDE));
  for (const tipp::TriangleOutside& triangle : refined.Outside)
  {
    outside[triangle.Triangle] = tipp::codeOf(triangle.Why);
  }
  output->SetPolys(tipp::takeCells(std::move(refined.Triangles), 3));
}

void vtkTIPPRefine2D::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  vtkTIPPPrintMacro(MinimumAngle);
  vtkTIPPPrintMacro(MaximumArea);
  vtkTIPPPrintMacro(SizeArrayName);
  os << indent << "Holes: " << this->Holes.size() << "\n";
  os << indent << "Regions: " << this->Regions.size() << "\n";
  vtkTIPPPrintMacro(ShortestEdge);
  vtkTIPPPrintMacro(KeepBorder);
  vtkTIPPPrintMacro(KeepSegments);
  vtkTIPPPrintMacro(Convex);
  vtkTIPPPrintMacro(SplitCrossings);
  vtkTIPPPrintMacro(GenerateSegments);
  vtkTIPPPrintMacro(MostPoints);
  vtkTIPPPrintMacro(SmoothingRounds);
  vtkTIPPPrintMacro(MemoryLimit);
  vtkTIPPPrintMacro(ScratchFolder);
  vtkTIPPPrintMacro(NumberOfThreads);
}
