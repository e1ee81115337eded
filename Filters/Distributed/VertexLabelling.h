// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippVertexLabelling_h
#define tippVertexLabelling_h

#include "Distributed/SeamGroups.h"

#include <vector>

namespace tipp
{

/// Makes vertices for a worker of those that masters keep. Keeps its memory for the next time.
class VTKTIPPFILTERS_EXPORT VertexLabelling
{
public:
  /// Each vertex once, by id, with the label that it has in the tiling. Sorts what it is given; the
  /// result lasts until the next call.
  const std::vector<SeamVertex>& label(const Tiling& boxes, std::vector<PlainVertex>& vertices);

private:
  std::vector<Point2> Points;
  std::vector<std::uint32_t> Partitions;
  std::vector<SeamVertex> Labelled;
};

} // namespace tipp

#endif
