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

/// Reads all pieces with their borrowed cells. Each cell must be owned by the lowest partition that
/// it meets in rational arithmetic, and borrowed by all others that it meets. Each point must
/// belong to one piece. Ids, coordinates and attributes must be those of the source.
void expectHolds(const std::string& path, const SourceMesh& source);

/// As expectHolds(), without the attributes.
void expectBelongs(const std::string& path, const SourceMesh& source);

/// Expects that two pieces, as read, are equal byte for byte.
void expectEqual(const Piece& a, const Piece& b);

/// The contents of all files in a folder and its subfolders, by relative path.
std::map<std::string, std::string> filesOf(const std::string& folder);

} // namespace test
} // namespace tipp

#endif
