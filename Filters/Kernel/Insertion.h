// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippInsertion_h
#define tippInsertion_h

#include "Kernel/Cavity.h"
#include "Kernel/HalfEdgeMesh.h"
#include "Kernel/Instructions.h"
#include "Kernel/KernelPredicates.h"
#include "Predicates/Point2.h"

#include <vector>

namespace tipp
{

/// What insertions work on.
struct InsertionScene
{
  /// A vertex at the place of another, which stands for it.
  struct Coincidence
  {
    HalfEdgeMesh::Index Vertex;
    HalfEdgeMesh::Index Representative;
  };

  HalfEdgeMesh& Mesh;
  const Point2* Points; ///< of the vertices, the infinite one first
  KernelPredicates& Predicates;
  Cavity& Opened;
  HalfEdgeMesh::Index& Recent; ///< a finite triangle near the last insertion
  std::vector<Coincidence>& Coincidences;
};

/// Inserts vertices one after another into a mesh that has triangles and room for two more each.
using InsertVertices = void (*)(
  const InsertionScene& scene, HalfEdgeMesh::Index first, HalfEdgeMesh::Index end);

InsertVertices chooseInsertion(Instructions instructions);

} // namespace tipp

#endif
