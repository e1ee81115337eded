// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSimplexMesh_h
#define tippSimplexMesh_h

#include "Parallel/ParallelFor.h"
#include "Predicates/Geometry.h"
#include "Resample/Lattice.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace tipp
{

/// A view of triangles or tetrahedra in the caller's arrays. Not owned.
struct SimplexMesh
{
  const void* Points = nullptr; ///< x, y, z per point
  bool Float = false;           ///< Points are float32, else float64
  const void* Ids = nullptr;    ///< three or four point indices per cell
  bool Wide = false;            ///< Ids are int64, else int32
  std::int64_t Cells = 0;       ///< number of cells
  std::int64_t PointCount = 0;  ///< number of points
  /// one byte per cell, nonzero for cells that are ignored; may be null
  const unsigned char* Hidden = nullptr;
  /// 3 for tetrahedra. 2 for triangles, of which only the two coordinates along Axes are used.
  int Dimension = 2;
  int Axes[2] = { 0, 1 };
};

/// Where a point lies in a mesh of triangles or tetrahedra.
struct CellLocation
{
  std::int64_t Cell = -1; ///< index of the cell; -1: outside
  /// Barycentric weights of the cell's corners; zeros outside. Up to rounding they sum to 1 and are
  /// not negative. Triangles use the first three.
  double Weights[4] = {};
};

/// Typed access to the cells of a SimplexMesh.
template <int D, typename Coordinate, typename Id>
class SimplexAccess
{
public:
  static constexpr int Dimension = D;
  static constexpr int Corners = D + 1;
  using Point = tipp::Point<D>;

  explicit SimplexAccess(const SimplexMesh& mesh)
    : Points(static_cast<const Coordinate*>(mesh.Points))
    , Ids(static_cast<const Id*>(mesh.Ids))
    , U(mesh.Axes[0])
    , V(mesh.Axes[1])
  {
  }

  const Id* ids(std::int64_t cell) const { return this->Ids + cell * Corners; }

  [[gnu::always_inline]] void corners(std::int64_t cell, Point (&corners)[Corners]) const
  {
    for (int i = 0; i < Corners; ++i)
    {
      corners[i] = this->coordinates(this->ids(cell)[i]);
    }
  }

  /// The coordinates of a point that are used.
  [[gnu::always_inline]] Point coordinates(std::int64_t id) const
  {
    const Coordinate* p = this->Points + 3 * id;
    if constexpr (D == 2)
    {
      return { double(p[this->U]), double(p[this->V]) };
    }
    else
    {
      return { double(p[0]), double(p[1]), double(p[2]) };
    }
  }

  /// The coordinates that are used of a point in space.
  Point flattened(const Point3& p) const
  {
    if constexpr (D == 2)
    {
      return { p[this->U], p[this->V] };
    }
    else
    {
      return p;
    }
  }

  Point3 point(std::int64_t id) const
  {
    const Coordinate* p = this->Points + 3 * id;
    return { double(p[0]), double(p[1]), double(p[2]) };
  }

  /// Prefetches a cell's points, which may be anywhere in memory. Always inlined, because a
  /// compiler may drop a call to a function that only prefetches.
  [[gnu::always_inline]] void prefetch(std::int64_t cell) const
  {
    for (int i = 0; i < Corners; ++i)
    {
      __builtin_prefetch(this->Points + 3 * std::int64_t(this->ids(cell)[i]));
    }
  }

private:
  const Coordinate* Points;
  const Id* Ids;
  int U;
  int V;
};

/// Calls work(access) with the SimplexAccess of the mesh's types.
template <typename Work>
void withAccess(const SimplexMesh& mesh, const Work& work)
{
  const auto withIds = [&](auto dimension, auto scalar)
  {
    constexpr int d = decltype(dimension)::value;
    using Coordinate = decltype(scalar);
    mesh.Wide ? work(SimplexAccess<d, Coordinate, std::int64_t>(mesh))
              : work(SimplexAccess<d, Coordinate, std::int32_t>(mesh));
  };
  const auto withScalar = [&](auto dimension)
  // NOLINTNEXTLINE(bugprone-branch-clone): the types differ.
  { mesh.Float ? withIds(dimension, float()) : withIds(dimension, double()); };
  mesh.Dimension == 2 ? withScalar(std::integral_constant<int, 2>())
                      : withScalar(std::integral_constant<int, 3>());
}

/// Pivots below this share of the first one are rounding errors: the cell is flat.
constexpr double flatPivot = 4.4408920985006262e-16;

/// Computes the barycentric weights of a point in a thin triangle or tetrahedron: weights[i] is
/// that of corner i + 1; the first corner has the remainder. `edges` go from the first corner to
/// each of the others, and `offset` from there to the point.
///
/// Elimination with complete pivoting has a small residual: the weighted sum of the corners is the
/// point to a few roundings, so linear fields are reproduced, however thin the cell is.
inline void thinWeights(
  const double (&edges)[3][3], const double (&offset)[3], double (&weights)[3])
{
  constexpr int D = 3;
  double m[D][D + 1]; // a row per axis; the last column is the right-hand side
  int columns[D] = { 0, 1, 2 };
  for (int axis = 0; axis < D; ++axis)
  {
    for (int i = 0; i < D; ++i)
    {
      m[axis][i] = edges[i][axis];
    }
    m[axis][D] = offset[axis];
  }
  double reciprocals[D];
  double first = 0;
  for (int step = 0; step < D; ++step)
  {
    int pivotRow = step;
    int pivotColumn = step;
    for (int row = step; row < D; ++row)
    {
      for (int column = step; column < D; ++column)
      {
        const bool isLarger = std::fabs(m[row][column]) > std::fabs(m[pivotRow][pivotColumn]);
        pivotRow = isLarger ? row : pivotRow;
        pivotColumn = isLarger ? column : pivotColumn;
      }
    }
    std::swap(m[step], m[pivotRow]);
    std::swap(columns[step], columns[pivotColumn]);
    for (double(&row)[D + 1] : m)
    {
      std::swap(row[step], row[pivotColumn]);
    }
    first = step == 0 ? std::fabs(m[0][0]) : first;
    const bool isFlat = !(std::fabs(m[step][step]) > flatPivot * first);
    reciprocals[step] = isFlat ? 0 : 1 / m[step][step];
    for (int row = step + 1; row < D; ++row)
    {
      const double factor = m[row][step] * reciprocals[step];
      for (int column = step + 1; column <= D; ++column)
      {
        m[row][column] -= factor * m[step][column];
      }
    }
  }
  for (int i = D - 1; i >= 0; --i)
  {
    double value = m[i][D];
    for (int k = i + 1; k < D; ++k)
    {
      value -= m[i][k] * weights[columns[k]];
    }
    weights[columns[i]] = value * reciprocals[i];
  }
}

/// Solves the 2 x 2 system of a thin triangle's weights by elimination with complete pivoting, in
/// fewer instructions than the loops for any dimension.
inline void thinWeights(
  const double (&edges)[2][2], const double (&offset)[2], double (&weights)[2])
{
  int row = 0;
  int column = 0;
  for (int i = 1; i < 4; ++i)
  {
    const bool isLarger = std::fabs(edges[i % 2][i / 2]) > std::fabs(edges[column][row]);
    row = isLarger ? i / 2 : row;
    column = isLarger ? i % 2 : column;
  }
  const double pivot = edges[column][row];
  const double beside = edges[1 - column][row];
  const double first = std::fabs(pivot);
  const double ofPivot = first > flatPivot * first ? 1 / pivot : 0;
  const double factor = edges[column][1 - row] * ofPivot;
  const double rest = edges[1 - column][1 - row] - factor * beside;
  const double ofRest = std::fabs(rest) > flatPivot * first ? 1 / rest : 0;
  const double other = (offset[1 - row] - factor * offset[row]) * ofRest;
  weights[1 - column] = other;
  weights[column] = (offset[row] - beside * other) * ofPivot;
}

/// A subset of a mesh's cells, without hidden ones; shares the mesh's points.
class PartMesh
{
public:
  PartMesh(const SimplexMesh& whole, const std::vector<std::int32_t>& cells)
    : Mesh(whole)
  {
    withAccess(whole,
      [&](const auto& access)
      {
        for (const std::int32_t cell : cells)
        {
          this->Ids.insert(this->Ids.end(), access.ids(cell), access.ids(cell) + access.Corners);
        }
      });
    this->Mesh.Ids = this->Ids.data();
    this->Mesh.Wide = true;
    this->Mesh.Cells = std::int64_t(cells.size());
    this->Mesh.Hidden = nullptr;
  }
  PartMesh(const PartMesh&) = delete;
  PartMesh& operator=(const PartMesh&) = delete;

  const SimplexMesh& mesh() const { return this->Mesh; }

private:
  SimplexMesh Mesh;
  std::vector<std::int64_t> Ids;
};

/// The lattice's axes along which a mesh is sampled: two for triangles, three for tetrahedra.
struct LatticeAxes
{
  LatticeAxes(const SimplexMesh& mesh, const Lattice& lattice)
    : U(lattice, mesh.Dimension == 2 ? mesh.Axes[0] : 0)
    , V(lattice, mesh.Dimension == 2 ? mesh.Axes[1] : 1)
    , W(lattice, 2)
    , Layers(mesh.Dimension == 2 ? 1 : W.size())
  {
  }

  std::int64_t samples() const { return std::int64_t(U.size()) * V.size() * Layers; }

  LatticeAxis U;
  LatticeAxis V;
  LatticeAxis W;
  int Layers;
};

/// For each point a bit mask of the lattice's sides that it lies beyond. A cell whose points all
/// lie beyond one side has no samples. The test reads one byte per point instead of fetching
/// coordinates from random addresses.
template <typename Access>
class OutsidePoints
{
public:
  static constexpr int D = Access::Dimension;

  OutsidePoints(const SimplexMesh& mesh, const LatticeAxes& lattice)
    : Cells(mesh)
    , Count(mesh.PointCount)
    , Worthwhile(mesh.Cells > mesh.PointCount)
  {
    const LatticeAxis* const axes[3] = { &lattice.U, &lattice.V, &lattice.W };
    for (int axis = 0; axis < D; ++axis)
    {
      const LatticeAxis& samples = *axes[axis];
      const bool empty = samples.size() == 0;
      this->Low[axis] = empty ? 0 : samples[0];
      this->High[axis] = empty ? 0 : samples[samples.size() - 1];
    }
  }

  /// Computes the masks if most points are outside; otherwise leaves them null.
  void find(int threads)
  {
    if (!this->Worthwhile || !this->mostAreOutside())
    {
      return;
    }
    this->Sides.reset(new unsigned char[std::size_t(this->Count)]);
    forIndices(
      this->Count, [&](std::int64_t id) { this->Sides[std::size_t(id)] = this->sidesOf(id); },
      threads, 1 << 16);
  }

  /// One mask per point; null if find() has not computed them.
  const unsigned char* sides() const { return this->Sides.get(); }

  /// Whether a cell certainly has no samples; false before find().
  [[gnu::always_inline]] bool contain(std::int64_t cell) const
  {
    if (!this->Sides)
    {
      return false;
    }
    int common = 0xff;
    for (int i = 0; i <= D; ++i)
    {
      common &= this->Sides[std::size_t(this->Cells.ids(cell)[i])];
    }
    return common != 0;
  }

private:
  [[gnu::always_inline]] unsigned char sidesOf(std::int64_t id) const
  {
    const auto p = this->Cells.coordinates(id);
    int sides = 0;
    for (std::size_t axis = 0; axis < D; ++axis)
    {
      sides |= int(p[axis] < this->Low[axis]) << (2 * axis);
      sides |= int(p[axis] > this->High[axis]) << (2 * axis + 1);
    }
    return (unsigned char)(sides);
  }

  bool mostAreOutside() const
  {
    const std::int64_t step = std::max<std::int64_t>(1, this->Count / 1000);
    std::int64_t outside = 0;
    std::int64_t seen = 0;
    for (std::int64_t id = 0; id < this->Count; id += step, ++seen)
    {
      outside += this->sidesOf(id) != 0;
    }
    return 3 * outside > 2 * seen;
  }

  Access Cells;
  std::int64_t Count;
  bool Worthwhile;
  double Low[D];
  double High[D];
  std::unique_ptr<unsigned char[]> Sides;
};

} // namespace tipp

#endif
