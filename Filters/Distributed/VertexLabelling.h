// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippVertexLabelling_h
#define tippVertexLabelling_h

#include "Distributed/SeamGroups.h"

#include <vector>

namespace tipp
{

/// Makes vertices for a worker of those that masters keep: each once, by id, with the label that it
/// has in the tiling. Sorts what it is given.
VTKTIPPFILTERS_EXPORT std::vector<SeamVertex> labelVertices(
  const Tiling& boxes, std::vector<PlainVertex>& vertices);

/// Triangles of another tiling, with the labels that their vertices have in this one, and what they
/// meet there.
VTKTIPPFILTERS_EXPORT SeamTriangles labelTriangles(
  const Tiling& boxes, const std::vector<SeamTriangle>& triangles);

} // namespace tipp

#endif
