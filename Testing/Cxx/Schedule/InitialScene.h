// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippInitialScene_h
#define tippInitialScene_h

#include "ScheduleTesting.h"

#include "Triangulation/BoundaryCells.h"
#include "Triangulation/InitialMesh.h"

namespace tipp
{
namespace test
{

/// What a run has before its first worker: partitions with points, and the initial mesh.
struct InitialScene
{
  InitialScene(const std::string& set, std::size_t count, int columns, int rows)
    : XY(makePointSet(set, count))
    , Boxes(Tiling::grid(boundsOf(this->XY), columns, rows))
    , Buckets(bucketPoints<std::int32_t>(view(this->XY), this->Boxes, 1))
    , Artificial(makeArtificialPoints(this->Boxes))
    , Vertices(chooseInitialPoints(this->Boxes, this->Buckets, 8, 1))
  {
    this->Vertices.insert(this->Vertices.end(), this->Artificial.begin(), this->Artificial.end());
    this->Mesh = triangulateVertices<2>(this->Boxes, this->Vertices, 1);
  }

  std::vector<PartitionIndex> partitionsWithPoints() const
  {
    std::vector<PartitionIndex> partitions;
    for (PartitionIndex p = 0; p < this->Boxes.size(); ++p)
    {
      if (this->Buckets.count(p) > 0)
      {
        partitions.push_back(p);
      }
    }
    return partitions;
  }

  Coordinates XY;
  Tiling Boxes;
  PointBuckets<std::int32_t> Buckets;
  std::vector<BoundaryVertex> Artificial;
  std::vector<BoundaryVertex> Vertices; ///< the artificial points are last
  BoundaryTriangles Mesh;
};

} // namespace test
} // namespace tipp

#endif
