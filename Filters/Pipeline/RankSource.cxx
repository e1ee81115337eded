// SPDX-License-Identifier: BSD-3-Clause
#include "Pipeline/RankSource.h"

#include "Arrays/IndexMap.h"
#include "Constraints/ConstraintEdges.h"
#include "Constraints/NearSegments.h"
#include "Constraints/PositionIndex.h"
#include "Constraints/ResolveCrossings.h"
#include "Constraints/SegmentTree.h"
#include "Parallel/ParallelFor.h"
#include "Pipeline/InputPoints.h"
#include "Pipeline/SourceData.h"
#include "Vtk/DataSets.h"

#include "vtkDataArray.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

namespace tipp
{
namespace
{

/// A vertex of a constraint, and the point at it.
struct Found
{
  std::int64_t Vertex;
  std::int64_t Id;
  Point2 Position;
};

/// A point of this rank's input.
struct InputPoint
{
  Point2 Position;
  std::int64_t Id;
  std::int64_t Index;

  /// By position; of equal ones the lowest id is first.
  bool operator<(const InputPoint& other) const
  {
    return this->Position == other.Position ? this->Id < other.Id
                                            : lexicographicLess(this->Position, other.Position);
  }
};

/// How the points of a rank's input are numbered.
struct Numbering
{
  std::int64_t Points = 0;
  std::int64_t EndOfIds = 0; ///< larger than all global ids
  bool HasIds = false;
};

class SourceSharer
{
public:
  SourceSharer(Communicator& ranks, vtkPointSet* input, const RankSourceOptions& options)
    : Ranks(ranks)
    , Input(input)
    , Options(options)
  {
  }

