// SPDX-License-Identifier: BSD-3-Clause
#include "Files/IOError.h"
#include "Files/OutputFile.h"
#include "Files/PendingOutput.h"
#include "Meshes/TextMeshes.h"
#include "Points/ReadPoints.h"

#include <set>
#include <string>

namespace tipp
{
namespace
{

constexpr int surfaceDimension = 2;

/// Writes the names of the physical groups, if there are any. Throws IOError for a negative region.
void writeGroups(OutputStream& out, const std::string& path, const MeshOptions& options)
{
  std::set<std::int64_t> groups(options.Regions.begin(), options.Regions.end());
  groups.erase(0);
  if (groups.empty())
  {
    return;
  }
  if (*groups.begin() < 0)
  {
    throw IOError(path,
      "cannot hold the region " + std::to_string(*groups.begin()) +
        ", because Gmsh numbers physical groups from 1; give regions numbers from 0.");
  }
  out << "$PhysicalNames\n" << groups.size() << "\n";
  for (const std::int64_t group : groups)
  {
    out << surfaceDimension << " " << group << " \"region " << group << "\"\n";
  }
  out << "$EndPhysicalNames\n";
}

void writeGmshElements(OutputStream& out, TrianglesView triangles, const MeshOptions& options)
{
  out << "$Elements\n" << triangles.size() << "\n";
  std::string line;
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    const std::int32_t region = options.Regions.empty() ? 0 : options.Regions[t];
    // Type 2, a triangle, and two tags: the physical group, or 0 for none, and the surface, which
    // must be positive.
    line = std::to_string(t + 1) + " 2 2 " + std::to_string(region) + ' ' +
      std::to_string(region > 0 ? region : 1);
    for (int corner = 0; corner < 3; ++corner)
    {
      line += ' ' + std::to_string(triangles.id(t, corner) + 1);
    }
    out << line << "\n";
  }
  out << "$EndElements\n";
}

} // namespace

bool writeGmshMesh(const std::string& path, const NodesView& nodes, TrianglesView triangles,
  const MeshOptions& options)
{
  requireFinite(path, nodes);
  const NodeValues elevations = elevationsOf(nodes);
  PendingFile pending(path, options.Before);
  OutputStream out(pending.file());
  out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
  writeGroups(out, path, options);
  out << "$Nodes\n" << nodes.size() << "\n";
  std::string line;
  for (std::size_t i = 0; i < nodes.size(); ++i)
  {
    line = std::to_string(i + 1);
    appendNode(line, nodes, i, elevations[i]);
    out << line << "\n";
  }
  out << "$EndNodes\n";
  writeGmshElements(out, triangles, options);
  return finishMesh(out, pending, options);
}

} // namespace tipp
