// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCheckRuns_h
#define tippCheckRuns_h

#include "Check/DelaunayChecker.h"
#include "Commands/Commands.h"
#include "Constraints/ReadConstraintFile.h"
#include "Partitioned/PartitionedMesh.h"
#include "Partitioned/ReadPiece.h"
#include "Points/ReadPoints.h"

#include <fmt/format.h>

#include <cstddef>
#include <string>

namespace tipp
{

/// The options of `tipp check`.
struct CheckArguments
{
  std::string Points;
  std::string Mesh;
  PointOptions Columns;
  std::string Constraints; ///< path of a file; empty: none
  CheckOptions Options;

  /// Returns whether the mesh lacks triangles: with --cut, or if there are polygons or holes.
  bool isCutBy(const ConstraintTable& table) const
  {
    return this->Options.IsCut || table.PolygonBegin < table.Edges.size() || !table.Holes.empty();
  }
};

/// Returns whether the mesh is partitioned: only such a mesh is a folder. If its index is missing,
/// opening it says so.
bool isStoredInPieces(const std::string& mesh);

/// Returns the options to read a piece with the array NeighborIds, if there is one, and no other.
PieceOptions withNeighborsOnly(const PartitionedMesh& mesh);

/// Throws IOError: the mesh stores `found` points other than the `points` points of the input.
[[noreturn]] void refuseOtherPoints(
  const CheckArguments& arguments, std::size_t found, std::size_t points);

/// Throws IOError if the mesh stores points (`stored` is not empty) and they are not the input's
/// `points`. NaN equals NaN here. Both arrays hold `dimension` coordinates of each point.
void requireSamePoints(const CheckArguments& arguments, const std::vector<double>& points,
  const std::vector<double>& stored, std::size_t dimension);

/// Prints the end of a report's line, and its faults. Returns the exit code.
template <typename Report>
int printFaults(const Report& report)
{
  fmt::print("{}\n", report.isCorrect() ? "correct" : "FAULTY");
  for (const std::string& fault : report.faults())
  {
    fmt::print("  {}\n", fault);
  }
  return report.isCorrect() ? Success : Failure;
}

/// Checks the triangles of a partitioned mesh against points that are read block by block. One
/// piece at a time and the triangles near constraints are in memory. Throws IOError if a file
/// cannot be read, or if the mesh was made from other points.
CheckReport checkPartitioned(const CheckArguments& arguments);

/// Checks tetrahedra in memory and prints the result. Returns the exit code. Throws IOError if a
/// file cannot be read, or if the mesh was made from other points.
int checkTetrahedra(const CheckArguments& arguments);

} // namespace tipp

#endif
