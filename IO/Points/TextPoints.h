// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTextPoints_h
#define tippTextPoints_h

#include "Points/ReadPoints.h"

namespace tipp
{

/// Points from text, one a line; numbers may have decimal commas where commas do not part columns;
/// the delimiter (semicolon, comma, tab or blanks) and a line of names, one with nothing but the
/// count or with the counts of points and of no edges are found. Lines that are empty or start with
/// # do not count. A further column is kept if all its values are numbers or missing (then NaN);
/// without names the first is z and the others column<number>.
PointTable readTextPoints(const std::string& path, const PointOptions& options);

/// .csv, .tsv, .txt, .xyz and .pts, and .gz, .xz and .zst, which are text compressed; and "-", the
/// standard input.
bool isTextPath(const std::string& path);

} // namespace tipp

#endif
