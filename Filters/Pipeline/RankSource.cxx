// SPDX-License-Identifier: BSD-3-Clause
#include "Pipeline/RankSource.h"

#include "Arrays/IndexMap.h"
#include "Constraints/ConstraintEdges.h"
#include "Constraints/NearSegments.h"
#include "Constraints/PositionIndex.h"
#include "Constraints/SegmentTree.h"
#include "Parallel/ParallelFor.h"
#include "Parallel/Sort.h"
#include "Pipeline/InputPoints.h"
#include "Pipeline/SourceData.h"
#include "Vtk/DataSets.h"

#include "vtkDataArray.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

namespace tipp
{
namespace
{

/// A point of an input.
struct InputPoint
{
  std::int64_t Id;
  Point2 Position;
};

/// A point of some rank's input that is an end of constraints, or on constraints that cross.
struct Vertex : InputPoint
{
  DataSetRow Row; ///< in SourceSharer::Received
};

/// How the points of a rank's input are numbered.
struct Numbering
{
  std::int64_t Points = 0;
  std::int64_t EndOfIds = 0; ///< larger than all global ids
  bool HasIds = false;
};

/// All ranks know the sources. The last rank collects the points that matter for them, and then
/// does the same as in memory.
class SourceSharer
{
public:
  SourceSharer(Communicator& ranks, vtkPointSet* input, const RankSourceOptions& options)
    : Ranks(ranks)
    , Input(input)
    , Options(options)
    , Projected(input->GetPoints(), options.ToPlane)
  {
  }

  RankSource share(vtkPolyData* source)
  {
    this->gatherSources(source);
    this->numberInput();
    this->addVertices(
      this->Options.MergesPoints ? this->pointsAt(this->sourcePositions()) : this->pointsNamed());
    this->resolve();
    RankSource result;
    result.Input = this->Input;
    SaveArchive writer;
    if (this->isLast())
    {
      this->join(result);
      writer(this->segments(), result.Cells, result.Figures);
    }
    const std::vector<Bytes> all = this->Ranks.allGather(writer.take());
    LoadArchive reader(all.back());
    const auto segments = reader.get<std::vector<ConstraintSegment>>();
    reader(result.Cells, result.Figures);
    result.Segments = std::make_unique<ConstraintSegments>(
      segments, this->Options.WantsCells ? &result.Order : nullptr);
    return result;
  }

private:
  bool isLast() const { return this->Ranks.rank() == this->Ranks.size() - 1; }

  void gatherSources(vtkPolyData* source)
  {
    Bytes mine;
    if (source && source->GetNumberOfLines() + source->GetNumberOfPolys() > 0)
    {
      vtkNew<vtkPolyData> sent;
      if (this->Options.WantsCells)
      {
        sent->SetVerts(source->GetVerts()); // their cells are numbered before lines
      }
      sent->SetLines(source->GetLines());
      sent->SetPolys(source->GetPolys());
      if (this->Options.MergesPoints)
      {
        checkDataSet(source, "the source");
        sent->SetPoints(source->GetPoints());
        sent->GetPointData()->ShallowCopy(source->GetPointData());
      }
      mine = packDataSet(sent);
    }
    std::vector<Bytes> all = this->Ranks.allGather(std::move(mine));
    for (auto one = all.begin(); one != all.end(); ++one)
    {
      const bool isNew = one->size() > 0 &&
        std::none_of(all.begin(), one,
          [&](const Bytes& other)
          { return std::equal(other.begin(), other.end(), one->begin(), one->end()); });
      if (isNew)
      {
        this->Sources.push_back(unpackDataSet(*one));
      }
    }
  }

  void numberInput()
  {
    vtkDataArray* const ids = this->Input->GetPointData()->GetGlobalIds();
    Numbering mine{ this->Input->GetNumberOfPoints(), 0, ids != nullptr };
    if (ids)
    {
      this->GlobalIds->DeepCopy(ids); // exact, while a double would round ids beyond 2^53
      for (vtkIdType i = 0; i < this->GlobalIds->GetNumberOfTuples(); ++i)
      {
        mine.EndOfIds = std::max<std::int64_t>(mine.EndOfIds, this->GlobalIds->GetValue(i) + 1);
      }
    }
    const std::vector<Numbering> all = this->Ranks.allGather(mine);
    this->HasIds = std::all_of(all.begin(), all.end(),
      [](const Numbering& rank) { return rank.HasIds || rank.Points == 0; });
    for (std::size_t rank = 0; rank < all.size(); ++rank)
    {
      this->First += rank < std::size_t(this->Ranks.rank()) ? all[rank].Points : 0;
      this->EndOfIds = this->HasIds ? std::max(this->EndOfIds, all[rank].EndOfIds)
                                    : this->EndOfIds + all[rank].Points;
    }
  }

