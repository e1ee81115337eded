// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRunInPieces_h
#define tippRunInPieces_h

#include "Commands/PointArguments.h"
#include "Commands/Report.h"
#include "Console/Process.h"
#include "Ranks/Communicator.h"

#include <memory>
#include <string>

namespace tipp
{

/// Runs a command out of core on the ranks of a controller, or in this process alone (null).
/// `join` completes the stream of the input's points. `report` gets the statistics and a RankUsage
/// on the first rank. Returns the exit code, which is the same on all ranks.
template <typename Statistics, typename Options, typename Join, typename ReportMade>
int runInPieces(vtkMultiProcessController* controller, const std::string& title,
  const RunArguments& arguments, const Options& options, const Join& join, const ReportMade& report)
{
  Communicator ranks(controller);
  const auto open = [&]() -> std::unique_ptr<PointStream>
  {
    if (ranks.isFirst())
    {
      checkOutputs(arguments.Output, arguments.Statistics, arguments.Scratch, arguments.Inputs);
    }
    auto points = openPointStream(arguments.Inputs, withThinningFile(arguments));
    if (ranks.isFirst())
    {
      requireInBounds(arguments.Inputs, arguments.Columns, points->readFigures());
      reportRead(points->readFigures());
      reportTables(points->reports());
    }
    return join(std::move(points));
  };
  Statistics statistics;
  const int code = runOutOfCore(ranks, title, open, arguments.Output, options, statistics);
  if (code != Success)
  {
    return code;
  }
  const RankUsage usage = gatherUsage(ranks);
  if (ranks.isFirst())
  {
    report(statistics, usage);
  }
  return Success;
}

} // namespace tipp

#endif
