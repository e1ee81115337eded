// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSweepKernel_h
#define tippSweepKernel_h

#include "Kernel/DelaunayKernel.h"
#include "Predicates/Geometry.h"
#include "SweepStrips.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace tipp
{

/// A Delaunay triangulation by a vertical line that sweeps over the points from left to right.
/// Triangles that no point to the right of the line can change are final, and are passed on at
/// once. So memory holds the points and their order, one strip, and the *front*: the triangles that
/// can still change. The triangles are those of a DelaunayKernel.
///
/// A strip is triangulated like a partition (Lemma 1), from its points and the front's vertices.
/// Let R be the box of the points of this and all later strips. The triangles whose closed
/// circumdisk meets R are correct. Those that meet the box of the later strips are the next front.
class SweepKernel
{
public:
  /// Indices of three points in the input, counter-clockwise.
  using Triangle = std::array<std::uint32_t, 3>;
  /// Receives the final triangles of each strip.
  using Sink = std::function<void(const std::vector<Triangle>&)>;

  struct Duplicate
  {
    std::uint32_t Point;
    std::uint32_t Representative; ///< the lowest index with these coordinates
  };

  /// `pointsInStrip` is approximate; 0 chooses it by the number of points.
  explicit SweepKernel(std::size_t pointsInStrip = 0)
    : PointsInStrip(pointsInStrip)
  {
  }

  /// Points must be finite. If all are collinear, there are no triangles, and duplicates are not
  /// reported.
  void triangulate(const Point2* points, std::size_t count, const Sink& sink);

  const std::vector<Duplicate>& duplicates() const { return this->Duplicates; }
  /// The number of points in all fronts together.
  std::size_t carried() const { return this->Carried; }

private:
  using Index = DelaunayKernel::Index;
  enum class State : char
  {
    Unknown,
    Front,
    Final
  };

  void takeStrip(const Point2* points, const std::uint32_t* places, std::size_t count);
  void nameDuplicates();
  void findFront(const Box2& ahead);
  void visit(Index triangle, const Box2& ahead);
  bool meets(Index triangle, const Box2& box) const;
  void collectFinal(const Box2& before);
  void collectFront();

  std::size_t PointsInStrip;
  DelaunayKernel Kernel;
  // Points of the front, followed by those of the strip.
  std::vector<Point2> Points;
  std::vector<std::uint32_t> Places;
  std::size_t FrontSize = 0;

  std::vector<State> States; ///< per triangle of the kernel
  std::vector<Index> Stack;
  std::vector<Triangle> Finished;
  std::vector<Duplicate> Duplicates;
  std::size_t Carried = 0;
};

} // namespace tipp

#endif
