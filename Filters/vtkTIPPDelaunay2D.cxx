// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTIPPDelaunay2D.h"

#include "Distributed/ConstrainRanks.h"
#include "Distributed/DistributedTriangulation.h"
#include "Distributed/MergedRankPoints.h"
#include "InMemory/AlphaShape.h"
#include "InMemory/TriangulatePoints.h"
#include "Parallel/Stopwatch.h"
#include "Pipeline/FilterPipeline.h"
#include "Pipeline/InputPoints.h"
#include "Pipeline/MeshOutput.h"
#include "Pipeline/RankSource.h"
#include "Pipeline/SourceData.h"
#include "Statistics/RunStatistics.h"
#include "Vtk/DataSets.h"

#include "vtkCellData.h"
#include "vtkErrorCode.h"
#include "vtkExecutive.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkTable.h"
#include "vtkTransform.h"

#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkTIPPDelaunay2D);

namespace
{

void checkProperties(vtkTIPPDelaunay2D* filter)
{
  tipp::requireFinite(
    { { "Alpha", filter->GetAlpha() }, { "MaximumEdgeLength", filter->GetMaximumEdgeLength() },
      { "Tolerance", filter->GetTolerance() }, { "Offset", filter->GetOffset() } });
  if (filter->GetProjectionPlaneMode() == VTK_SET_TRANSFORM_PLANE && !filter->GetTransform())
  {
    throw std::invalid_argument("ProjectionPlaneMode is VTK_SET_TRANSFORM_PLANE, but there is no "
                                "Transform: call SetTransform, or choose another mode.");
  }
}

constexpr const char* NoBounds =
  "No BoundingTriangulation: only the x-y plane has one, without a transform.";
constexpr const char* NoNeighborsWithLines = "No NeighborIds: the output has lines, too.";
constexpr const char* NoNeighborsOfAlpha =
  "No NeighborIds: with Alpha not all triangles are output.";
constexpr const char* NoMarksOfAlpha =
  "No marks of constraints: with Alpha not all triangles are output.";

void requireNoTolerance(double tolerance)
{
  if (tolerance > 0)
  {
    throw std::runtime_error(
      "a Tolerance does not go with a source: set it to 0, which merges points at one position.");
  }
}

tipp::CrossingRule crossingRule(vtkTIPPDelaunay2D* filter)
{
  return filter->GetSplitCrossings() ? tipp::CrossingRule::Split : tipp::CrossingRule::Refuse;
}

tipp::DistributedOptions optionsFor(vtkTIPPDelaunay2D* filter)
{
  const tipp::RankSchedule schedules[] = { tipp::RankSchedule::Stages, tipp::RankSchedule::Dynamic,
    tipp::RankSchedule::ProducerConsumer };
  const tipp::Masters masters[] = { tipp::Masters::Auto, tipp::Masters::Single,
    tipp::Masters::Multi };
  tipp::DistributedOptions options;
  options.Order = schedules[filter->GetSchedule()];
  options.Design = masters[filter->GetMasters()];
  options.Major = { filter->GetNumberOfMajorPartitions()[0],
    filter->GetNumberOfMajorPartitions()[1] };
  options.Minor = { filter->GetNumberOfPartitions()[0], filter->GetNumberOfPartitions()[1] };
  options.MinorDivision = options.Minor.isGiven()                ? tipp::Division::Grid
    : filter->GetMinorDivision() == vtkTIPPDelaunay2D::THRESHOLD ? tipp::Division::Threshold
                                                                 : tipp::Division::Tree;
  options.Threshold = filter->GetPointsPerPartition();
  options.Groups =
    filter->GetEqualGroups() ? tipp::GroupSizes::Equal : tipp::GroupSizes::Proportional;
  options.InitialPointsPerPartition = filter->GetInitialPointsPerPartition();
  options.Threads = filter->GetNumberOfThreads();
  return options;
}

} // namespace

vtkTIPPDelaunay2D::vtkTIPPDelaunay2D()
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(2);
  this->Controller = vtkMultiProcessController::GetGlobalController();
  tipp::useCollectivePipeline(this, [this] { return this->Controller; });
}

void vtkTIPPDelaunay2D::SetSourceData(vtkPolyData* source)
{
  this->SetInputData(1, source);
}

vtkPolyData* vtkTIPPDelaunay2D::GetSource()
{
  return this->GetNumberOfInputConnections(1) < 1
    ? nullptr
    : vtkPolyData::SafeDownCast(this->GetExecutive()->GetInputData(1, 0));
}

