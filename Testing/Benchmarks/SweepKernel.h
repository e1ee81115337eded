// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSweepKernel_h
#define tippSweepKernel_h

#include "Kernel/DelaunayKernel.h"
#include "Predicates/Points.h"
#include "SweepStrips.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace tipp
{

/// A Delaunay triangulation by a vertical line that sweeps over the points from left to right:
/// triangles that no point behind the line can change leave at once, so that in memory are, besides
/// the points and their order, one strip and the *front*: triangles that can still change. The
/// triangles are those of a DelaunayKernel.
///
/// A strip is triangulated as a partition is (Lemma 1): its points together with the front's
/// vertices, R being the box of all points that are not inserted yet. Triangles whose closed
/// circumdisk meets R before the strip are right, and those that still meet it after the strip are
/// the next front.
class SweepKernel
{
public:
  /// Counter-clockwise; places of points in their array.
  using Triangle = std::array<std::uint32_t, 3>;
  /// Takes final triangles, strip by strip.
  using Sink = std::function<void(const std::vector<Triangle>&)>;

  struct Duplicate
  {
    std::uint32_t Point;
    std::uint32_t Representative; ///< the first of all at that place
  };

  /// Approximate points of a strip; 0: chosen by their number.
  explicit SweepKernel(std::size_t pointsInStrip = 0)
    : PointsInStrip(pointsInStrip)
  {
  }

  /// Finite points; collinear ones have no triangles, and their duplicates are not told.
  void triangulate(const Point2* points, std::size_t count, const Sink& sink);

  const std::vector<Duplicate>& duplicates() const { return this->Duplicates; }
  /// Of the points of all fronts together.
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
  bool meets(Index triangle, const Box2& box) const;
  void collectFinal(const Box2& before);
  void collectFront();

  std::size_t PointsInStrip;
  DelaunayKernel Kernel;
  // Of the front, and then the strip.
  std::vector<Point2> Points;
  std::vector<std::uint32_t> Places;
  std::size_t FrontSize = 0;

  std::vector<State> States; ///< of the kernel's triangles
  std::vector<Index> Stack;
  std::vector<Triangle> Finished;
  std::vector<Duplicate> Duplicates;
  std::size_t Carried = 0;
};

} // namespace tipp

#endif
