// SPDX-License-Identifier: BSD-3-Clause
#include "Resample/NearBorder.h"

#include "Arrays/Concatenated.h"
#include "Arrays/Decimal.h"
#include "Predicates/ExactPredicates.h"
#include "Resample/SamplingAccess.h"

#include <cmath>
#include <cstddef>
#include <cstring>
#include <optional>
#include <tuple>
#include <type_traits>

namespace tipp
{

OpenBlocks::OpenBlocks(const LatticeAxes& axes)
  : Axes(axes)
{
  constexpr std::int64_t mostBlocks = 1 << 26;
  const auto blocks = [this](int size) { return ((std::int64_t(size) - 1) >> this->Shift) + 1; };
  while (blocks(axes.U.size()) * blocks(axes.V.size()) > mostBlocks)
  {
    ++this->Shift;
  }
  this->Columns = blocks(axes.U.size());
  this->Marks.resize(std::size_t(this->Columns * blocks(axes.V.size())), 0);
}

bool OpenBlocks::any() const
{
  return std::find(this->Marks.begin(), this->Marks.end(), 1) != this->Marks.end();
}

bool OpenBlocks::isAnyMarkedIn(const SampleBox& box) const
{
  const auto first = [this](int low, const LatticeAxis& axis)
  { return std::clamp(low - 1, 0, axis.size() - 1) >> this->Shift; };
  const auto last = [this](int high, const LatticeAxis& axis)
  { return std::clamp(high + 1, 0, axis.size() - 1) >> this->Shift; };
  const std::int64_t left = first(box.Low[0], this->Axes.U);
  const std::int64_t width = last(box.High[0], this->Axes.U) + 1 - left;
  const std::int64_t top = last(box.High[1], this->Axes.V);
  for (std::int64_t row = first(box.Low[1], this->Axes.V); row <= top; ++row)
  {
    const unsigned char* const marks = this->Marks.data() + row * this->Columns + left;
    if (std::memchr(marks, 1, std::size_t(width)))
    {
      return true;
    }
  }
  return false;
}

namespace
{

/// An edge of a triangle, from its lower to its higher end in lexicographic order, so that rounding
/// does not depend on how the triangle is stored.
struct Edge
{
  Point2 A;
  Point2 B;
  std::int64_t Ids[2];
};

/// The point of an edge that is nearest to a sample.
struct NearPoint
{
  double Weight;   ///< of the edge's end B
  double Distance; ///< the larger one of those along u and v
};

/// Returns the nearest point of an edge if it is within the slack of the sample. `alongU` tells
/// along which axis the edge has more samples.
std::optional<NearPoint> nearPoint(
  const Edge& edge, const LatticeAxes& axes, bool alongU, Point2 sample)
{
  const double length = alongU ? edge.B.x - edge.A.x : edge.B.y - edge.A.y;
  const double way = alongU ? sample.x - edge.A.x : sample.y - edge.A.y;
  const double weight = length == 0 ? 0 : std::clamp(way / length, 0.0, 1.0);
  // From the nearer end, so that the ends themselves are exact.
  const auto at = [weight](double a, double b)
  { return weight < 0.5 ? a + weight * (b - a) : b - (1 - weight) * (b - a); };
  const double u = std::fabs(at(edge.A.x, edge.B.x) - sample.x);
  const double v = std::fabs(at(edge.A.y, edge.B.y) - sample.y);
  const double slackU = std::max(axes.U.Slack, roundingOf(edge.A.x, edge.B.x));
  const double slackV = std::max(axes.V.Slack, roundingOf(edge.A.y, edge.B.y));
  const double across = alongU ? edge.B.y - edge.A.y : edge.B.x - edge.A.x;
  const double slope = length == 0 ? 0 : std::fabs(across / length);
  // Rounding along an edge moves it across, too.
  const bool isNear =
    u <= slackU + (alongU ? 0 : slope * slackV) && v <= slackV + (alongU ? slope * slackU : 0);
  return isNear ? std::make_optional(NearPoint{ weight, std::max(u, v) }) : std::nullopt;
}

/// Calls visit(sample, near point) for the open samples near an edge. Along the axis with more
/// samples the edge has at most one in each row or column.
template <typename IsOpen, typename Visit>
void forNearSamples(
  const Edge& edge, const LatticeAxes& axes, const IsOpen& isOpen, const Visit& visit)
{
  const bool alongU = std::fabs((edge.B.x - edge.A.x) * axes.U.Inverse) >=
    std::fabs((edge.B.y - edge.A.y) * axes.V.Inverse);
  const LatticeAxis& along = alongU ? axes.U : axes.V;
  const LatticeAxis& across = alongU ? axes.V : axes.U;
  const double a[2] = { alongU ? edge.A.x : edge.A.y, alongU ? edge.A.y : edge.A.x };
  const double b[2] = { alongU ? edge.B.x : edge.B.y, alongU ? edge.B.y : edge.B.x };
  const double slope = b[0] == a[0] ? 0 : (b[1] - a[1]) / (b[0] - a[0]);
  const auto last = [](const LatticeAxis& axis) { return axis.size() - 1; };
  // One more on either side, because positions are rounded.
  const int begin = std::max(int(along.position(std::min(a[0], b[0]))) - 2, 0);
  const int end = std::min(int(along.position(std::max(a[0], b[0]))), last(along));
  for (int i = begin; i <= end; ++i)
  {
    const double crossing =
      a[1] + slope * (std::clamp(along[i], std::min(a[0], b[0]), std::max(a[0], b[0])) - a[0]);
    const int j = std::clamp(int(across.position(crossing) - 0.5), 0, last(across));
    const std::int64_t number = (alongU ? j : std::int64_t(i)) * axes.U.size() + (alongU ? i : j);
    if (!isOpen(number))
    {
      continue; // as most samples are
    }
    const Point2 sample = alongU ? Point2{ along[i], across[j] } : Point2{ across[j], along[i] };
    const std::optional<NearPoint> near = nearPoint(edge, axes, alongU, sample);
    if (near)
    {
      visit(number, *near);
    }
  }
}

/// Finds the samples near the triangles of a mesh.
template <typename Access>
class NearFinder
{
public:
  NearFinder(const SimplexMesh& mesh, const LatticeAxes& axes, const GroupBoxes& boxes,
    const OpenBlocks& blocks, const std::function<bool(std::int64_t)>& isOpen, int threads)
    : Mesh(mesh)
    , Cells(mesh)
    , Axes(axes)
    , Boxes(boxes)
    , Blocks(blocks)
    , IsOpen(isOpen)
    , Threads(threads)
  {
  }

