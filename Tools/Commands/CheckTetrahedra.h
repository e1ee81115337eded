// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCheckTetrahedra_h
#define tippCheckTetrahedra_h

#include "Commands/Commands.h"
#include "Partitioned/PartitionedMesh.h"
#include "Partitioned/ReadPiece.h"
#include "Points/ReadPoints.h"

#include <fmt/format.h>

#include <cstddef>
#include <string>

namespace tipp
{

/// Returns whether the mesh is partitioned: only such a mesh is a folder. If its index is missing,
/// opening it says so.
bool isStoredInPieces(const std::string& mesh);

/// Returns the options to read a piece with the array NeighborIds, if there is one, and no other.
PieceOptions withNeighborsOnly(const PartitionedMesh& mesh);

/// Throws IOError: the mesh stores `count` points other than the `points` points of the input.
[[noreturn]] void refuseOtherPoints(
  const std::string& mesh, std::size_t count, std::size_t points, const std::string& input);

/// Compares numbers; NaN equals NaN here.
inline bool isSameNumber(double a, double b)
{
  return a == b || (a != a && b != b);
}

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

/// Returns whether a file or partitioned mesh holds tetrahedra. Throws IOError.
bool isOfTetrahedra(const std::string& mesh);

/// Checks tetrahedra in memory and prints the result. Returns the exit code. Throws IOError if a
/// file cannot be read, or if the mesh was made from other points.
int runCheckTetrahedra(
  const std::string& points, const std::string& mesh, PointOptions columns, bool tieRule);

} // namespace tipp

#endif