vtkTable* vtkTIPPDelaunay2D::GetStatistics()
{
  return vtkTable::SafeDownCast(this->GetOutputDataObject(1));
}

vtkMTimeType vtkTIPPDelaunay2D::GetMTime()
{
  const vtkMTimeType own = this->Superclass::GetMTime();
  return this->Transform ? std::max(own, this->Transform->GetMTime()) : own;
}

int vtkTIPPDelaunay2D::FillInputPortInformation(int port, vtkInformation* info)
{
  return tipp::acceptInput(info, port == 0 ? "vtkPointSet" : "vtkPolyData", port == 1);
}

int vtkTIPPDelaunay2D::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 0 ? "vtkPolyData" : "vtkTable");
  return 1;
}

vtkAbstractTransform* vtkTIPPDelaunay2D::ComputeBestFittingPlane(vtkPointSet* input)
{
  const auto transform = tipp::bestFittingPlane(input ? input->GetPoints() : nullptr);
  if (transform)
  {
    transform->Register(nullptr);
  }
  return transform;
}

int vtkTIPPDelaunay2D::RequestUpdateExtent(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  return tipp::askForUpdatePieces(this->Controller, inputVector, this->GetNumberOfInputPorts())
    ? 1
    : this->Superclass::RequestUpdateExtent(request, inputVector, outputVector);
}

int vtkTIPPDelaunay2D::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkPointSet* input = vtkPointSet::GetData(inputVector[0]);
  vtkPolyData* source = vtkPolyData::GetData(inputVector[1]);
  this->NumberOfDuplicatePoints = 0;
  this->NumberOfRejectedPoints = 0;
  const int isDone = tipp::triangulateReported(
    this, this->Controller, this->NumberOfThreads, "Triangulating", input, outputVector,
    [&] { this->Execute(input, source, outputVector); },
    [&] { this->ExecuteOnRanks(input, source, outputVector); });
  if (!isDone && tipp::hasSeveralRanks(this->Controller))
  {
    this->SetErrorCode(vtkErrorCode::UserError); // not every rank reports the error
  }
  return isDone;
}

void vtkTIPPDelaunay2D::Execute(
  vtkPointSet* given, vtkPolyData* source, vtkInformationVector* outputs)
{
  vtkPolyData* const output = vtkPolyData::GetData(outputs, 0);
  checkProperties(this);
  tipp::checkPoints(given, "the input");
  vtkSmartPointer<vtkAbstractTransform> toPlane = this->Transform;
  if (this->ProjectionPlaneMode == VTK_BEST_FITTING_PLANE)
  {
    toPlane = tipp::bestFittingPlane(given->GetPoints());
  }
  if (this->BoundingTriangulation && toPlane)
  {
    vtkWarningMacro(<< NoBounds);
  }
  tipp::SourceConstraints constraints;
  const vtkSmartPointer<vtkPointSet> input = source
    ? this->ReadSource(given, source, toPlane, constraints)
    : vtkSmartPointer<vtkPointSet>(given);
  vtkSmartPointer<vtkPoints> points = input->GetPoints();
  const bool bounding = this->BoundingTriangulation && !toPlane && points;
  if (bounding)
  {
    points =
      tipp::appendPoints(points, tipp::boundingCircle(tipp::finiteBounds(points), this->Offset));
  }

  tipp::ConstrainedTriangulation result = this->Triangulate(points, toPlane, constraints);
  tipp::Triangulation& triangulation = result.Mesh;
  if (triangulation.Aborted)
  {
    return;
  }
  this->NumberOfDuplicatePoints = vtkIdType(triangulation.Duplicates.size());
  this->NumberOfRejectedPoints = vtkIdType(triangulation.Rejected.size());

  const tipp::Stopwatch watch;
  const auto& crossings = result.Constraints.Crossings;
  const vtkIdType ownPoints = points ? points->GetNumberOfPoints() : 0;
  output->SetPoints(
    crossings.empty() ? points : tipp::appendCrossings(points, crossings, !toPlane));
  if (!bounding && crossings.empty())
  {
    output->GetPointData()->PassData(input->GetPointData());
  }
  else if (!bounding)
  {
    tipp::interpolateCrossings(input->GetPointData(), ownPoints, crossings, output->GetPointData());
  }
  const vtkIdType numberOfPoints = ownPoints + vtkIdType(crossings.size());
  const std::size_t triangles = triangulation.triangleCount();
  this->AddArrays(result, source != nullptr, numberOfPoints, output);
  this->SetCells(triangulation, output);
  if (source && this->ConstraintMarks == LINES && this->Alpha == 0)
  {
    tipp::addConstraintLines(result.Constraints, constraints.Cells, output);
  }
  triangulation.Statistics.Phases.push_back({ "VTK output", watch.seconds() });
  tipp::RunStatistics run = tipp::statisticsOf(triangulation, numberOfPoints, vtkIdType(triangles));
  if (source)
  {
    tipp::addConstraintTotals({ result.Constraints, constraints.Constraints.size() }, run);
  }
  tipp::fillStatisticsTable(run, vtkTable::GetData(outputs, 1));
}

