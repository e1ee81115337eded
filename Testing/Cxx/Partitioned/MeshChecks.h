// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippMeshChecks_h
#define tippMeshChecks_h

#include "SourceMesh.h"

#include "Partitioned/ReadPiece.h"

#include <map>
#include <string>

namespace tipp
{
namespace test
{

/// Reads all pieces with their borrowed cells: every cell is owned once, by the lowest partition
/// that it meets in rational arithmetic, and borrowed by all others it meets; every point belongs
/// to one piece; ids, coordinates and attributes are the source's.
void expectHolds(const std::string& path, const SourceMesh& source);

/// The same but for attributes.
void expectBelongs(const std::string& path, const SourceMesh& source);

/// The same bytes in all that was read.
void expectEqual(const Piece& a, const Piece& b);

/// Each file of a folder and those below it, by its path in the folder.
std::map<std::string, std::string> filesOf(const std::string& folder);

} // namespace test
} // namespace tipp

#endif
