// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/Commands.h"
#include "Commands/PointArguments.h"
#include "Commands/Report.h"
#include "Commands/VisitSurface.h"
#include "Console/Process.h"
#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Files/PendingOutput.h"
#include "Parallel/ParallelFor.h"
#include "Parallel/Stopwatch.h"
#include "Ranks/Communicator.h"
#include "Sampling/RemapSurface.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

namespace tipp
{
namespace
{

/// The options of 'tipp remap'.
struct RemapArguments
{
  std::string Source;
  std::string Target;
  std::string Output;
  std::vector<std::string> Arrays; ///< empty: all
  double Null = std::nan("");
  int Threads = 0;
  std::string Memory = "1G"; ///< of the part of a partitioned source that is in memory at a time
};

/// Averages on all ranks, and writes the file on the first one. Collective.
void remap(const RemapArguments& arguments, Communicator& ranks)
{
  const Stopwatch watch;
  PathState before;
  if (ranks.isFirst())
  {
    before = requireWritable(arguments.Output, "", { arguments.Source, arguments.Target });
  }
  const ThreadLimit limit(arguments.Threads);
  const auto bar = ranks.isFirst() ? std::make_unique<ProgressBar>("Remapping") : nullptr;
  const Report report = progressOn(bar);
  const SurfaceReading reading{ "The source mesh", { 0, 1 }, *parseMemorySize(arguments.Memory),
    arguments.Threads };
  const TargetSurface target =
    readTarget(arguments.Target, { "The target mesh", { 0, 1 }, reading.Memory, arguments.Threads },
      [&arguments](const std::string& extension)
      {
        if (extensionOf(arguments.Output) != extension)
        {
          throw IOError(arguments.Output,
            "would have the cells of " + arguments.Target + ": name it " + extension + ".");
        }
      });
  SurfaceRemapper remapper(target.Surface, arguments.Arrays, threadCount(arguments.Threads));
  remapper.share(ranks);
  if (!visitSurface(arguments.Source, reading, report,
        [&remapper](const SurfacePart& part, const Report& ofPart)
        { return remapper.add(part, ofPart); }))
  {
    throw RankFailure(ranks.rank(), true, "The run was stopped.");
  }
  remapper.gather(ranks);
  if (!ranks.isFirst())
  {
    return;
  }
  target.Write(arguments.Output, before, remapper.finish(arguments.Null));
  fmt::print("{} cells, {} of them covered, {:.3f} s\n", target.Surface.Cells, remapper.covered(),
    watch.seconds());
  if (remapper.coveredTwice() > 0)
  {
    fmt::print(stderr,
      "tipp: warning: {}: cells overlap: {} cells of the result are covered more than once, and "
      "each cell counts.\n",
      arguments.Source, remapper.coveredTwice());
  }
}

int run(RemapArguments& arguments)
{
  const MpiSession session;
  return runTogether(
    session.controller(), [&arguments](Communicator& ranks) { remap(arguments, ranks); });
}

constexpr const char* footer =
  R"(SOURCE  any VTK file of triangles or other cells with an area; or a partitioned mesh, which
        may be larger than memory: it is read in parts of about --memory
TARGET  a VTK file of such cells, whose cells the result has
OUTPUT  .vtp for a TARGET of polygons, .vtu for one of cells of any type: as cell data the
        exact means of SOURCE's arrays over the part of each cell that SOURCE covers, and
        CoveredShare, the share of the cell that is covered, from 0 to 1

Cells are in the plane of x and y. Values at points are linear in each triangle. Sums of
mean times covered area are SOURCE's integral over TARGET. Where cells of SOURCE overlap,
each counts, and a warning says so. Under mpirun the ranks share TARGET's cells.

Examples:
  tipp remap fine.vtu --to coarse.vtu -o means.vtu
  tipp remap fine.tipp --to zones.vtp -o rain.vtp --arrays rain --memory 512M
)";

void addOptions(CLI::App& command, RemapArguments& arguments)
{
  command.add_option("source", arguments.Source, "The mesh with the values")->required();
  command.add_option("--to", arguments.Target, "The mesh whose cells the values are averaged over")
    ->required();
  command.add_option("-o,--output", arguments.Output, "The result, .vtp or .vtu")->required();
  command.add_option("--arrays", arguments.Arrays, "Names of arrays (default: all)");
  command.add_option(
    "--null", arguments.Null, "The mean in cells that are not covered (default: NaN)");
  addThreadsOption(command, arguments.Threads);
  addChecked(command, "--memory", arguments.Memory, checkMemorySize,
    "The memory limit for the part of a partitioned source that is in memory");
}

} // namespace

void addRemapCommand(CLI::App& app, int& exitCode)
{
  addCommand<RemapArguments>(app, exitCode, "remap",
    "Averages the values of a mesh over the cells of another one, exactly", footer, addOptions,
    run);
}

} // namespace tipp