  std::int64_t idOf(std::size_t point) const
  {
    return this->HasIds ? std::int64_t(this->GlobalIds->GetValue(vtkIdType(point)))
                        : this->First + std::int64_t(point);
  }

  /// Calls visit(source, point, position) for all points of the sources.
  template <typename Visit>
  void forSourcePoints(const Visit& visit) const
  {
    for (std::size_t s = 0; s < this->Sources.size(); ++s)
    {
      const ProjectedPoints projected(this->Sources[s]->GetPoints(), this->Options.ToPlane);
      projected.view().forEach(
        0, projected.view().size(), [&](std::size_t i, Point2 p) { visit(s, i, p); });
    }
  }

  std::vector<Point2> sourcePositions() const
  {
    std::vector<Point2> positions;
    this->forSourcePoints([&](std::size_t, std::size_t, Point2 p) { positions.push_back(p); });
    return positions;
  }

  /// This rank's points at these positions.
  std::vector<std::size_t> pointsAt(const std::vector<Point2>& positions) const
  {
    const PositionIndex index(positions);
    const PointsView view = this->Projected.view();
    std::vector<std::size_t> points;
    view.forBlocks(0, view.size(),
      [&](std::size_t first, const Point2* block, std::size_t count) {
        index.findAll(
          block, count, [&](std::size_t i, std::size_t) { points.push_back(first + i); });
      });
    return points;
  }

  /// This rank's points that the sources refer to by id.
  std::vector<std::size_t> pointsNamed() const
  {
    IndexMap named;
    for (vtkPolyData* const source : this->Sources)
    {
      for (const Constraint& constraint : readConstraints(source, {}).Constraints)
      {
        named.insert(constraint.A);
        named.insert(constraint.B);
      }
    }
    std::vector<std::size_t> points;
    for (std::size_t i = 0; i < this->Projected.view().size(); ++i)
    {
      if (named.find(this->idOf(i)) != IndexMap::None)
      {
        points.push_back(i);
      }
    }
    return points;
  }

  /// Makes vertices of points of this rank, on the last rank; of points with one id, which several
  /// ranks may have, only one. Returns whether any is new; on other ranks false. Collective.
  bool addVertices(const std::vector<std::size_t>& points)
  {
    SaveArchive writer;
    if (!points.empty())
    {
      std::vector<InputPoint> sent;
      std::vector<DataSetRow> rows;
      for (const std::size_t i : points)
      {
        sent.push_back({ this->idOf(i), this->Projected.view()[i] });
        rows.push_back({ 0, vtkIdType(i) });
      }
      const Bytes data = packDataSet(copyRows({ this->Input }, rows));
      writer(sent);
      writer.raw(data.data(), data.size());
    }
    std::vector<Bytes> contents(std::size_t(this->Ranks.size()));
    contents.back() = writer.take();
    const std::size_t before = this->Vertices.size();
    for (const Bytes& content : this->Ranks.allToAll(std::move(contents)))
    {
      if (content.size() > 0)
      {
        this->receiveVertices(LoadArchive(content));
      }
    }
    std::stable_sort(this->Vertices.begin(), this->Vertices.end(),
      [](const Vertex& a, const Vertex& b) { return a.Id < b.Id; });
    this->Vertices.erase(std::unique(this->Vertices.begin(), this->Vertices.end(),
                           [](const Vertex& a, const Vertex& b) { return a.Id == b.Id; }),
      this->Vertices.end());
    return this->Vertices.size() > before;
  }

  void receiveVertices(LoadArchive reader)
  {
    vtkIdType row = 0;
    for (const InputPoint& point : reader.get<std::vector<InputPoint>>())
    {
      this->Vertices.push_back({ point, { this->Received.size(), row++ } });
    }
    const std::size_t size = reader.left();
    Bytes data(size);
    std::copy_n(reader.raw(size), size, data.data());
    this->Received.emplace_back(unpackDataSet(data));
  }

  /// Splits the constraints at crossings, on the last rank. Points of the input that are on
  /// constraints, or where constraints cross, become vertices.
  void resolve()
  {
    std::vector<SegmentTree::Item> crossing;
    if (this->isLast())
    {
      this->readVertices();
      crossing = this->crossingSegments();
    }
    crossing = this->Ranks.allGather(crossing).back();
    if (crossing.empty())
    {
      if (this->isLast())
      {
        this->resolveVertices();
      }
      return;
    }
    this->addVertices(this->pointsOn(std::move(crossing)));
    std::vector<Point2> crossings;
    if (this->isLast())
    {
      this->readVertices();
      this->resolveVertices();
      for (const CrossingPoint& crossing : this->Resolved.Crossings)
      {
        crossings.push_back(crossing.Position);
      }
    }
    if (this->addVertices(this->pointsAt(this->Ranks.allGather(crossings).back())))
    {
      this->readVertices();
      this->resolveVertices();
    }
  }

