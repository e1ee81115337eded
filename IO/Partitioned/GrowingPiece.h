// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippGrowingPiece_h
#define tippGrowingPiece_h

#include "Partitioned/FinishedPieces.h"
#include "Partitioned/PartitionedMesh.h"
#include "vtkTIPPIOModule.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <unordered_map>
#include <utility>
#include <vector>

namespace tipp
{

/// @file
/// The file of a piece of triangles or tetrahedra, written in two steps: the interior as soon as
/// the piece's own points are triangulated, and the border once its neighbours are. `number` is the
/// piece's index in the mesh. If a mesh of triangles has no path, no file is written: they are only
/// counted and hashed. All functions throw IOError.

/// The layout of points in rows of 8-byte words: x, y, further columns, and last the global id.
struct PointRowLayout
{
  std::size_t Words = 3; ///< words per row
  int Z = -1;            ///< the word that is the third coordinate; -1: it is 0
  /// The word of each of the mesh's point arrays; -1: the representative's id.
  std::vector<int> Attributes;

  std::int64_t id(const double* row) const
  {
    std::int64_t id = 0;
    std::memcpy(&id, row + this->Words - 1, sizeof(id));
    return id;
  }
  Point3 point(const double* row) const
  {
    return { row[0], row[1], this->Z < 0 ? 0 : row[this->Z] };
  }
};

template <typename Archive>
void serialize(Archive& archive, PointRowLayout& layout)
{
  archive(layout.Words, layout.Z, layout.Attributes);
}

/// The corners of a triangle or a tetrahedron; the fourth one of a triangle is 0.
using CellCorners = std::array<std::int32_t, 4>;

/// A range of triangles: three row indices each; of tetrahedra, four each, where the mesh has
/// those.
struct TriangleRange
{
  const std::int32_t* Begin; ///< row indices of the corners
  std::size_t Triangles;     ///< number of triangles, or tetrahedra
};

/// Returns a hash of a triangle's point ids that is independent of which corner comes first.
VTKTIPPIO_EXPORT std::uint64_t hashTriangle(std::int64_t a, std::int64_t b, std::int64_t c);

/// Returns the sum of the triangles' hashes; `rows` are those of their points.
std::uint64_t sumTriangles(
  const TriangleRange& triangles, const double* rows, const PointRowLayout& layout);

/// Copies a row's values of a point array to the array's next tuple.
void copyPoint(const PieceArray& array, const double* row, const PointRowLayout& layout,
  bool isGhost, std::int64_t representative, char* to);

/// Extends the bounds by a point; coordinates that are not finite, as z may be, are ignored.
void extendBounds(Box3& bounds, const Point3& point);

/// Sets the bounds of z to 0 if no point has extended them.
void completeBounds(Box3& bounds);

/// Numbers the distinct sets of pieces that borrow from one piece.
class VTKTIPPIO_EXPORT SharingSets
{
public:
  /// Returns the number of a set, which is given as an ascending list.
  int number(const std::vector<std::int32_t>& set);
  /// Returns the number of the union of two sets; -1 is the empty set.
  int unite(int a, int b);
  const std::vector<std::int32_t>& set(int number) const
  {
    return *this->Sets[static_cast<std::size_t>(number)];
  }
  /// Groups items by the number of their set (-1: none), in lexicographic order of the sets;
  /// appends to `groups`. Returns each set's index there, or -1.
  std::vector<int> groups(const std::vector<int>& setOf, std::vector<SharedGroup>& groups) const;

private:
  std::map<std::vector<std::int32_t>, int> Numbers;
  std::vector<const std::vector<std::int32_t>*> Sets;
  std::map<std::pair<int, int>, int> Unions;
};

/// What is remembered of a piece's interior after it is written, until the border is written.
///
/// Points are identified by index among those of all pieces; a piece's own points have consecutive
/// indices. *Interface* points are own points that cells of the border use.
struct VTKTIPPIO_EXPORT PieceInterior
{
  std::int64_t First = 0;                    ///< index of the first own point
  std::int64_t OwnPoints = 0;                ///< number of own points
  PieceSummary Room;                         ///< counts that the file has room for
  std::int64_t Points = 0;                   ///< own points that are not on the interface
  std::int64_t Cells = 0;                    ///< cells with only such points
  std::uint64_t TriangleSum = 0;             ///< sum of hashTriangle(); only without a file
  Box3 Extent;                               ///< bounds of the own points
  std::vector<std::uint64_t> Checksums;      ///< checksum of each array's first part
  std::vector<std::int64_t> InterfacePoints; ///< indices, ascending
  std::vector<double> InterfaceRows;         ///< rows of InterfacePoints, in their order
  /// Cells of own points alone with corners on the interface: positions in the piece, or -1 - k for
  /// the k-th interface point.
  std::vector<CellCorners> InterfaceCells;