/// Returns the input or, with MergeSourcePoints, the input followed by the source's new points.
vtkSmartPointer<vtkPointSet> vtkTIPPDelaunay2D::ReadSource(vtkPointSet* input, vtkPolyData* source,
  vtkAbstractTransform* toPlane, tipp::SourceConstraints& constraints)
{
  requireNoTolerance(this->Tolerance);
  tipp::JoinedPoints joined;
  joined.Data = input;
  if (this->MergeSourcePoints && source->GetNumberOfPoints() > 0)
  {
    tipp::checkDataSet(source, "the source");
    joined = tipp::joinPoints(input, source, toPlane);
  }
  if (joined.LostArrays > 0)
  {
    vtkWarningMacro(<< joined.LostArrays
                    << " point arrays of the input are left out: the source has "
                    << joined.NewPoints << " new points and no values of these arrays.");
  }
  constraints = tipp::readConstraints(source, joined.Ids);
  tipp::requireIds(constraints, joined.Data->GetNumberOfPoints());
  return joined.Data;
}

tipp::ConstrainedTriangulation vtkTIPPDelaunay2D::Triangulate(
  vtkPoints* points, vtkAbstractTransform* toPlane, const tipp::SourceConstraints& constraints)
{
  const tipp::Stopwatch watch;
  const tipp::ProjectedPoints projected(points, toPlane);
  tipp::Monitor monitor(this);
  tipp::PointsRequest request;
  request.Distance = tipp::toleratedDistance(this->Tolerance, points);
  request.Source = &constraints;
  request.Crossings = crossingRule(this);
  tipp::TriangulationOptions& options = request.Options;
  options.Columns = this->NumberOfPartitions[0];
  options.Rows = this->NumberOfPartitions[1];
  options.InitialPointsPerPartition = this->InitialPointsPerPartition;
  options.Order = this->Schedule == DYNAMIC ? tipp::Schedule::Dynamic : tipp::Schedule::Stages;
  options.Threads = this->NumberOfThreads;
  options.MaximumEdge = this->MaximumEdgeLength;
  options.Progress = [&monitor](double fraction) { return monitor(fraction); };
  const double projectionSeconds = watch.seconds();

  tipp::ConstrainedTriangulation result;
  std::vector<std::string> warnings;
  result.Mesh.Aborted = !monitor(0);
  if (!result.Mesh.Aborted)
  {
    result = tipp::triangulatePoints(projected.view(), request, warnings);
    // A single partition is triangulated without progress reports.
    result.Mesh.Aborted = result.Mesh.Aborted || !monitor(1);
  }
  if (!result.Mesh.Aborted)
  {
    tipp::warn(this, warnings);
  }
  auto& phases = result.Mesh.Statistics.Phases;
  phases.insert(phases.begin(), { "projection", projectionSeconds });
  return result;
}

void vtkTIPPDelaunay2D::AddArrays(const tipp::ConstrainedTriangulation& result, bool hasSource,
  vtkIdType points, vtkPolyData* output)
{
  if (this->GenerateRepresentativeIds &&
    (this->NumberOfDuplicatePoints > 0 || this->NumberOfRejectedPoints > 0))
  {
    output->GetPointData()->AddArray(
      tipp::takeArray("RepresentativePointId", tipp::representativeIds(result.Mesh, points), 1));
  }
  const bool hasLines = hasSource && this->ConstraintMarks == LINES;
  if (this->GenerateNeighborIds && this->Alpha == 0 && !hasLines)
  {
    output->GetCellData()->AddArray(
      tipp::takeArray("NeighborIds", tipp::neighborIds(result.Mesh), 3));
  }
  else if (this->GenerateNeighborIds)
  {
    vtkWarningMacro(<< (hasLines ? NoNeighborsWithLines : NoNeighborsOfAlpha));
  }
  if (hasSource && this->ConstraintMarks != NO_MARKS && this->Alpha != 0)
  {
    vtkWarningMacro(<< NoMarksOfAlpha);
  }
  else if (hasSource && this->ConstraintMarks == EDGE_FLAGS)
  {
    output->GetCellData()->AddArray(tipp::takeArray(
      "ConstraintEdges", tipp::constraintMarks(result.Mesh, result.Constraints.Segments), 3));
  }
}

