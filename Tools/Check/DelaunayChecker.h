// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDelaunayChecker_h
#define tippDelaunayChecker_h

#include "Check/ExactTests.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace tipp
{

/// An edge that constraints fix: two point ids, the lower first.
using FixedEdge = std::array<std::int64_t, 2>;

struct CheckOptions
{
  /// Also require that ties are broken by the rule that makes the triangulation unique. With the
  /// points lifted to the paraboloid, the lexicographically largest of four co-circular points is
  /// raised. So the edge between the two triangles is the diagonal that does not end at this point.
  bool TieRule = false;
  /// The mesh has a boundary other than the convex hull, such as a coast. Neither the hull nor
  /// Euler's formula is checked.
  bool BoundaryFree = false;
  /// The edges of constraints, sorted. They need not be locally Delaunay.
  std::vector<FixedEdge> Constraints;
  /// Triangles outside of polygons have been removed. Every boundary edge must be a constraint or
  /// an edge of the convex hull, and points may be unused. Nothing else of the boundary is checked.
  bool IsCut = false;
};

/// The result of a check of triangles or tetrahedra. The facets of a triangle are its edges. The
/// members from BadIds on count faults, except those named Undecided.
struct CheckReport
{
  /// Returns a line for each kind of fault whose count is not 0.
  std::vector<std::string> faults() const;
  /// Returns a line for each kind of thing that the check cannot decide.
  std::vector<std::string> undecided() const;
  /// Returns whether the check proves that the mesh is right.
  bool isCorrect() const { return this->faults().empty() && this->undecided().empty(); }

  bool InSpace = false; ///< the cells are tetrahedra
  std::int64_t Points = 0;
  std::int64_t DistinctPoints = 0; ///< distinct points with finite coordinates
  std::int64_t Cells = 0;
  std::int64_t BoundaryFacets = 0; ///< facets of one cell
  std::int64_t Ties = 0;           ///< interior facets whose two cells are on one circle or sphere

  std::int64_t BadIds = 0;   ///< cells with an id that does not exist, or of a point not finite
  std::int64_t BadTurns = 0; ///< cells that are inverted or flat
  /// Facets in three or more cells, or in two on the same side.
  std::int64_t BadFacets = 0;
  /// Interior facets with a point inside the neighbour's circle or sphere.
  std::int64_t BadSpheres = 0;
  std::int64_t BadTies = 0;      ///< ties broken against the rule; counted with the tie rule only
  std::int64_t UnusedPoints = 0; ///< distinct points in no cell
  std::int64_t TwinVertices = 0; ///< vertices that have the coordinates of another vertex
  std::int64_t BadHullEdges = 0; ///< edges at which the boundary is not closed or not convex
  std::int64_t LostConstraints = 0; ///< constraints that are no chain of edges
  /// As in ConstraintChains: neither faults nor correct.
  std::int64_t UndecidedConstraints = 0;
  std::int64_t UndecidedEdges = 0;
  /// Boundary edges, if IsCut, that are neither constraints nor on the hull.
  std::int64_t OpenBoundary = 0;
  /// Edges (corners) with a wrong neighbour; counted if `neighbors` are given.
  std::int64_t BadNeighbors = 0;
  /// For triangles: their number less 2 n - 2 - h, for n distinct points and h boundary edges. For
  /// tetrahedra: vertices - edges + facets - tetrahedra - 1; also of the hull.
  std::int64_t EulerMismatch = 0;
};

/// One piece of a mesh, with all triangles at its points. Some of these are owned by other pieces.
struct CheckedPiece
{
  std::vector<double> XY;              ///< x and y of its points, including ghost points
  std::vector<std::int64_t> Ids;       ///< global ids of the points
  std::vector<bool> IsOwn;             ///< by point: whether the piece owns it
  std::vector<std::int64_t> Triangles; ///< three indices of the piece's points each
  std::int64_t OwnTriangles = 0;       ///< they come first in Triangles
  std::vector<std::int64_t> CellIds;   ///< global ids of the own triangles
  /// For each corner of an own triangle, the global id of the neighbour opposite to it, or -1.
  /// Empty if the mesh does not store them.
  std::vector<std::int64_t> Neighbors;
};

/// Checks in exact arithmetic whether triangles are the Delaunay triangulation of the distinct
/// finite points, piece by piece: only one piece and the edges between pieces are in memory. It
/// does not compute a triangulation: by Delaunay's lemma it is enough that the triangles are
/// counter-clockwise, locally Delaunay, and meet edge to edge within a convex boundary. Ties may be
/// broken either way unless TieRule is set. Fewer than three points, or collinear ones, have no
/// triangles.
class PieceChecker
{
public:
  /// `given`: points with this id and higher ids are not input points, and are left out of
  /// pointSum() and givenPoints().
  explicit PieceChecker(
    const CheckOptions& options, std::int64_t given = std::numeric_limits<std::int64_t>::max())
    : Options(options)
    , Given(given)
  {
  }

  /// Checks a piece.
  void add(const CheckedPiece& piece);
  /// Returns the result; call it after all pieces.
  CheckReport finish();

  /// A hash of the ids and coordinates of the owned input points. Equal sums mean equal points,
  /// except with a probability of 2^-64.
  std::uint64_t pointSum() const { return this->PointSum; }
  /// The number of owned input points.
  std::int64_t givenPoints() const { return this->GivenPoints; }
  static std::uint64_t hashPoint(std::int64_t id, double x, double y);

private:
  struct Vertex
  {
    check::Position At;
    bool IsUsed; ///< by a triangle
  };

  /// An edge of a triangle, and the vertex opposite to it.
  struct Edge
  {
    std::array<std::int64_t, 2> Ids; ///< global point ids, the lower first
    bool IsReversed;                 ///< in the triangle it goes from the higher id to the lower
    std::array<check::Position, 2> Ends;
    check::Position Opposite;
    bool IsSound; ///< the triangle is counter-clockwise
    /// Global id of the triangle; -1 if no neighbours are stored.
    std::int64_t Cell;
    std::int64_t Neighbor; ///< as stored with the triangle
  };

  void checkTriangles(const CheckedPiece& piece);
  void checkPoints(const CheckedPiece& piece);
  template <typename Index>
  void checkEdges(const CheckedPiece& piece);
  void checkPair(const Edge& a, const Edge& b);
  void checkInside(const CheckedPiece& piece, std::size_t halfEdge, std::size_t twin);
  void checkCircle(check::Position a, check::Position b, check::Position c, check::Position d);
  bool isConstraint(const FixedEdge& ids) const;
  void keepHull(const std::vector<Vertex>& vertices);
  void matchEdges();
  Edge edgeOf(const CheckedPiece& piece, std::size_t halfEdge) const;

  CheckOptions Options;
  CheckReport Report;
  std::vector<char> IsSound; ///< by triangle of the current piece: counter-clockwise
  std::vector<char> IsGood;  ///< by triangle: its points exist and are finite
  std::vector<Edge> Open;    ///< edges of which only one triangle has been found so far
  const std::int64_t Given;
  std::int64_t GivenPoints = 0;
  std::uint64_t PointSum = 0;
  std::vector<double> HullXY; ///< with IsCut: the points of the pieces' convex hulls
  bool IsCollinear = true;
  /// Up to two points; if IsCollinear, all points so far are on their line.
  std::vector<check::Position> Line;
};

/// A mesh in memory as a piece that owns everything, without neighbours.
CheckedPiece wholeMesh(std::vector<double> xy, std::vector<std::int64_t> triangles);

/// Checks a mesh that is one piece.
CheckReport checkWhole(const CheckedPiece& mesh, const CheckOptions& options);

/// Checks a mesh in memory, as one piece. `xy` holds x and y of each point, `triangles` three
/// indices of points each. `neighbors` holds for each corner the index of the triangle opposite to
/// it, or -1; empty: not checked.
CheckReport checkDelaunay(std::vector<double> xy, std::vector<std::int64_t> triangles,
  const CheckOptions& options = {}, std::vector<std::int64_t> neighbors = {});

/// The constraints of a mesh.
struct ConstraintsInMesh
{
  std::vector<FixedEdge> Edges; ///< two points for each constraint
  /// Returns whether a point of the mesh is none of the input. Constraints cross at such points.
  std::function<bool(std::int64_t)> IsAdded;
  bool IsCut = false;   ///< as in CheckOptions
  bool TieRule = false; ///< as in CheckOptions
};

/// The constraints, as chains of edges of a mesh.
struct ConstraintChains
{
  std::vector<FixedEdge> Edges; ///< sorted, without duplicates
  std::int64_t Lost = 0;        ///< number of constraints without a chain
  /// Number of constraints with a chain that rounding may explain, which is not proved.
  std::int64_t UndecidedConstraints = 0;
  /// Number of edges that must be on constraints, may be, and are not on the chains found.
  std::int64_t UndecidedEdges = 0;
};

/// Finds for each constraint a chain of edges between its two points. Where rounding may have led a
/// constraint along several chains, those are chosen that together pass all edges that are not
/// locally Delaunay. All tests are exact. The result is a proof either way:
///
/// - A chain found is explained by snap rounding: the constraint passes through the box of points
///   that round to a vertex, or is split at such vertices into parts that do, in any number of
///   rounds. The vertices are ends or crossings of constraints, or on the constraint.
/// - If a constraint is lost, no chain is as near as up to 29 rounds of rounding can lead it.
///
/// What is between these is counted as undecided. Constraints whose ends are equal or not finite
/// need no chain. `xy` holds x and y of each point; `triangles` (three each) and the constraints
/// hold indices of these points. If the mesh is cut, chains may have gaps where the constraint is
/// outside of it.
ConstraintChains findConstraintChains(const std::vector<double>& xy,
  const std::vector<std::int64_t>& triangles, const ConstraintsInMesh& constraints);

/// Finds the chains of the constraints in a mesh in pieces: read(number) returns a piece.
/// `constraintXY` holds x and y of the constraints' points, to which the constraints refer; IsAdded
/// takes global ids. Returns edges by global ids. Keeps in memory only triangles near constraints:
/// those with an edge on one, or in a cut mesh all those at vertices on constraints, which show its
/// border there.
ConstraintChains findConstraintChains(std::size_t pieces,
  const std::function<CheckedPiece(std::size_t)>& read, const std::vector<double>& constraintXY,
  const ConstraintsInMesh& constraints);

/// Checks in exact arithmetic whether tetrahedra are the Delaunay triangulation of the distinct
/// finite points. It does not compute a triangulation: by Delaunay's lemma it is enough that the
/// tetrahedra are positively oriented, locally Delaunay, and meet facet to facet within one closed
/// convex surface. Ties between points on a sphere may be broken either way unless `tieRule` is
/// set. Points in one plane have no tetrahedra.
///
/// `xyz` holds the coordinates of each point, `tetrahedra` four indices of points each. `neighbors`
/// holds for each corner the index of the tetrahedron opposite to it, or -1; empty: not checked.
CheckReport checkTetrahedra(const std::vector<double>& xyz,
  const std::vector<std::int64_t>& tetrahedra, bool tieRule,
  const std::vector<std::int64_t>& neighbors = {});

} // namespace tipp

#endif
