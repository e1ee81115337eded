// SPDX-License-Identifier: BSD-3-Clause
#include "Meshes/TextMeshes.h"

#include "Arrays/ShortestText.h"
#include "Files/IOError.h"
#include "Files/TextFile.h"

#include <algorithm>

namespace tipp
{

void appendNumber(std::string& line, double value)
{
  NumberText text;
  line += ' ';
  line.append(text.data(), writeShortest(text, value));
}

void appendNode(std::string& line, const NodesView& nodes, std::size_t node, double third)
{
  appendNumber(line, nodes[node].x);
  appendNumber(line, nodes[node].y);
  appendNumber(line, third);
}

bool finishMesh(OutputStream& out, PendingFile& pending, const MeshOptions& options)
{
  out.finish();
  if (options.Aborted && options.Aborted())
  {
    return false;
  }
  pending.commit();
  return true;
}

void requireFinite(const std::string& path, const NodesView& nodes)
{
  for (std::size_t i = 0; i < nodes.size(); ++i)
  {
    if (!isFinite(nodes[i]))
    {
      throw IOError(path,
        "cannot hold point " + std::to_string(i) +
          ", whose coordinates are not finite; remove it, or write .vtu.");
    }
  }
}

namespace
{

/// The first of two columns that the nodes have, the second one negated; else zeros. `first` and
/// `second` are indices of columns, or the number of columns.
NodeValues valuesOrNegated(const NodesView& nodes, std::size_t first, std::size_t second)
{
  const std::vector<NodeColumn>& columns = nodes.columns();
  if (first < columns.size())
  {
    return { &columns[first], false };
  }
  return second < columns.size() ? NodeValues{ &columns[second], true } : NodeValues();
}

std::size_t findDepth(const NodesView& nodes)
{
  const auto found = std::find_if(nodes.columns().begin(), nodes.columns().end(),
    [](const NodeColumn& column) { return lowerCase(column.Name) == "depth"; });
  return std::size_t(found - nodes.columns().begin());
}

} // namespace

NodeValues depthsOf(const NodesView& nodes)
{
  return valuesOrNegated(nodes, findDepth(nodes), findElevation(nodes.names()));
}

NodeValues elevationsOf(const NodesView& nodes)
{
  return valuesOrNegated(nodes, findElevation(nodes.names()), findDepth(nodes));
}

} // namespace tipp