  int threads() const { return threadCount(this->Options.Threads); }

  /// The constraints whose ends are finite and different, if any of them cross.
  std::vector<SegmentTree::Item> crossingSegments() const
  {
    std::vector<SegmentTree::Item> items;
    for (const Constraint& constraint : this->Constraints)
    {
      const Point2 a = this->Positions[std::size_t(constraint.A)];
      const Point2 b = this->Positions[std::size_t(constraint.B)];
      if (isFinite(a) && isFinite(b) && !(a == b))
      {
        items.push_back({ a, b, std::int64_t(items.size()) });
      }
    }
    return findCrossingPairs(items, this->threads()).empty() ? std::vector<SegmentTree::Item>()
                                                             : items;
  }

  /// This rank's points that lie exactly on segments.
  std::vector<std::size_t> pointsOn(std::vector<SegmentTree::Item> segments) const
  {
    std::vector<std::size_t> points;
    for (const auto& [segment, i] :
      findPointsOn(std::move(segments), this->Projected.view(), this->threads()))
    {
      points.push_back(i);
    }
    return sortedUnique(std::move(points));
  }

  /// On the last rank: the vertices by ascending id, then the sources' points that are at none of
  /// them, and the constraints between these.
  void readVertices()
  {
    this->Positions.clear();
    this->Ids.clear();
    this->Rows.clear();
    for (const Vertex& vertex : this->Vertices)
    {
      this->addPoint(vertex.Position, vertex.Id, vertex.Row);
    }
    std::vector<PointId> indices; // of the sources' points
    if (this->Options.MergesPoints)
    {
      const std::vector<Point2> given = this->sourcePositions();
      MatchedPositions matched = matchPositions(PointsView(this->Positions), PointsView(given));
      indices = std::move(matched.Ids);
      auto next = matched.New.begin();
      std::size_t point = 0;
      this->forSourcePoints(
        [&](std::size_t source, std::size_t i, Point2 p)
        {
          if (next != matched.New.end() && *next == point++)
          {
            this->addPoint(p, this->EndOfIds + (next++ - matched.New.begin()),
              { this->Received.size() + source, vtkIdType(i) });
          }
        });
    }
    this->readSources(indices);
  }

  void addPoint(Point2 position, std::int64_t id, DataSetRow row)
  {
    this->Positions.push_back(position);
    this->Ids.push_back(id);
    this->Rows.push_back(row);
  }

  /// Sets the constraints. `indices`: of the points of all sources, if they are merged.
  void readSources(const std::vector<PointId>& indices)
  {
    this->Constraints.clear();
    this->Roles.clear();
    this->Cells.clear();
    PointId firstPoint = 0;
    std::int64_t firstCell = 0;
    for (vtkPolyData* const source : this->Sources)
    {
      const auto index = [&](PointId id)
      { return indices.empty() ? this->indexOf(id) : indices[std::size_t(firstPoint + id)]; };
      const SourceConstraints read = readConstraints(source, {});
      for (std::size_t i = 0; i < read.Constraints.size(); ++i)
      {
        const Constraint& constraint = read.Constraints[i];
        this->Constraints.push_back({ index(constraint.A), index(constraint.B) });
        this->Roles.push_back(i < read.PolygonBegin ? SegmentRole::Line : SegmentRole::Polygon);
        this->Cells.push_back(firstCell + read.Cells[i]);
      }
      firstPoint += source->GetNumberOfPoints();
      firstCell += source->GetNumberOfCells();
    }
  }

  /// The index of the point with an id.
  PointId indexOf(std::int64_t id) const
  {
    const auto found = std::lower_bound(this->Ids.begin(), this->Ids.end(), id);
    if (found == this->Ids.end() || *found != id)
    {
      throw std::invalid_argument("the source names point " + std::to_string(id) +
        ", which no rank's input has: the source's ids are the input's, unless "
        "MergeSourcePoints is on.");
    }
    return PointId(found - this->Ids.begin());
  }

  /// On the last rank: splits the constraints where they cross.
  void resolveVertices()
  {
    this->Resolved = resolveCrossings(PointsView(this->Positions), this->Constraints,
      this->Options.Crossings, this->Options.Threads, { this->Ids, {} });
  }

  /// The vertices' positions, followed by those of crossings.
  std::vector<Point2> allPositions() const
  {
    std::vector<Point2> all = this->Positions;
    for (const CrossingPoint& crossing : this->Resolved.Crossings)
    {
      all.push_back(crossing.Position);
    }
    return all;
  }

