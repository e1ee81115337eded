// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippWriteAdcirc_h
#define tippWriteAdcirc_h

#include "Files/OutputPath.h"
#include "Meshes/TrianglesView.h"
#include "Points/PointTable.h"

#include <functional>
#include <optional>
#include <string>

namespace tipp
{

/// .14 and .grd.
bool isAdcircExtension(const std::string& extension);

/// Writes points and triangles as an ADCIRC grid. The depth of a node is the column depth, or else
/// the elevation with the other sign, or 0. `like`: a grid whose nodes are the first points; its
/// title, numbers of nodes and lists of boundaries are kept. Without it (empty) nodes are counted
/// from 1, and there are no boundaries. False if `aborted` said so; throws IOError.
bool writeAdcircGrid(const std::string& path, const PointTable& points, TrianglesView triangles,
  const std::string& like, const std::optional<PathState>& before,
  const std::function<bool()>& aborted);

} // namespace tipp

#endif
