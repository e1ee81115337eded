// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPlaneTriangles_h
#define tippPlaneTriangles_h

#include "Predicates/ExactPredicates.h"
#include "Predicates/Geometry.h"
#include "Resample/SimplexMesh.h"

#include <cstddef>
#include <cstdint>
#include <utility>

namespace tipp
{

/// A triangle of the plane, counter-clockwise.
struct PlaneTriangle
{
  Point2 At[3];
  std::int64_t Cell = 0;
  bool IsTurned = false; ///< corners 1 and 2 have been exchanged

  /// The index in the mesh's cell of corner i.
  int cornerOf(int i) const { return this->IsTurned && i > 0 ? 3 - i : i; }

  Box2 box() const
  {
    Box2 box = Box2::of(this->At[0], this->At[1]);
    box.extend(this->At[2]);
    return box;
  }
};

/// Reads triangles of a SimplexMesh of any types. The mesh's arrays must outlive it.
class TriangleReader
{
public:
  explicit TriangleReader(const SimplexMesh& mesh)
    : Mesh(mesh)
    , U(std::size_t(mesh.Axes[0]))
    , V(std::size_t(mesh.Axes[1]))
  {
  }

  std::int64_t id(std::int64_t cell, int corner) const
  {
    const std::size_t at = std::size_t(3 * cell + corner);
    return this->Mesh.Wide ? static_cast<const std::int64_t*>(this->Mesh.Ids)[at]
                           : static_cast<const std::int32_t*>(this->Mesh.Ids)[at];
  }

  Point2 point(std::int64_t id) const
  {
    const std::size_t at = 3 * std::size_t(id);
    if (this->Mesh.Float)
    {
      const float* const p = static_cast<const float*>(this->Mesh.Points) + at;
      return { double(p[this->U]), double(p[this->V]) };
    }
    const double* const p = static_cast<const double*>(this->Mesh.Points) + at;
    return { p[this->U], p[this->V] };
  }

  /// The coordinate of a point along the axis that the plane lacks.
  double height(std::int64_t id) const
  {
    const std::size_t at = 3 * std::size_t(id) + (3 - this->U - this->V);
    return this->Mesh.Float ? double(static_cast<const float*>(this->Mesh.Points)[at])
                            : static_cast<const double*>(this->Mesh.Points)[at];
  }

  bool isHidden(std::int64_t cell) const { return this->Mesh.Hidden && this->Mesh.Hidden[cell]; }

  /// The bounding box of a cell; empty if it is hidden.
  Box2 boxOf(std::int64_t cell) const
  {
    Box2 box = Box2::empty();
    if (!this->isHidden(cell))
    {
      box = Box2::of(this->point(this->id(cell, 0)), this->point(this->id(cell, 1)));
      box.extend(this->point(this->id(cell, 2)));
    }
    return box;
  }

  /// Prefetches a cell's points, which may be anywhere in memory. Always inlined, because a
  /// compiler may drop a call to a function that only prefetches.
  [[gnu::always_inline]] void prefetch(std::int64_t cell) const
  {
    const std::size_t bytes = this->Mesh.Float ? 3 * sizeof(float) : 3 * sizeof(double);
    for (int i = 0; i < 3; ++i)
    {
      __builtin_prefetch(
        static_cast<const char*>(this->Mesh.Points) + std::size_t(this->id(cell, i)) * bytes);
    }
  }

  /// Returns false if the cell is hidden, has a corner that is not finite, or has no area. The
  /// area's sign is exact.
  bool read(std::int64_t cell, PlaneTriangle& triangle) const
  {
    if (this->isHidden(cell))
    {
      return false;
    }
    for (int i = 0; i < 3; ++i)
    {
      triangle.At[i] = this->point(this->id(cell, i));
    }
    triangle.Cell = cell;
    const bool isUsable =
      isFinite(triangle.At[0]) && isFinite(triangle.At[1]) && isFinite(triangle.At[2]);
    const int turn = isUsable ? orientation(triangle.At[0], triangle.At[1], triangle.At[2]) : 0;
    triangle.IsTurned = turn < 0;
    if (triangle.IsTurned)
    {
      std::swap(triangle.At[1], triangle.At[2]);
    }
    return turn != 0;
  }

private:
  SimplexMesh Mesh;
  std::size_t U;
  std::size_t V;
};

} // namespace tipp

#endif