  RankSource share(vtkPolyData* source)
  {
    this->gatherSources(source);
    this->numberInput();
    this->Options.MergesPoints ? this->takePoints() : this->takeIds();
    this->findVertices();
    this->resolve();
    const std::vector<Bytes> rows = this->sendRows();
    RankSource result;
    result.Input = this->Input;
    SaveArchive writer;
    if (this->isLast())
    {
      this->join(rows, result);
      writer(this->Segments, result.Cells, result.Figures);
    }
    const std::vector<Bytes> all = this->Ranks.allGather(writer.take());
    LoadArchive reader(all.back());
    reader(this->Segments, result.Cells, result.Figures);
    result.Segments = std::make_unique<ConstraintSegments>(
      this->Segments, this->Options.WantsCells ? &result.Order : nullptr);
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
      this->Ids->DeepCopy(ids); // exact, while a double would round ids beyond 2^53
      for (vtkIdType i = 0; i < this->Ids->GetNumberOfTuples(); ++i)
      {
        mine.EndOfIds = std::max<std::int64_t>(mine.EndOfIds, this->Ids->GetValue(i) + 1);
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
    return this->HasIds ? std::int64_t(this->Ids->GetValue(vtkIdType(point)))
                        : this->First + std::int64_t(point);
  }

  /// Appends the constraints of a source. index(id) turns the source's point ids into vertices.
  template <typename Index>
  void takeConstraints(vtkPolyData* source, const Index& index)
  {
    const SourceConstraints read = readConstraints(source, {});
    for (std::size_t i = 0; i < read.Constraints.size(); ++i)
    {
      const Constraint& constraint = read.Constraints[i];
      this->Constraints.push_back({ index(constraint.A), index(constraint.B) });
      this->Roles.push_back(i < read.PolygonBegin ? SegmentRole::Line : SegmentRole::Polygon);
      this->Cells.push_back(this->FirstCell + read.Cells[i]);
    }
    this->FirstCell += source->GetNumberOfCells();
  }

  /// Uses the different positions of the sources' points as vertices, in their order.
  void takePoints()
  {
    std::vector<Point2> given;
    std::vector<DataSetRow> rows;
    for (std::size_t s = 0; s < this->Sources.size(); ++s)
    {
      const ProjectedPoints projected(this->Sources[s]->GetPoints(), this->Options.ToPlane);
      const PointsView view = projected.view();
      view.forEach(0, view.size(),
        [&](std::size_t i, Point2 p)
        {
          given.push_back(p);
          rows.push_back({ s, vtkIdType(i) });
        });
    }
    const MatchedPositions matched = matchPositions(PointsView(), PointsView(given));
    PointId first = 0;
    for (vtkPolyData* const source : this->Sources)
    {
      this->takeConstraints(
        source, [&](PointId id) { return matched.Ids[std::size_t(first + id)]; });
      first += source->GetNumberOfPoints();
    }
    for (const std::size_t i : matched.New)
    {
      this->Positions.push_back(given[i]);
      this->SourceRows.push_back(rows[i]);
    }
    this->Index = std::make_unique<PositionIndex>(this->Positions);
  }

  /// Uses the points that the sources refer to by id as vertices.
  void takeIds()
  {
    for (vtkPolyData* const source : this->Sources)
    {
      this->takeConstraints(source,
        [this](PointId id)
        {
          const auto [vertex, isNew] = this->VertexOf.insert(id);
          if (isNew)
          {
            this->Named.push_back(id);
          }
          return PointId(vertex);
        });
    }
  }

  /// Sets the positions, ids and owners of vertices, and the points of this rank at them.
  void findVertices()
  {
    constexpr std::int64_t none = -1;
    std::vector<std::int64_t>& point = this->PointAt;
    point.assign(this->Index ? this->Positions.size() : this->Named.size(), none);
    this->Positions.resize(point.size());
    const ProjectedPoints projected(this->Input->GetPoints(), this->Options.ToPlane);
    const PointsView view = projected.view();
    view.forEach(0, view.size(),
      [&](std::size_t i, Point2 p)
      {
        const std::int64_t v =
          this->Index ? this->Index->find(p) : this->VertexOf.find(this->idOf(i));
        std::int64_t* const first = v < 0 ? nullptr : &point[std::size_t(v)];
        if (first && (*first < 0 || this->idOf(i) < this->idOf(std::size_t(*first))))
        {
          *first = std::int64_t(i);
        }
      });
    std::vector<Found> found;
    for (std::size_t v = 0; v < point.size(); ++v)
    {
      if (point[v] >= 0)
      {
        found.push_back(
          { std::int64_t(v), this->idOf(std::size_t(point[v])), view[std::size_t(point[v])] });
      }
    }
    this->VertexIds.assign(point.size(), none);
    this->Owners.assign(point.size(), -1);
    const std::vector<std::vector<Found>> all = this->Ranks.allGather(found);
    for (int rank = 0; rank < this->Ranks.size(); ++rank)
    {
      for (const Found& one : all[std::size_t(rank)])
      {
        std::int64_t& id = this->VertexIds.at(std::size_t(one.Vertex));
        if (id < 0 || one.Id < id)
        {
          id = one.Id;
          this->Owners[std::size_t(one.Vertex)] = rank;
          this->Positions[std::size_t(one.Vertex)] = one.Position;
        }
      }
    }
    this->numberNewVertices();
  }

  void numberNewVertices()
  {
    std::int64_t next = this->EndOfIds;
    for (std::size_t v = 0; v < this->VertexIds.size(); ++v)
    {
      if (this->VertexIds[v] < 0 && !this->Options.MergesPoints)
      {
        throw std::invalid_argument("the source names point " + std::to_string(this->Named[v]) +
          ", which no rank's input has: the source's ids are the input's, unless "
          "MergeSourcePoints is on.");
      }
      this->VertexIds[v] = this->VertexIds[v] < 0 ? next++ : this->VertexIds[v];
    }
  }

  /// Splits the constraints at crossings, on the last rank. Points of the input that are on
  /// constraints, or where constraints cross, become vertices.
  void resolve()
  {
    if (!this->haveCrossings())
    {
      if (this->isLast())
      {
        this->resolveVertices();
      }
      return;
    }
    this->addVertices(this->pointsOnConstraints());
    std::vector<Point2> crossings;
    if (this->isLast())
    {
      this->resolveVertices();
      for (const CrossingPoint& crossing : this->Resolved.Crossings)
      {
        crossings.push_back(crossing.Position);
      }
    }
    const bool isAnyNew =
      this->addVertices(this->pointsAt(this->Ranks.allGather(crossings).back()));
    if (this->isLast() && isAnyNew)
    {
      this->resolveVertices();
    }
  }

  /// The constraints whose ends are finite and different.
  std::vector<SegmentTree::Item> segments() const
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
    return items;
  }