  std::vector<NearSample> run()
  {
    std::vector<std::vector<NearSample>> found(std::size_t(this->Threads));
    constexpr std::int64_t size = GroupBoxes::Size;
    forChunks((this->Mesh.Cells + size - 1) / size, 64, this->Threads, {},
      [&](std::int64_t begin, std::int64_t end, int thread)
      {
        for (std::int64_t group = begin; group < end; ++group)
        {
          const SampleBox* const box = this->Boxes.find(group);
          if (!box || this->Blocks.isAnyMarkedIn(*box))
          {
            this->visitGroup(group * size, std::min((group + 1) * size, this->Mesh.Cells),
              found[std::size_t(thread)]);
          }
        }
      });
    return firstOfEach(found);
  }

private:
  void visitGroup(std::int64_t begin, std::int64_t end, std::vector<NearSample>& found) const
  {
    for (std::int64_t cell = begin; cell < end; ++cell)
    {
      this->Cells.prefetch(cell);
    }
    for (std::int64_t cell = begin; cell < end; ++cell)
    {
      if (this->Blocks.isAnyMarkedIn(this->boxOf(cell)))
      {
        this->visit(cell, found);
      }
    }
  }

  SampleBox boxOf(std::int64_t cell) const
  {
    Point2 p[3];
    this->Cells.corners(cell, p);
    const auto index = [](const LatticeAxis& axis, double v) { return int(axis.position(v)) - 1; };
    const auto [left, right] = std::minmax(
      { index(this->Axes.U, p[0].x), index(this->Axes.U, p[1].x), index(this->Axes.U, p[2].x) });
    const auto [low, high] = std::minmax(
      { index(this->Axes.V, p[0].y), index(this->Axes.V, p[1].y), index(this->Axes.V, p[2].y) });
    return { { left, low }, { right, high } };
  }

