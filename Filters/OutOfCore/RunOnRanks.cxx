// SPDX-License-Identifier: BSD-3-Clause
#include "OutOfCore/RunOnRanks.h"

#include "Files/IOError.h"
#include "Parallel/Stopwatch.h"

#include <filesystem>
#include <fstream>
#include <new>
#include <optional>
#include <random>
#include <stdexcept>

namespace tipp
{
namespace
{

std::string firstLine(const std::string& path)
{
  std::string line;
  std::getline(std::ifstream(path), line);
  return line;
}

} // namespace

void requireSharedFolder(Communicator& ranks, const std::string& folder)
{
  const bool isFirst = ranks.rank() == 0;
  std::optional<TemporaryFile> mark;
  std::string path;
  std::string expected;
  if (isFirst)
  {
    path = folder + "/.ranks";
    mark.emplace(path);
    std::random_device random;
    expected = std::to_string(random()) + " " + std::to_string(random());
    std::ofstream(path) << expected << "\n";
    if (firstLine(path) != expected)
    {
      throw IOError(path, "cannot be written.");
    }
  }
  path = ranks.broadcast(path);
  expected = ranks.broadcast(expected);
  if (firstLine(path) != expected)
  {
    throw IOError(std::filesystem::path(path).parent_path().string(),
      "does not exist on this rank, but all ranks use it; name folders that all ranks share.");
  }
  ranks.barrier(); // all ranks have read the file, so it can be removed
}

Message waitForOrder(Communicator& ranks, const OutOfCoreRunOptions& options, double fraction)
{
  constexpr double moment = 0.1;
  Stopwatch sinceReport;
  Message message;
  while (!ranks.poll(message))
  {
    if (sinceReport.seconds() > moment)
    {
      sinceReport.restart();
      if (options.Progress && !options.Progress(fraction))
      {
        throw RankFailure(ranks.rank(), true, "The run was stopped.");
      }
    }
    ranks.pause();
  }
  return message;
}

bool runOnRanks(
  Communicator& ranks, const std::function<bool()>& runFirst, const std::function<void()>& runOther)
{
  const auto work = [&]
  {
    if (ranks.rank() > 0)
    {
      runOther();
      return;
    }
    if (runFirst())
    {
      throw RankFailure(0, true, "The run was stopped.");
    }
    for (int to = 1; to < ranks.size(); ++to)
    {
      ranks.post(to, EndMessage, Bytes());
    }
  };
  try
  {
    ranks.together(
      [&]
      {
        try
        {
          work();
        }
        catch (const std::bad_alloc&)
        {
          throw std::runtime_error("There is not enough memory; lower the memory limit.");
        }
      });
  }
  catch (const RankFailure& failure)
  {
    if (!failure.Aborted)
    {
      throw;
    }
    return true;
  }
  return false;
}

} // namespace tipp