void vtkTIPPDelaunay2D::SetCells(tipp::Triangulation& triangulation, vtkPolyData* output) const
{
  auto setCells = [&](auto& ids)
  {
    if (this->Alpha == 0)
    {
      output->SetPolys(tipp::takeCells(std::move(ids), 3));
      return;
    }
    const auto pointAt = [points = output->GetPoints()](tipp::PointId id, double* p)
    { points->GetPoint(vtkIdType(id), p); };
    auto shape = tipp::alphaShape(
      ids, pointAt, this->Alpha, tipp::findLeftOut(triangulation, output->GetNumberOfPoints()));
    if (this->AlphaTris)
    {
      output->SetPolys(tipp::takeCells(std::move(shape.Triangles), 3));
    }
    if (this->AlphaLines)
    {
      output->SetLines(tipp::takeCells(std::move(shape.Lines), 2));
    }
    if (this->AlphaVerts)
    {
      output->SetVerts(tipp::takeCells(std::move(shape.Vertices), 1));
    }
  };
  triangulation.Ids64.empty() ? setCells(triangulation.Ids32) : setCells(triangulation.Ids64);
}

namespace
{

/// Returns the points with those of a bounding triangulation. `positions`: their positions in the
/// plane, if these are not those of the points; empty otherwise.
vtkSmartPointer<vtkPointSet> withBounds(tipp::Communicator& ranks, vtkPointSet* input,
  double offset, std::vector<tipp::Point2>* positions)
{
  const tipp::Box3 bounds = tipp::finiteBounds(input->GetPoints(), &ranks);
  const std::vector<tipp::Point3> circle = tipp::boundingCircle(bounds, offset);
  if (positions && !positions->empty() && ranks.rank() == ranks.size() - 1)
  {
    std::transform(circle.begin(), circle.end(), std::back_inserter(*positions),
      [](const tipp::Point3& p) { return tipp::projected<2>(p); });
  }
  return tipp::withPointsOnLast(ranks, input, circle);
}

/// A rank's input.
struct RankInput
{
  vtkPointSet* Data;
  vtkAbstractTransform* ToPlane;  ///< null: z is dropped
  const tipp::RankSource* Source; ///< null: no rank has a source
  const tipp::PointRows& Rows;
};

/// Triangulates all ranks' points. Merges those within the tolerance, inserts the constraints, and
/// leaves out triangles with an edge longer than `longest`.
tipp::DistributedTriangulation triangulateInput(tipp::Communicator& ranks, const RankInput& input,
  double tolerance, double longest, const tipp::DistributedOptions& options)
{
  const tipp::ProjectedPoints projected(input.Data->GetPoints(), input.ToPlane);
  const bool isMoved = input.Source && !input.Source->Positions.empty();
  tipp::RankPoints points;
  points.Points = isMoved ? tipp::PointsView(input.Source->Positions) : projected.view();
  input.Rows.describe(points);
  tipp::DistributedTriangulation mine = tipp::triangulateMerged(ranks, points,
    tipp::toleratedDistance(tolerance, input.Data->GetPoints(), &ranks),
    [&](const tipp::RankPoints& left)
    { return tipp::triangulateDistributed(ranks, left, options); });
  if (input.Source)
  {
    tipp::constrainRanks(ranks, *input.Source->Segments, options.Threads, mine);
  }
  tipp::leaveOutLong(ranks, longest, mine);
  return mine;
}

/// How a rank's output is made. Members that say 'all' are the same on all ranks.
struct RankOutput
{
  bool HasGhosts;     ///< with ghosts on this rank
  bool FetchesGhosts; ///< all: a rank has ghosts
  bool AddsNeighbors; ///< all: with NeighborIds
  bool FindsLines;    ///< all: a rank marks constraints by lines
  int Marks;          ///< ConstraintMarks of this rank
  tipp::AlphaOptions Alpha;
};

void fillRankOutput(tipp::Communicator& ranks, const tipp::DistributedTriangulation& mine,
  const RankInput& input, const RankOutput& how, vtkPolyData* output)
{
  const bool hasAlpha = how.Alpha.Alpha != 0;
  const tipp::GhostTriangles ghosts = how.FetchesGhosts || how.AddsNeighbors || hasAlpha
    ? tipp::fetchGhosts(ranks, mine)
    : tipp::GhostTriangles();
  if (hasAlpha)
  {
    tipp::fillAlphaOutput(ranks, mine, input.Rows, ghosts, how.Alpha, output);
    return;
  }
  const tipp::RankSource* const source = input.Source;
  tipp::ConstraintLines lines;
  if (how.FindsLines)
  {
    lines =
      tipp::findConstraintLines(ranks, { *source->Segments, source->Order, source->Cells }, mine);
  }
  tipp::ConstraintMarks marks;
  marks.Flags =
    source && how.Marks == vtkTIPPDelaunay2D::EDGE_FLAGS ? source->Segments.get() : nullptr;
  marks.Lines = source && how.Marks == vtkTIPPDelaunay2D::LINES ? &lines : nullptr;
  tipp::fillOutput(
    mine, ranks.rank(), input.Rows, how.HasGhosts ? &ghosts : nullptr, marks, output);
  if (how.AddsNeighbors)
  {
    tipp::addNeighborIds(tipp::neighborIds(ranks, mine, ghosts), 3, output);
  }
}

} // namespace

