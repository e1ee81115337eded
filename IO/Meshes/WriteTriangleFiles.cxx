// SPDX-License-Identifier: BSD-3-Clause
#include "Files/OutputFile.h"
#include "Files/PendingOutput.h"
#include "Meshes/TextMeshes.h"
#include "Models/TriangleFiles.h"
#include "Points/ReadPoints.h"

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tipp
{
namespace
{

/// Writes the .node file: points with the columns as attributes, the elevation first, because
/// attributes have no names.
void writeVertices(const OutputFile& file, const NodesView& nodes)
{
  std::vector<const NodeColumn*> attributes;
  for (const NodeColumn& column : nodes.columns())
  {
    attributes.push_back(&column);
  }
  const std::size_t elevation = findElevation(nodes.names());
  for (std::size_t i = elevation; i > 0 && elevation < attributes.size(); --i)
  {
    std::swap(attributes[i], attributes[i - 1]);
  }
  OutputStream out(file);
  out << nodes.size() << " 2 " << attributes.size() << " 0\n";
  std::string line;
  for (std::size_t i = 0; i < nodes.size(); ++i)
  {
    line = std::to_string(i + 1);
    appendNumber(line, nodes[i].x);
    appendNumber(line, nodes[i].y);
    for (const NodeColumn* const column : attributes)
    {
      appendNumber(line, column->Values[i]);
    }
    out << line << "\n";
  }
  out.finish();
}

void writeElementRows(const OutputFile& file, TrianglesView triangles, const RegionsView& regions)
{
  OutputStream out(file);
  out << triangles.size() << " 3 " << (regions.empty() ? 0 : 1) << "\n";
  std::string line;
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    line = std::to_string(t + 1);
    for (int corner = 0; corner < 3; ++corner)
    {
      line += ' ' + std::to_string(triangles.id(t, corner) + 1);
    }
    if (!regions.empty())
    {
      line += ' ' + std::to_string(regions[t]);
    }
    out << line << "\n";
  }
  out.finish();
}

/// Writes the .poly file, whose vertices are those of the .node file.
void writeSegments(const OutputFile& file, const std::vector<std::array<std::int64_t, 2>>& segments,
  const std::vector<Point2>& holes)
{
  OutputStream out(file);
  out << "0 2 0 0\n" << segments.size() << " 0\n";
  for (std::size_t i = 0; i < segments.size(); ++i)
  {
    out << i + 1 << " " << segments[i][0] + 1 << " " << segments[i][1] + 1 << "\n";
  }
  out << holes.size() << "\n";
  for (std::size_t i = 0; i < holes.size(); ++i)
  {
    std::string line = std::to_string(i + 1);
    appendNumber(line, holes[i].x);
    appendNumber(line, holes[i].y);
    out << line << "\n";
  }
  out.finish();
}

} // namespace

bool writeTriangleFiles(const std::string& path, const NodesView& nodes, TrianglesView triangles,
  const MeshOptions& options)
{
  requireFinite(path, nodes);
  const auto beforeOf = [&](const std::string& file)
  { return file == path ? options.Before : std::nullopt; };
  const std::string nodesPath = triangleFileBeside(path, ".node");
  const std::string elementsPath = triangleFileBeside(path, ".ele");
  PendingFile vertices(nodesPath, beforeOf(nodesPath));
  writeVertices(vertices.file(), nodes);
  PendingFile elements(elementsPath, beforeOf(elementsPath));
  writeElementRows(elements.file(), triangles, options.Regions);
  std::optional<PendingFile> segments;
  if (!options.Segments.empty())
  {
    segments.emplace(triangleFileBeside(path, ".poly"));
    writeSegments(segments->file(), options.Segments, options.Holes);
  }
  if (options.Aborted && options.Aborted())
  {
    return false;
  }
  vertices.commit();
  if (segments)
  {
    segments->commit();
  }
  elements.commit();
  return true;
}

} // namespace tipp