  bool owns(std::int64_t point) const
  {
    return point >= this->First && point < this->First + this->OwnPoints;
  }
  /// The position of an own point in InterfacePoints; throws std::logic_error if it is not there.
  std::size_t interfacePosition(std::int64_t point) const;
  const double* interfaceRow(std::int64_t point, const PointRowLayout& layout) const
  {
    return this->InterfaceRows.data() + this->interfacePosition(point) * layout.Words;
  }
};

/// Leaves out First and OwnPoints, which the plan gives, and InterfacePoints and InterfaceRows,
/// which are stored in a section of their own.
template <typename Archive>
void serialize(Archive& archive, PieceInterior& interior)
{
  archive(interior.Room, interior.Points, interior.Cells, interior.TriangleSum, interior.Extent,
    interior.Checksums, interior.InterfaceCells);
}

/// The cells that a piece owns at its border, and the other pieces' points that they use (ghosts).
class VTKTIPPIO_EXPORT PieceBorder
{
public:
  /// Both must outlive this. `cellSize`: 3 for triangles, 4 for tetrahedra.
  PieceBorder(const PieceInterior& interior, const PointRowLayout& layout, std::size_t cellSize = 3)
    : Interior(interior)
    , Layout(layout)
    , CellSize(cellSize)
  {
  }

  /// Adds a cell of points that the other pieces `borrowers`, ascending, borrow; the list may be
  /// empty. There are `cellSize` points.
  void addCell(const std::int64_t* points, const std::vector<std::int32_t>& borrowers);
  std::size_t cells() const { return this->Cells.size(); }

  /// The ghosts of the cells so far. The caller must set their rows.
  const std::vector<std::int64_t>& ghosts() const { return this->Ghosts; }
  void setGhost(std::int64_t point, const double* row);

  struct Mesh
  {
    std::vector<double> Rows;
    std::vector<std::int32_t> Corners; ///< three row indices per triangle

    TriangleRange triangles() const { return { this->Corners.data(), this->Corners.size() / 3 }; }
  };
  /// Of a border of triangles.
  Mesh mesh() const;

private:
  friend class OrderedBorder;
  struct Cell
  {
    std::array<std::int64_t, 4> Points; ///< the fourth one of a triangle is not used
    std::uint64_t BorrowerEnd;          ///< end of its range in Borrowers
  };

  /// The index of a point: own points by their position on the interface, then the ghosts.
  std::size_t indexOf(std::int64_t point) const;
  /// The row of the point with this index.
  const double* row(std::size_t index) const;

  const PieceInterior& Interior;
  const PointRowLayout& Layout;
  const std::size_t CellSize;
  std::vector<Cell> Cells;
  std::vector<std::int32_t> Borrowers;
  std::vector<std::int64_t> Ghosts; ///< indices of ghost points, in the order of their rows
  std::unordered_map<std::int64_t, std::int64_t>
    GhostPosition; ///< by point: its position in Ghosts
  std::vector<double> GhostRows;
};

/// A border's points and cells in the order of the piece's file: by the set of their borrowers,
/// then points by global id and cells by their corners.
class OrderedBorder
{
public:
  struct Point
  {
    int Group; ///< index in PointGroups
    std::int64_t Id;
    const double* Row;
    bool IsGhost;
    std::size_t Index; ///< PieceBorder::indexOf()
  };
  struct Cell
  {
    int Group;          ///< index in CellGroups
    CellCorners Points; ///< positions in the piece, the lowest first
  };

  explicit OrderedBorder(const PieceBorder& border);

  std::vector<Point> Points;
  std::vector<Cell> Cells;
  std::vector<SharedGroup> PointGroups;
  std::vector<SharedGroup> CellGroups;

private:
  void uniteSets();
  void orderPoints();
  void addCell(int group, CellCorners corners);
  void addCells();

  const PieceBorder& Border;
  const PieceInterior& Interior;
  SharingSets Sets;
  std::vector<int> SetOf;             ///< by point: the number of its set
  std::vector<int> CellSets;          ///< by cell, the interface's first: the number of its set
  std::vector<std::int32_t> Position; ///< by point: its position in the piece
};

/// A piece whose own points are triangulated. Points are identified by row, except for `First`.
struct InteriorContent
{
  std::int64_t First = 0;       ///< index of the first own point among those of all pieces
  std::int64_t Points = 0;      ///< number of own points
  const double* Rows = nullptr; ///< their rows, see PointRowLayout; not owned
  const std::uint8_t* IsOnInterface = nullptr; ///< by point: not 0 if it is on the interface
  std::vector<TriangleRange> Triangles;        ///< or tetrahedra; all except the border's
  /// Duplicates: maps a point to the one with the same coordinates that represents it.
  const std::unordered_map<std::int32_t, std::int32_t>* Representatives = nullptr;
  bool IsSummed = true; ///< whether to hash triangles for which there is no file
};

/// The first step.
VTKTIPPIO_EXPORT PieceInterior writeInterior(const PartitionedMesh& mesh, std::size_t number,
  const PointRowLayout& layout, const InteriorContent& content);

/// The second step, once all triangles have been added to the border: completes the file, except
/// for the global ids of cells and of their neighbours. May be repeated.
VTKTIPPIO_EXPORT FinishedPiece writeBorder(const PartitionedMesh& mesh, std::size_t number,
  const PointRowLayout& layout, const PieceInterior& interior, const PieceBorder& border);

/// Verifies the interior's part of the file that an earlier process has left after the first step.
/// Then replaces the file by one of the interior alone, because the earlier process may have
/// written parts of the border, and other parts may be damaged.
VTKTIPPIO_EXPORT void verifyInterior(
  const PartitionedMesh& mesh, std::size_t number, const PieceInterior& interior);

} // namespace tipp

#endif
