// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippInsertion_h
#define tippInsertion_h

#include "Kernel/Cavity.h"
#include "Kernel/HalfEdgeMesh.h"
#include "Kernel/KernelPredicates.h"
#include "Kernel/Lanes.h"
#include "Predicates/Point2.h"

#include <vector>

namespace tipp
{

/// The data that insertions read and change. Vertex 0 is the infinite one.
struct InsertionScene
{
  /// A vertex with the coordinates of another one, its representative.
  struct Coincidence
  {
    HalfEdgeMesh::Index Vertex;
    HalfEdgeMesh::Index Representative;
  };

  HalfEdgeMesh& Mesh;
  const Point2* Points; ///< coordinates of the vertices, the infinite one first
  KernelPredicates& Predicates;
  Cavity& Opened;
  HalfEdgeMesh::Index& Recent; ///< a finite triangle near the last insertion
  std::vector<Coincidence>& Coincidences;
};

/// Inserts vertices [first, end) in order into a mesh that has triangles, and capacity for two more
/// for each vertex.
void insertVertices(const InsertionScene& scene, HalfEdgeMesh::Index first, HalfEdgeMesh::Index end,
  Instructions instructions);

} // namespace tipp

#endif
