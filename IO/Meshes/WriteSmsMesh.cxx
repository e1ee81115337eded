// SPDX-License-Identifier: BSD-3-Clause
#include "Files/OutputFile.h"
#include "Files/PendingOutput.h"
#include "Meshes/TextMeshes.h"
#include "Points/ReadPoints.h"

#include <string>

namespace tipp
{

bool writeSmsMesh(const std::string& path, const NodesView& nodes, TrianglesView triangles,
  const MeshOptions& options)
{
  requireFinite(path, nodes);
  const NodeValues elevations = elevationsOf(nodes);
  PendingFile pending(path, options.Before);
  OutputStream out(pending.file());
  out << "MESH2D\nMESHNAME \"Triangles made by tipp\"\nNUM_MATERIALS_PER_ELEM 1\n";
  std::string line;
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    line = "E3T " + std::to_string(t + 1);
    for (int corner = 0; corner < 3; ++corner)
    {
      line += ' ' + std::to_string(triangles.id(t, corner) + 1);
    }
    line += ' ' + std::to_string(options.Regions.empty() ? 1 : options.Regions[t]);
    out << line << "\n";
  }
  for (std::size_t i = 0; i < nodes.size(); ++i)
  {
    line = "ND " + std::to_string(i + 1);
    appendNode(line, nodes, i, elevations[i]);
    out << line << "\n";
  }
  return finishMesh(out, pending, options);
}

} // namespace tipp
