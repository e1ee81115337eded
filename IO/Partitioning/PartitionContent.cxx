// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioning/PartitionContent.h"

#include "Files/IOError.h"
#include "Files/PendingFolder.h"
#include "Files/TemporaryPath.h"
#include "Parallel/Poll.h"
#include "Partitioned/PieceLayout.h"
#include "Partitioning/Ranks.h"

#include <algorithm>
#include <optional>
#include <vector>

namespace tipp
{
namespace
{

/// Removes the ids of the partitioned mesh that the data set was read from: the new one gets its
/// own.
void removeOwnIds(FlatContent& content)
{
  const auto drop = [](std::vector<FlatArray>& arrays, const std::string& name)
  {
    arrays.erase(std::remove_if(arrays.begin(), arrays.end(),
                   [&](const FlatArray& array) { return array.Name == name; }),
      arrays.end());
  };
  drop(content.PointData, pointIdsName);
  drop(content.CellData, cellIdsName);
}

/// Replaces paths in the temporary flat mesh by the input's name.
std::string inNameOf(std::string message, const std::string& folder, const std::string& name)
{
  const std::size_t begin = message.find(folder);
  if (begin != std::string::npos)
  {
    const std::size_t end = std::min(message.find_first_of(":,", begin), message.size());
    message.replace(begin, end - begin, name);
  }
  return message;
}

} // namespace

PartitionStatistics partitionContent(const std::function<FlatContent()>& make,
  const std::string& name, const std::string& output, const PartitionOptions& options,
  vtkMultiProcessController* controller)
{
  const Ranks ranks(controller);
  const PollScope polled([&options] { return !options.Progress || options.Progress(0); });
  // Removed with this object, or by the next run if this one is killed.
  std::optional<PendingFolder> scratch;
  std::string folder;
  std::string shown; // its path in messages, as the first rank shows it
  try
  {
    ranks.attempt(
      [&]
      {
        if (ranks.isFirst())
        {
          scratch.emplace(output, &replaceableMesh);
          folder = scratch->temporaryPath() + "/flat";
          shown = shownPath(folder);
          FlatContent content = make();
          removeOwnIds(content);
          try
          {
            writeFlatMesh(folder, content);
          }
          catch (const IOError& error) // for example, the disk is full
          {
            throw IOError(inNameOf(error.what(), shown, output));
          }
        }
      });
  }
  catch (const WorkAborted&)
  {
    PartitionStatistics statistics;
    statistics.Aborted = true;
    return statistics;
  }
  folder = ranks.broadcast(folder);
  shown = ranks.broadcast(shown);
  try
  {
    FlatMesh mesh;
    ranks.attempt([&] { mesh = openFlatMesh(folder); });
    return partitionMesh(mesh, output, options, controller);
  }
  catch (const IOError& error)
  {
    throw IOError(inNameOf(inNameOf(error.what(), folder, name), shown, name));
  }
}

} // namespace tipp
