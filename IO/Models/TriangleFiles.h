// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTriangleFiles_h
#define tippTriangleFiles_h

#include "Files/TextFile.h"

#include <cstdint>
#include <string>
#include <vector>

namespace tipp
{

/// Completes messages about the files of Shewchuk's Triangle
/// (https://www.cs.cmu.edu/~quake/triangle.html): "check that it is ...".
constexpr const char* triangleFileKind = "a file of Triangle";

/// The vertices of a .node or .poly file, numbered from 0 or 1 there.
struct TriangleVertices
{
  std::vector<double> XY;
  std::vector<std::vector<double>> Attributes; ///< one vector per attribute
  std::int64_t First = 0;                      ///< number of the first vertex
};

/// Reads the next row and checks that all its fields are numbers. Throws IOError.
void nextTriangleRow(NumberRows& rows, std::size_t fields, const char* what);

/// Reads a row whose first field is the number of rows that follow. `what` names this number in
/// messages. Throws IOError if the file has fewer lines.
std::int64_t nextTriangleCount(NumberRows& rows, const char* what);

/// Reads the rows of vertices, after a row of their number. Throws IOError, also for vertices in
/// space.
TriangleVertices readTriangleVertices(NumberRows& rows);

/// The path of the file with this extension, in lower case, that belongs to `path`, such as x.ele
/// to x.node; the path itself if it has the extension.
std::string triangleFileBeside(const std::string& path, const std::string& extension);

} // namespace tipp

#endif