  int threads() const { return threadCount(this->Options.Threads); }

  bool haveCrossings() const
  {
    return !findCrossingPairs(this->segments(), this->threads()).empty();
  }

  /// This rank's points that lie exactly on constraints.
  std::vector<InputPoint> pointsOnConstraints() const
  {
    const ProjectedPoints projected(this->Input->GetPoints(), this->Options.ToPlane);
    const PointsView view = projected.view();
    std::vector<InputPoint> points;
    for (const auto& [segment, i] : findPointsOn(this->segments(), view, this->threads()))
    {
      points.push_back({ view[i], this->idOf(i), std::int64_t(i) });
    }
    return points;
  }

  /// This rank's points at these positions.
  std::vector<InputPoint> pointsAt(const std::vector<Point2>& positions) const
  {
    const PositionIndex index(positions);
    const ProjectedPoints projected(this->Input->GetPoints(), this->Options.ToPlane);
    const PointsView view = projected.view();
    std::vector<InputPoint> points;
    view.forEach(0, view.size(),
      [&](std::size_t i, Point2 p)
      {
        if (index.find(p) >= 0)
        {
          points.push_back({ p, this->idOf(i), std::int64_t(i) });
        }
      });
    return points;
  }

  /// Adds vertices at points of all ranks, of equal points only the one with the lowest id. Returns
  /// whether any of them is new.
  bool addVertices(std::vector<InputPoint> mine)
  {
    std::vector<std::pair<InputPoint, int>> all; // with their ranks
    keepFirst(mine, [](const InputPoint& point) { return point; });
    const std::vector<std::vector<InputPoint>> byRank = this->Ranks.allGather(mine);
    for (std::size_t rank = 0; rank < byRank.size(); ++rank)
    {
      for (const InputPoint& point : byRank[rank])
      {
        all.emplace_back(point, int(rank));
      }
    }
    keepFirst(all, [](const auto& one) { return one.first; });
    std::vector<std::int64_t> known = this->VertexIds;
    std::sort(known.begin(), known.end());
    bool isAnyNew = false;
    for (const auto& [point, rank] : all)
    {
      if (!std::binary_search(known.begin(), known.end(), point.Id))
      {
        this->Positions.push_back(point.Position);
        this->VertexIds.push_back(point.Id);
        this->Owners.push_back(rank);
        this->PointAt.push_back(rank == this->Ranks.rank() ? point.Index : -1);
        isAnyNew = true;
      }
    }
    return isAnyNew;
  }

  /// Sorts points, and of those at one position keeps the first.
  template <typename Item, typename PointOf>
  static void keepFirst(std::vector<Item>& items, const PointOf& pointOf)
  {
    std::stable_sort(items.begin(), items.end(),
      [&](const Item& a, const Item& b) { return pointOf(a) < pointOf(b); });
    items.erase(
      std::unique(items.begin(), items.end(),
        [&](const Item& a, const Item& b) { return pointOf(a).Position == pointOf(b).Position; }),
      items.end());
  }

  /// Sends the points at this rank's vertices, in the order of the vertices, to the last rank,
  /// which gets a data set from each rank.
  std::vector<Bytes> sendRows()
  {
    std::vector<DataSetRow> rows;
    for (std::size_t v = 0; v < this->PointAt.size(); ++v)
    {
      if (this->Owners[v] == this->Ranks.rank())
      {
        rows.push_back({ 0, vtkIdType(this->PointAt[v]) });
      }
    }
    std::vector<Bytes> sent(std::size_t(this->Ranks.size()));
    sent.back() = rows.empty() ? Bytes() : packDataSet(copyRows({ this->Input }, rows));
    return this->Ranks.allToAll(std::move(sent));
  }

