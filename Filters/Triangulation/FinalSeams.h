// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippFinalSeams_h
#define tippFinalSeams_h

#include "Triangulation/SeamMesh.h"

#include <array>
#include <cstdint>
#include <vector>

namespace tipp
{

/// The seams' final triangles, as they come in. Of most only what the output takes is kept: they
/// are many, and their memory is fresh.
class VTKTIPPFILTERS_EXPORT FinalSeams
{
public:
  struct Triangle
  {
    std::array<std::int64_t, 3> Ids; ///< counter-clockwise, the lowest first
    PartitionIndex Partition;        ///< of that one
  };

  void add(const std::vector<SeamTriangle>& triangles);

  /// Replaces the triangles at the artificial points (Lemma 3). To be called once, after all came.
  void removeArtificialPoints(const std::vector<SeamVertex>& artificial);

  const std::vector<Triangle>& triangles() const { return this->Triangles; }

private:
  std::vector<Triangle> Triangles;
  std::vector<SeamTriangle> AtArtificial;
};

} // namespace tipp

#endif