  void visit(std::int64_t cell, std::vector<NearSample>& found) const
  {
    if (this->Mesh.Hidden && this->Mesh.Hidden[cell] != 0)
    {
      return;
    }
    Point2 corners[3];
    this->Cells.corners(cell, corners);
    const bool isFinite = std::all_of(corners, corners + 3,
      [](Point2 corner) { return std::isfinite(corner.x) && std::isfinite(corner.y); });
    if (!isFinite || orientation(corners[0], corners[1], corners[2]) == 0)
    {
      return; // such a cell claims nothing
    }
    const auto* const ids = this->Cells.ids(cell);
    for (int i = 0; i < 3; ++i)
    {
      const int j = (i + 1) % 3;
      const bool isUp = std::tie(corners[i].x, corners[i].y) < std::tie(corners[j].x, corners[j].y);
      const int a = isUp ? i : j;
      const int b = isUp ? j : i;
      const Edge edge{ corners[a], corners[b], { ids[a], ids[b] } };
      forNearSamples(edge, this->Axes, this->IsOpen,
        [&](std::int64_t sample, const NearPoint& near)
        {
          const CellKey key = withRank(keyOf(this->Cells, cell), nearOnly);
          found.push_back({ sample, std::int32_t(cell), key, near.Distance, { edge.A, edge.B },
            { edge.Ids[0], edge.Ids[1] }, near.Weight });
        });
    }
  }

  /// The cell of lowest key, and its nearest edge, for each sample.
  static std::vector<NearSample> firstOfEach(const std::vector<std::vector<NearSample>>& found)
  {
    std::vector<NearSample> all = concatenated(found);
    const auto order = [](const NearSample& near)
    {
      return std::make_tuple(near.Sample, near.Key, near.Distance, near.Ends[0].x, near.Ends[0].y,
        near.Ends[1].x, near.Ends[1].y, near.Cell);
    };
    std::sort(all.begin(), all.end(),
      [&](const NearSample& a, const NearSample& b) { return order(a) < order(b); });
    all.erase(std::unique(all.begin(), all.end(),
                [](const NearSample& a, const NearSample& b) { return a.Sample == b.Sample; }),
      all.end());
    return all;
  }

  const SimplexMesh& Mesh;
  Access Cells;
  const LatticeAxes& Axes;
  const GroupBoxes& Boxes;
  const OpenBlocks& Blocks;
  const std::function<bool(std::int64_t)>& IsOpen;
  const int Threads;
};

/// The value of an array at the nearest point of an edge. Integers are those of the nearer end.
template <typename T>
T valueAt(const NearSample& near, T a, T b)
{
  if constexpr (std::is_floating_point_v<T>)
  {
    return T(double(a) + near.Weight * (double(b) - double(a)));
  }
  else
  {
    return near.Weight > 0.5 ? b : a;
  }
}

template <typename T>
void fillArray(
  const std::vector<NearSample>& samples, const Attribute& attribute, const std::int64_t* parents)
{
  const auto* const values = static_cast<const T*>(attribute.Values);
  const std::int64_t components = attribute.Components;
  for (const NearSample& near : samples)
  {
    T* const to = static_cast<T*>(attribute.Samples) + near.Sample * components;
    const std::int64_t cell = parents ? parents[near.Cell] : near.Cell;
    for (std::int64_t i = 0; i < components; ++i)
    {
      to[i] = attribute.OfCells
        ? values[cell * components + i]
        : valueAt(near, values[near.Ids[0] * components + i], values[near.Ids[1] * components + i]);
    }
  }
}

} // namespace

std::vector<NearSample> nearSamples(const SimplexMesh& mesh, const LatticeAxes& axes, int threads,
  const GroupBoxes& boxes, const OpenBlocks& blocks,
  const std::function<bool(std::int64_t)>& isOpen)
{
  std::vector<NearSample> found;
  withSamplingAccess(mesh,
    [&](const auto& access)
    {
      using Access = std::decay_t<decltype(access)>;
      if constexpr (Access::Dimension == 2)
      {
        found = NearFinder<Access>(mesh, axes, boxes, blocks, isOpen, threads).run();
      }
    });
  return found;
}

void fillNear(const std::vector<NearSample>& samples, const std::vector<Attribute>& attributes,
  const std::int64_t* parents)
{
  for (const Attribute& attribute : attributes)
  {
    if (attribute.Values)
    {
      withScalar(
        attribute.Type, [&](auto type) { fillArray<decltype(type)>(samples, attribute, parents); });
    }
  }
}

} // namespace tipp
