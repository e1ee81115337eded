// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPartMesh_h
#define tippPartMesh_h

#include "Resample/SimplexMesh.h"

#include <cstdint>
#include <vector>

namespace tipp
{

/// Some cells of a mesh, none of them hidden, with the mesh's points.
class PartMesh
{
public:
  PartMesh(const SimplexMesh& whole, const std::vector<std::int32_t>& cells)
    : Mesh(whole)
  {
    withAccess(whole,
      [&](const auto& access)
      {
        for (const std::int32_t cell : cells)
        {
          this->Ids.insert(this->Ids.end(), access.ids(cell), access.ids(cell) + access.Corners);
        }
      });
    this->Mesh.Ids = this->Ids.data();
    this->Mesh.Wide = true;
    this->Mesh.Cells = std::int64_t(cells.size());
    this->Mesh.Hidden = nullptr;
  }
  PartMesh(const PartMesh&) = delete;
  PartMesh& operator=(const PartMesh&) = delete;

  const SimplexMesh& mesh() const { return this->Mesh; }

private:
  SimplexMesh Mesh;
  std::vector<std::int64_t> Ids;
};

} // namespace tipp

#endif