  /// On the last rank: splits the constraints where they cross.
  void resolveVertices()
  {
    this->sortVertices();
    this->SortedPositions.clear();
    std::vector<PointId> names;
    for (const std::size_t v : this->Sorted)
    {
      this->SortedPositions.push_back(this->Positions[v]);
      names.push_back(this->VertexIds[v]);
    }
    std::vector<Constraint> constraints;
    for (const Constraint& constraint : this->Constraints)
    {
      constraints.push_back(
        { this->indexInSorted(constraint.A), this->indexInSorted(constraint.B) });
    }
    this->Resolved = resolveCrossings(PointsView(this->SortedPositions), constraints,
      this->Options.Crossings, this->Options.Threads, { names, {} });
  }

  /// On the last rank: makes segments of the constraints, and appends new points to the input.
  void join(const std::vector<Bytes>& rows, RankSource& result)
  {
    const ResolvedConstraints& resolved = this->Resolved;
    const vtkSmartPointer<vtkPolyData> vertices = this->makeVertices(rows);
    if (resolved.NotFinite > 0 &&
      std::find(this->Roles.begin(), this->Roles.end(), SegmentRole::Polygon) != this->Roles.end())
    {
      throw std::invalid_argument("the source has polygons, and a point that is NaN or infinite: "
                                  "remove the polygon or correct the point.");
    }
    result.Figures = { resolved, this->Constraints.size() };
    std::vector<Point2> all = this->SortedPositions;
    for (const CrossingPoint& crossing : resolved.Crossings)
    {
      all.push_back(crossing.Position);
    }
    for (const IdSegment& segment : resolved.Segments)
    {
      this->Segments.push_back({ all[std::size_t(segment.A)], all[std::size_t(segment.B)],
        this->Roles[std::size_t(segment.Constraint)] });
      if (this->Options.WantsCells)
      {
        result.Cells.push_back(this->Cells[std::size_t(segment.Constraint)]);
      }
    }
    const auto isNew = [this](std::size_t v) { return this->VertexIds[v] >= this->EndOfIds; };
    const auto firstNew = std::size_t(
      std::find_if(this->Sorted.begin(), this->Sorted.end(), isNew) - this->Sorted.begin());
    if (firstNew < all.size())
    {
      vtkNew<vtkPolyData> extended;
      extended->SetPoints(
        appendCrossings(vertices->GetPoints(), resolved.Crossings, !this->Options.ToPlane));
      interpolateCrossings(vertices->GetPointData(), vtkIdType(this->Sorted.size()),
        resolved.Crossings, extended->GetPointData());
      this->appendTo(extended, firstNew, result);
      result.Positions.insert(
        result.Positions.end(), all.begin() + std::ptrdiff_t(firstNew), all.end());
    }
  }

  /// Sorts the vertices by their ids, as in memory. New points are last.
  void sortVertices()
  {
    this->Sorted.resize(this->VertexIds.size());
    std::iota(this->Sorted.begin(), this->Sorted.end(), std::size_t(0));
    std::sort(this->Sorted.begin(), this->Sorted.end(),
      [this](std::size_t a, std::size_t b) { return this->VertexIds[a] < this->VertexIds[b]; });
    this->IndexInSorted.resize(this->Sorted.size());
    for (std::size_t i = 0; i < this->Sorted.size(); ++i)
    {
      this->IndexInSorted[this->Sorted[i]] = PointId(i);
    }
  }

  PointId indexInSorted(PointId vertex) const { return this->IndexInSorted[std::size_t(vertex)]; }

  /// The sorted vertices, with the point arrays that all of them have.
  vtkSmartPointer<vtkPolyData> makeVertices(const std::vector<Bytes>& rows) const
  {
    std::vector<vtkSmartPointer<vtkPointSet>> from;
    std::vector<DataSetRow> next; // by rank: its first point that has not been taken yet
    for (const Bytes& bytes : rows)
    {
      next.push_back({ from.size(), 0 });
      if (bytes.size() > 0)
      {
        from.emplace_back(unpackDataSet(bytes));
      }
    }
    std::vector<DataSetRow> rowOf(this->Sorted.size());
    std::size_t used = this->Sources.size(); // the source of the last new vertex so far
    for (std::size_t v = 0; v < this->Owners.size(); ++v)
    {
      DataSetRow& taken = rowOf[std::size_t(this->indexInSorted(PointId(v)))];
      if (this->Owners[v] >= 0)
      {
        taken = next[std::size_t(this->Owners[v])];
        ++next[std::size_t(this->Owners[v])].Row;
        continue;
      }
      const auto [source, row] = this->SourceRows[v];
      if (used != source)
      {
        from.emplace_back(this->Sources[source]);
        used = source;
      }
      taken = { from.size() - 1, row };
    }
    return copyRows(from, rowOf);
  }