void vtkTIPPDelaunay2D::ExecuteOnRanks(
  vtkPointSet* given, vtkPolyData* source, vtkInformationVector* outputs)
{
  vtkPolyData* const output = vtkPolyData::GetData(outputs, 0);
  const bool wantsGhosts = tipp::wantsGhosts(outputs);
  tipp::Communicator ranks(this->Controller);
  tipp::DistributedTriangulation mine;
  std::optional<tipp::RankSource> shared; // if a rank has a source
  std::vector<std::string> warnings;
  const auto run = [&]()
  {
    checkProperties(this);
    tipp::Monitor monitor(this);
    tipp::DistributedOptions options = optionsFor(this);
    options.Progress = [&monitor](double fraction) { return monitor(fraction); };
    tipp::checkPoints(given, "the input");
    // All ranks must take the same collective steps, even if their properties differ, so those of
    // the first rank count.
    const auto [alpha, tolerance, longest, gathers, addsBounds, findsNeighbors, fitsPlane] =
      ranks.broadcast(std::array<double, 7>{ this->Alpha, this->Tolerance, this->MaximumEdgeLength,
        double(this->GatherOnFirstRank), double(this->BoundingTriangulation),
        double(this->GenerateNeighborIds),
        double(this->ProjectionPlaneMode == VTK_BEST_FITTING_PLANE) });
    vtkSmartPointer<vtkAbstractTransform> toPlane = this->Transform;
    if (fitsPlane != 0)
    {
      toPlane = tipp::bestFittingPlane(given->GetPoints(), &ranks);
    }
    std::vector<std::int64_t> wishes{ wantsGhosts, this->ConstraintMarks == LINES,
      source != nullptr, toPlane != nullptr };
    ranks.sum(wishes);
    if (wishes[2] > 0)
    {
      requireNoTolerance(tolerance);
      const tipp::RankSourceOptions how{ this->MergeSourcePoints != 0, crossingRule(this),
        wishes[1] > 0, toPlane, this->NumberOfThreads };
      shared = tipp::shareSource(ranks, given, source, how);
    }
    vtkSmartPointer<vtkPointSet> input = shared ? shared->Input.Get() : given;
    if (addsBounds != 0 && wishes[3] == 0)
    {
      input = withBounds(ranks, input, this->Offset, shared ? &shared->Positions : nullptr);
    }
    else if (addsBounds != 0)
    {
      warnings.emplace_back(NoBounds);
    }
    const tipp::PointRows rows(ranks, input);
    const RankInput rankInput{ input, toPlane, shared ? &*shared : nullptr, rows };
    mine = triangulateInput(ranks, rankInput, tolerance, longest, options);
    if (gathers != 0)
    {
      mine = tipp::gatherOnFirst(ranks, std::move(mine));
    }
    const bool hasLines = shared && wishes[1] > 0 && alpha == 0;
    const bool addsNeighbors = findsNeighbors != 0 && !hasLines && alpha == 0;
    fillRankOutput(ranks, mine, rankInput,
      { wantsGhosts, wishes[0] > 0, addsNeighbors, hasLines, this->ConstraintMarks,
        { alpha, false, this->AlphaTris != 0, this->AlphaLines != 0, this->AlphaVerts != 0 } },
      output);
    if (findsNeighbors != 0 && !addsNeighbors)
    {
      warnings.emplace_back(hasLines ? NoNeighborsWithLines : NoNeighborsOfAlpha);
    }
    if (shared && this->ConstraintMarks != NO_MARKS && alpha != 0)
    {
      warnings.emplace_back(NoMarksOfAlpha);
    }
    if (this->GenerateRepresentativeIds)
    {
      tipp::addDuplicatesAndRejected(mine.Duplicates, mine.Rejected, output);
    }
    tipp::RunStatistics all = tipp::statisticsOf(mine);
    if (shared)
    {
      tipp::addConstraintTotals(shared->Figures, all);
    }
    tipp::fillStatisticsTable(all, vtkTable::GetData(outputs, 1));
  };
  ranks.together(run);
  this->NumberOfDuplicatePoints = mine.AllDuplicates;
  this->NumberOfRejectedPoints = mine.AllRejected;
  const std::vector<std::string> more = tipp::warningsOf(mine, this->MaximumEdgeLength > 0);
  warnings.insert(warnings.end(), more.begin(), more.end());
  if (shared && shared->Figures.NotFinite > 0)
  {
    warnings.push_back(std::to_string(shared->Figures.NotFinite) +
      " edges of the source have an end that is NaN or infinite and are left out.");
  }
  if (ranks.isFirst())
  {
    tipp::warn(this, warnings);
  }
}

