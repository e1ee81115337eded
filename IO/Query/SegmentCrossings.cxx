// SPDX-License-Identifier: BSD-3-Clause
#include "Query/SegmentCrossings.h"

#include "Arrays/SortUnique.h"
#include "Parallel/ParallelFor.h"
#include "Parallel/Poll.h"
#include "Predicates/ExactPredicates.h"
#include "Query/ForPieces.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <utility>

namespace tipp
{
namespace
{

Point2 flat(const Point3& p)
{
  return { p.x, p.y };
}

double dot(const Point3& a, const Point3& b)
{
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

Point3 cross(const Point3& a, const Point3& b)
{
  return { a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x };
}

/// A corner of a cell.
struct CellCorner
{
  std::int64_t Index; ///< local index in the piece
  std::int64_t Id;    ///< global id
  Point3 At;
};

/// Finds where one segment crosses the cells of a piece. Crossings at its ends may be left out.
class SegmentCrossings
{
public:
  SegmentCrossings(const Point3& begin, const Point3& end, const std::vector<PartValues>& values,
    std::vector<Crossing>& crossings)
    : Begin(begin)
    , End(end)
    , Values(values)
    , Crossings(crossings)
  {
  }

  void addCell(const CellCorner (&corners)[3])
  {
    int sides[3];
    for (int i = 0; i < 3; ++i)
    {
      sides[i] = orientation(flat(this->Begin), flat(this->End), flat(corners[i].At));
    }
    for (int i = 0; i < 3; ++i)
    {
      const CellCorner& a = corners[i];
      const CellCorner& b = corners[(i + 1) % 3];
      if (sides[i] == 0 && this->meetsBox(&corners[i], 1))
      {
        this->addPoint(a);
      }
      if (sides[i] * sides[(i + 1) % 3] < 0 &&
        orientation(flat(a.At), flat(b.At), flat(this->Begin)) *
            orientation(flat(a.At), flat(b.At), flat(this->End)) <
          0)
      {
        this->addEdge(a, b);
      }
    }
  }

  /// If the segment is in the plane of a face, its crossings with the face's edges are found in the
  /// cell's other faces.
  void addCell(const CellCorner (&corners)[4])
  {
    for (int face = 0; face < 4; ++face)
    {
      const CellCorner& a = corners[(face + 1) % 4];
      const CellCorner& b = corners[(face + 2) % 4];
      const CellCorner& c = corners[(face + 3) % 4];
      orientation3(a.At, b.At, c.At, this->Begin) * orientation3(a.At, b.At, c.At, this->End) < 0
        ? this->addFace(a, b, c)
        : void();
    }
  }

  bool meetsBox(const CellCorner* corners, int count) const
  {
    for (double Point3::*const axis : { &Point3::x, &Point3::y, &Point3::z })
    {
      double low = HUGE_VAL;
      double high = -HUGE_VAL;
      for (int i = 0; i < count; ++i)
      {
        if (!std::isfinite(corners[i].At.*axis))
        {
          return false;
        }
        low = std::min(low, corners[i].At.*axis);
        high = std::max(high, corners[i].At.*axis);
      }
      if (low > std::max(this->Begin.*axis, this->End.*axis) ||
        high < std::min(this->Begin.*axis, this->End.*axis))
      {
        return false;
      }
    }
    return true;
  }

private:
  double shareOf(const Point3& p) const
  {
    const Point3 along = this->End - this->Begin;
    return std::clamp(dot(p - this->Begin, along) / dot(along, along), 0.0, 1.0);
  }

  void addPoint(const CellCorner& point)
  {
    const double one = 1;
    this->add({ point.Id, point.Id, point.Id }, point.At, &point, &one, 1);
  }

  /// The position is weighted by the distances of the edge's ends from the line, in doubles. All
  /// cells at the edge compute the same bits.
  void addEdge(CellCorner a, CellCorner b)
  {
    b.Id < a.Id ? std::swap(a, b) : void();
    const Point3 along = this->End - this->Begin;
    const Point3 ofA = cross(along, a.At - this->Begin);
    const Point3 ofB = cross(along, b.At - this->Begin);
    const double distanceA = std::sqrt(dot(ofA, ofA));
    const double distanceB = std::sqrt(dot(ofB, ofB));
    const double sum = distanceA + distanceB;
    const double share = sum > 0 ? distanceA / sum : 0.5;
    const CellCorner ends[2] = { a, b };
    const double weights[2] = { 1 - share, share };
    this->add({ a.Id, b.Id, b.Id }, between(a.At, b.At, share), ends, weights, 2);
  }

  /// The ends of the segment are on different sides of the face's plane.
  void addFace(CellCorner a, CellCorner b, CellCorner c)
  {
    b.Id < a.Id ? std::swap(a, b) : void();
    c.Id < b.Id ? std::swap(b, c) : void();
    b.Id < a.Id ? std::swap(a, b) : void();
    const int ofA = orientation3(this->Begin, this->End, b.At, c.At);
    const int ofB = orientation3(this->Begin, this->End, c.At, a.At);
    const int ofC = orientation3(this->Begin, this->End, a.At, b.At);
    const auto [low, high] = std::minmax({ ofA, ofB, ofC });
    if (low < 0 && high > 0)
    {
      return; // the segment passes beside the face
    }
    const int zeros = (ofA == 0) + (ofB == 0) + (ofC == 0);
    if (zeros == 2)
    {
      this->addPoint(ofA != 0 ? a : ofB != 0 ? b : c);
    }
    else if (zeros == 1)
    {
      this->addEdge(ofA == 0 ? b : a, ofC == 0 ? b : c);
    }
    else if (zeros == 0)
    {
      const CellCorner corners[3] = { a, b, c };
      double weights[3];
      for (int i = 0; i < 3; ++i)
      {
        const Point3 along = this->End - this->Begin;
        weights[i] = std::fabs(dot(along,
          cross(corners[(i + 1) % 3].At - this->Begin, corners[(i + 2) % 3].At - this->Begin)));
      }
      const double sum = weights[0] + weights[1] + weights[2];
      Point3 at{ 0, 0, 0 };
      for (int i = 0; i < 3; ++i)
      {
        weights[i] = sum > 0 ? weights[i] / sum : 1.0 / 3;
        at.x += weights[i] * corners[i].At.x;
        at.y += weights[i] * corners[i].At.y;
        at.z += weights[i] * corners[i].At.z;
      }
      this->add({ a.Id, b.Id, c.Id }, at, corners, weights, 3);
    }
  }

  void add(const std::array<std::int64_t, 3>& ids, const Point3& at, const CellCorner* corners,
    const double* weights, int count)
  {
    Crossing crossing{ this->shareOf(at), ids, at, {} };
    for (const PartValues& values : this->Values)
    {
      for (int k = 0; values.description().OfPoints && k < values.description().Components; ++k)
      {
        const double first = values.atPoint(corners[0].Index, k);
        double value = first;
        for (int i = 1; i < count; ++i)
        {
          value += weights[i] * (values.atPoint(corners[i].Index, k) - first);
        }
        crossing.Values.push_back(value);
      }
    }
    this->Crossings.push_back(std::move(crossing));
  }

  const Point3& Begin;
  const Point3& End;
  const std::vector<PartValues>& Values;
  std::vector<Crossing>& Crossings;
};

template <typename Access>
void addCells(const Access& access, const MeshPart& part, SegmentCrossings& crossings)
{
  constexpr int corners = Access::Corners;
  // Includes borrowed cells, since only in this piece's box may they meet the segment.
  for (std::int64_t cell = 0; cell < part.Mesh.Cells; ++cell)
  {
    if (part.isHidden(cell))
    {
      continue;
    }
    CellCorner of[corners];
    for (int i = 0; i < corners; ++i)
    {
      of[i].Index = access.ids(cell)[i];
      of[i].At = access.point(of[i].Index);
      of[i].At.z = corners == 4 ? of[i].At.z : 0;
    }
    if (crossings.meetsBox(of, corners))
    {
      std::for_each(of, of + corners, [&part](CellCorner& c) { c.Id = part.pointId(c.Index); });
      crossings.addCell(of);
    }
  }
}

} // namespace

std::vector<std::vector<Crossing>> crossingsIn(const ResidentMesh& mesh,
  const std::vector<Point3>& polyline, const std::vector<std::string>& arrays, std::size_t first,
  std::size_t end)
{
  std::vector<std::vector<Crossing>> result(polyline.empty() ? 0 : polyline.size() - 1);
  std::mutex mutex;
  const auto pieces = std::int64_t(end - first);
  forChunks(pieces, 1, pieces > 1 ? threadCount(mesh.options().Threads) : 1, {},
    [&](std::int64_t i, std::int64_t, int)
    {
      poll();
      const std::size_t number = first + std::size_t(i);
      std::vector<std::size_t> met;
      const Bounds& b = mesh.mesh().Pieces[number].Box;
      const bool inSpace = mesh.mesh().CellSize == 4;
      const Box3 box{ { b[0], b[2], inSpace ? b[4] : 0 }, { b[1], b[3], inSpace ? b[5] : 0 } };
      for (std::size_t s = 0; s < result.size(); ++s)
      {
        const Point3& from = polyline[s];
        const Point3& to = polyline[s + 1];
        const bool isMet = !mesh.isStored() ||
          (inSpace ? tetrahedronMeetsBox(from, to, to, to, box)
                   : triangleMeetsBox(flat(from), flat(to), flat(to), box));
        isMet ? met.push_back(s) : void();
      }
      if (met.empty())
      {
        return;
      }
      const ResidentPieces::Lease piece = mesh.pieces().get(number, mesh.needsOf(arrays));
      const MeshPart& part = *piece->Part;
      std::vector<PartValues> values;
      values.reserve(arrays.size());
      for (const std::string& name : arrays)
      {
        values.emplace_back(part, mesh.find(name));
      }
      for (const std::size_t s : met)
      {
        std::vector<Crossing> own;
        SegmentCrossings crossings(polyline[s], polyline[s + 1], values, own);
        withAccess(part.Mesh, [&](const auto& access) { addCells(access, part, crossings); });
        const std::lock_guard<std::mutex> lock(mutex);
        result[s].insert(result[s].end(), own.begin(), own.end());
      }
    });
  for (std::vector<Crossing>& list : result)
  {
    sortUnique(list);
  }
  return result;
}

} // namespace tipp