  /// The segments of the constraints.
  std::vector<ConstraintSegment> segments() const
  {
    const std::vector<Point2> all = this->allPositions();
    std::vector<ConstraintSegment> segments;
    for (const IdSegment& segment : this->Resolved.Segments)
    {
      segments.push_back({ all[std::size_t(segment.A)], all[std::size_t(segment.B)],
        this->Roles[std::size_t(segment.Constraint)] });
    }
    return segments;
  }

  /// On the last rank: appends new points to the input, and sets the cells and figures.
  void join(RankSource& result)
  {
    const ResolvedConstraints& resolved = this->Resolved;
    if (resolved.NotFinite > 0 &&
      std::find(this->Roles.begin(), this->Roles.end(), SegmentRole::Polygon) != this->Roles.end())
    {
      throw std::invalid_argument("the source has polygons, and a point that is NaN or infinite: "
                                  "remove the polygon or correct the point.");
    }
    result.Figures = { resolved, this->Constraints.size() };
    for (std::size_t i = 0; this->Options.WantsCells && i < resolved.Segments.size(); ++i)
    {
      result.Cells.push_back(this->Cells[std::size_t(resolved.Segments[i].Constraint)]);
    }
    if (this->Vertices.size() < this->Positions.size() + resolved.Crossings.size())
    {
      std::vector<vtkSmartPointer<vtkPointSet>> from = this->Received;
      from.insert(from.end(), this->Sources.begin(), this->Sources.end());
      const vtkSmartPointer<vtkPolyData> vertices = copyRows(from, this->Rows);
      vtkNew<vtkPolyData> extended;
      extended->SetPoints(
        appendCrossings(vertices->GetPoints(), resolved.Crossings, !this->Options.ToPlane));
      interpolateCrossings(vertices->GetPointData(), vtkIdType(this->Positions.size()),
        resolved.Crossings, extended->GetPointData());
      this->appendTo(extended, result);
    }
  }

  /// Appends the points that are not vertices to the input.
  void appendTo(vtkPolyData* extended, RankSource& result) const
  {
    const auto begin = vtkIdType(this->Vertices.size());
    const PointsView view = this->Projected.view();
    view.forEach(0, view.size(), [&](std::size_t, Point2 p) { result.Positions.push_back(p); });
    const std::vector<Point2> all = this->allPositions();
    result.Positions.insert(result.Positions.end(), all.begin() + begin, all.end());
    std::vector<DataSetRow> rows;
    vtkNew<vtkIdTypeArray> ids;
    ids->SetName("GlobalPointIds");
    for (std::size_t i = 0; i < view.size(); ++i)
    {
      rows.push_back({ 0, vtkIdType(i) });
      ids->InsertNextValue(this->idOf(i));
    }
    for (vtkIdType i = begin; i < extended->GetNumberOfPoints(); ++i)
    {
      rows.push_back({ 1, i });
      ids->InsertNextValue(this->EndOfIds + (i - begin));
    }
    const vtkSmartPointer<vtkPolyData> joined = copyRows({ this->Input, extended }, rows);
    if (this->HasIds)
    {
      joined->GetPointData()->SetGlobalIds(ids);
    }
    result.Input = joined;
  }

  Communicator& Ranks;
  vtkPointSet* const Input;
  const RankSourceOptions& Options;
  const ProjectedPoints Projected;
  std::vector<vtkSmartPointer<vtkPolyData>> Sources; ///< the distinct sources of all ranks
  vtkNew<vtkIdTypeArray> GlobalIds;                  ///< of the input's points, if it has ids
  bool HasIds = false;                               ///< whether the points of all ranks have ids
  std::int64_t First = 0;                            ///< first id of this rank if they have none
  std::int64_t EndOfIds = 0;                         ///< larger than all ids of the inputs' points

  /// @name On the last rank
  ///@{
  std::vector<Vertex> Vertices; ///< by ascending id
  std::vector<vtkSmartPointer<vtkPointSet>> Received;
  std::vector<Point2> Positions;       ///< of the vertices, and then of the sources' new points
  std::vector<std::int64_t> Ids;       ///< likewise
  std::vector<DataSetRow> Rows;        ///< likewise, in Received and then Sources
  std::vector<Constraint> Constraints; ///< between these, by index
  std::vector<SegmentRole> Roles;      ///< per constraint
  std::vector<std::int64_t> Cells;     ///< source cell per constraint
  ResolvedConstraints Resolved;
  ///@}
};

} // namespace

RankSource shareSource(
  Communicator& ranks, vtkPointSet* input, vtkPolyData* source, const RankSourceOptions& options)
{
  return SourceSharer(ranks, input, options).share(source);
}

} // namespace tipp
