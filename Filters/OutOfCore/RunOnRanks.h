// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRunOnRanks_h
#define tippRunOnRanks_h

#include "OutOfCore/InputPasses.h"
#include "OutOfCore/OutOfCoreMessages.h"
#include "OutOfCore/OutOfCoreOptions.h"
#include "Parallel/ParallelFor.h"
#include "Points/ReadPoints.h"
#include "Ranks/Communicator.h"
#include "vtkTIPPFiltersModule.h"

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace tipp
{

/// Checks that all ranks see a folder of the first rank, by means of a temporary file. Collective.
/// Throws IOError on each rank that does not see it. Only the first rank's `folder` is used.
VTKTIPPFILTERS_EXPORT void requireSharedFolder(Communicator& ranks, const std::string& folder);

/// Waits for a message of the first rank on another rank, which reports the finished `fraction`
/// until then. Throws RankFailure if Progress stops the run.
Message waitForOrder(Communicator& ranks, const OutOfCoreRunOptions& options, double fraction);

/// Works on a rank other than the first: helps with the input, and triangulates this rank's pieces.
/// `Setup` is a RunSetup.
template <typename Setup, typename Options>
void help(Communicator& ranks, const OpenPoints& open, const Options& options)
{
  requireSharedFolder(ranks, "");
  requireSharedFolder(ranks, "");
  const int threads = threadCount(options.Threads);
  const auto progress = [&](std::int64_t)
  {
    Message none; // no message comes; poll() throws if a rank has failed
    ranks.poll(none);
    if (options.Progress && !options.Progress(0))
    {
      throw RankFailure(ranks.rank(), true, "The run was stopped.");
    }
  };
  Setup setup(options);
  std::vector<char> isDone;
  { // the message, which may be large, is freed before the pieces are triangulated
    const Message message = helpWithInput<typename Setup::PlanType>(
      ranks, open, { 0, 0, threads, progress }, [&] { return waitForOrder(ranks, options, 0); });
    if (message.Kind == EndMessage)
    {
      return; // there are no pieces to triangulate
    }
    std::string points;
    LoadArchive archive(message.Content);
    archive(points, setup.Mesh.Path, setup.Results, isDone);
    setup.load(archive, points);
  }
  setup.beginTaking();
  triangulatePieces(setup.work(), setup.memory(options), threads, options.Progress, ranks, isDone);
  while (waitForOrder(ranks, options, 1).Kind != EndMessage)
  {
    // A result of another rank, which this rank does not need.
  }
}

/// Calls runFirst() on the first rank and runOther() on the others, which end together. runFirst()
/// returns whether the user stopped the run. Returns whether that happened on any rank. Throws
/// RankFailure on all ranks if one fails.
bool runOnRanks(Communicator& ranks, const std::function<bool()>& runFirst,
  const std::function<void()>& runOther);

/// Makes a Run on the first rank, and helps it on the others. Returns the first rank's statistics.
template <typename Run, typename Setup, typename Options>
auto runWithHelp(
  Communicator& ranks, const OpenPoints& open, const std::string& path, const Options& options)
{
  decltype(std::declval<Run>().run()) statistics;
  const bool isAborted = runOnRanks(
    ranks,
    [&]
    {
      const std::unique_ptr<PointStream> points = open();
      statistics = Run(*points, path, options, ranks.size() > 1 ? &ranks : nullptr).run();
      return statistics.Aborted;
    },
    [&] { help<Setup>(ranks, open, options); });
  statistics.Aborted = isAborted;
  return statistics;
}

} // namespace tipp

#endif