void vtkTIPPDelaunay2D::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  auto onOff = [](vtkTypeBool flag) { return flag ? "On\n" : "Off\n"; };
  const char* marks[] = { "None", "Lines", "Edge flags" };
  os << indent << "MergeSourcePoints: " << onOff(this->MergeSourcePoints);
  os << indent << "SplitCrossings: " << onOff(this->SplitCrossings);
  os << indent << "ConstraintMarks: " << marks[this->ConstraintMarks] << "\n";
  os << indent << "Alpha: " << this->Alpha << "\n";
  os << indent << "AlphaTris: " << onOff(this->AlphaTris);
  os << indent << "AlphaLines: " << onOff(this->AlphaLines);
  os << indent << "AlphaVerts: " << onOff(this->AlphaVerts);
  os << indent << "MaximumEdgeLength: " << this->MaximumEdgeLength << "\n";
  const char* modes[] = { "XY Plane", "Transform Plane", "Best Fitting Plane" };
  os << indent << "ProjectionPlaneMode: " << modes[this->ProjectionPlaneMode] << "\n";
  os << indent << "Transform: " << (this->Transform ? "specified\n" : "none\n");
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "Offset: " << this->Offset << "\n";
  os << indent << "BoundingTriangulation: " << onOff(this->BoundingTriangulation);
  os << indent << "GenerateRepresentativeIds: " << onOff(this->GenerateRepresentativeIds);
  os << indent << "GenerateNeighborIds: " << onOff(this->GenerateNeighborIds);
  os << indent << "NumberOfPartitions: " << this->NumberOfPartitions[0] << " x "
     << this->NumberOfPartitions[1] << "\n";
  os << indent << "InitialPointsPerPartition: " << this->InitialPointsPerPartition << "\n";
  const char* schedules[] = { "Stages", "Dynamic", "Producer-consumer" };
  const char* masters[] = { "Auto", "Single", "Multi" };
  os << indent << "Schedule: " << schedules[this->Schedule] << "\n";
  os << indent << "Controller: " << this->Controller << "\n";
  os << indent << "Masters: " << masters[this->Masters] << "\n";
  os << indent << "NumberOfMajorPartitions: " << this->NumberOfMajorPartitions[0] << " x "
     << this->NumberOfMajorPartitions[1] << "\n";
  os << indent << "EqualGroups: " << onOff(this->EqualGroups);
  os << indent << "MinorDivision: " << (this->MinorDivision == TREE ? "Tree\n" : "Threshold\n");
  os << indent << "PointsPerPartition: " << this->PointsPerPartition << "\n";
  os << indent << "GatherOnFirstRank: " << onOff(this->GatherOnFirstRank);
  os << indent << "NumberOfThreads: " << this->NumberOfThreads << "\n";
  os << indent << "NumberOfDuplicatePoints: " << this->NumberOfDuplicatePoints << "\n";
  os << indent << "NumberOfRejectedPoints: " << this->NumberOfRejectedPoints << "\n";
}