  /// Appends the points from index `begin` on to the input.
  void appendTo(vtkPolyData* extended, std::size_t begin, RankSource& result) const
  {
    const ProjectedPoints projected(this->Input->GetPoints(), this->Options.ToPlane);
    const PointsView view = projected.view();
    view.forEach(0, view.size(), [&](std::size_t, Point2 p) { result.Positions.push_back(p); });
    std::vector<vtkSmartPointer<vtkPointSet>> from;
    std::vector<DataSetRow> rows;
    vtkNew<vtkIdTypeArray> ids;
    ids->SetName("GlobalPointIds");
    const vtkIdType given = this->Input->GetNumberOfPoints();
    if (given > 0)
    {
      from.emplace_back(this->Input);
    }
    for (vtkIdType i = 0; i < given; ++i)
    {
      rows.push_back({ 0, i });
      ids->InsertNextValue(this->idOf(std::size_t(i)));
    }
    for (vtkIdType i = vtkIdType(begin); i < extended->GetNumberOfPoints(); ++i)
    {
      rows.push_back({ from.size(), i });
      ids->InsertNextValue(this->EndOfIds + (i - vtkIdType(begin)));
    }
    from.emplace_back(extended);
    const vtkSmartPointer<vtkPolyData> joined = copyRows(from, rows);
    if (this->HasIds)
    {
      joined->GetPointData()->SetGlobalIds(ids);
    }
    result.Input = joined;
  }

  Communicator& Ranks;
  vtkPointSet* const Input;
  const RankSourceOptions& Options;
  std::vector<vtkSmartPointer<vtkPolyData>> Sources; ///< the distinct sources of all ranks
  vtkNew<vtkIdTypeArray> Ids;                        ///< ids of the input's points, if it has ids
  bool HasIds = false;                               ///< whether the points of all ranks have ids
  std::int64_t First = 0;                            ///< first id of this rank if they have none
  std::int64_t EndOfIds = 0;                         ///< larger than all ids of the inputs' points
  std::vector<Point2> Positions;                     ///< per vertex
  std::vector<std::int64_t> PointAt;    ///< per vertex: index of this rank's point, or -1
  std::vector<DataSetRow> SourceRows;   ///< likewise: the first point in Sources
  std::unique_ptr<PositionIndex> Index; ///< of Positions
  IndexMap VertexOf;                    ///< by point id, if points are not merged
  std::vector<std::int64_t> Named;      ///< point id per vertex, likewise
  std::vector<std::int64_t> VertexIds;  ///< per vertex: the id of the point at it
  std::vector<int> Owners;         ///< per vertex: the rank that sends its point; -1 if it is new
  std::vector<std::size_t> Sorted; ///< vertices, sorted by id
  std::vector<PointId> IndexInSorted;  ///< per vertex
  std::vector<Constraint> Constraints; ///< between vertices
  std::vector<SegmentRole> Roles;      ///< per constraint
  std::vector<std::int64_t> Cells;     ///< source cell per constraint
  std::int64_t FirstCell = 0;          ///< cell number at which the next source starts
  ResolvedConstraints Resolved;        ///< on the last rank, between sorted vertices
  std::vector<Point2> SortedPositions; ///< likewise: of the sorted vertices
  std::vector<ConstraintSegment> Segments;
};

} // namespace

RankSource shareSource(
  Communicator& ranks, vtkPointSet* input, vtkPolyData* source, const RankSourceOptions& options)
{
  return SourceSharer(ranks, input, options).share(source);
}

} // namespace tipp
