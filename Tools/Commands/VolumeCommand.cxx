// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/Commands.h"
#include "Commands/PointArguments.h"
#include "Commands/Report.h"
#include "Commands/VisitSurface.h"
#include "Console/Process.h"
#include "Parallel/ParallelFor.h"
#include "Partitioned/PartitionedMesh.h"
#include "Predicates/Geometry.h"
#include "Sampling/CompareSurfaces.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tipp
{
namespace
{

/// The options of 'tipp volume'.
struct VolumeArguments
{
  std::string Before;
  std::string After;
  std::optional<Box2> Bounds; ///< none: everything
  int Threads = 0;
  std::string Memory = "1G"; ///< of the part of a partitioned mesh that is in memory at a time
};

SurfaceReading readingOf(const std::string& path, const VolumeArguments& arguments)
{
  return { path, { 0, 1, 2 }, *parseMemorySize(arguments.Memory), arguments.Threads };
}

/// Reads a mesh into memory. Returns nullopt after an interrupt.
std::optional<SurfacePart> readWhole(
  const std::string& path, const VolumeArguments& arguments, const Report& report)
{
  SurfaceReading reading = readingOf(path, arguments);
  reading.Memory = std::numeric_limits<std::uint64_t>::max();
  SurfacePart whole;
  const bool isDone = visitSurface(path, reading, report,
    [&whole](const SurfacePart& part, const Report& ofPart)
    {
      whole = part;
      return ofPart(1);
    });
  return isDone ? std::make_optional(std::move(whole)) : std::nullopt;
}

void print(const CutFill& result)
{
  fmt::print("cut          {}\nfill         {}\nnet          {}\narea         {}\n"
             "only before  {}\nonly after   {}\n",
    result.Cut, result.Fill, result.net(), result.Area, result.OnlyFirst, result.OnlySecond);
}

int compare(const VolumeArguments& arguments)
{
  const ThreadLimit limit(arguments.Threads);
  auto bar = std::make_unique<ProgressBar>("Comparing");
  const Report report = progressOn(bar);
  // The first surface of the comparison is in memory, the second one may be stored in parts.
  const bool isSwapped = isPartitionedMesh(arguments.Before) && !isPartitionedMesh(arguments.After);
  std::string first = arguments.Before;
  std::string second = arguments.After;
  if (isSwapped)
  {
    std::swap(first, second);
  }
  std::optional<SurfacePart> whole = readWhole(first, arguments, partOf(report, 0, 0.1));
  if (!whole)
  {
    return reportInterrupt();
  }
  SurfaceComparison comparison(
    std::move(*whole), { first, second }, arguments.Bounds, threadCount(arguments.Threads));
  if (!visitSurface(second, readingOf(second, arguments), partOf(report, 0.1, 1),
        [&comparison](const SurfacePart& part, const Report& ofPart)
        { return comparison.add(part, ofPart); }))
  {
    return reportInterrupt();
  }
  CutFill result = comparison.result();
  bar.reset();
  printWarnings(comparison.warnings(result));
  if (isSwapped)
  {
    std::swap(result.Cut, result.Fill);
    std::swap(result.OnlyFirst, result.OnlySecond);
  }
  print(result);
  return Success;
}

int run(VolumeArguments& arguments)
{
  return isIdleRank() ? Success : compare(arguments);
}

constexpr const char* footer =
  R"(BEFORE  the first surface: any VTK file of triangles or other cells with an area, whose heights
AFTER   are the z of their points; or a partitioned mesh. One of the two is in memory. The other
        one, if it is partitioned, is read in parts of about --memory.

Prints, in the units of the coordinates:
  cut          the volume of what lies below BEFORE and above AFTER
  fill         the volume of what lies above BEFORE and below AFTER
  net          fill minus cut
  area         the area, in the plane of x and y, that both surfaces cover
  only before  the area that only BEFORE covers, where no volume is computed
  only after   the area that only AFTER covers

The triangles of both surfaces are overlaid exactly, and the volumes are exact integrals up to
rounding. Numbers are printed with all their digits.

Examples:
  tipp volume before.vtu after.vtu
  tipp volume before.tipp after.tipp --bounds 2600 2700 1100 1200
)";

void addOptions(CLI::App& command, VolumeArguments& arguments)
{
  command.add_option("before", arguments.Before, "The surface before")->required();
  command.add_option("after", arguments.After, "The surface after")->required();
  command
    .add_option_function<std::vector<double>>(
      "--bounds",
      [&arguments](const std::vector<double>& bounds)
      {
        const Box2 box = boxOfVtkBounds<2>(bounds.data());
        refuseIf(!(box.Min.x < box.Max.x && box.Min.y < box.Max.y), "--bounds",
          "has no area; give xmin xmax ymin ymax");
        arguments.Bounds = box;
      },
      "Compare only this range, in the units of the coordinates: xmin xmax ymin ymax")
    ->expected(4);
  addThreadsOption(command, arguments.Threads);
  addChecked(command, "--memory", arguments.Memory, checkMemorySize,
    "The memory limit for the part of a partitioned mesh that is in memory");
}

} // namespace

void addVolumeCommand(CLI::App& app, int& exitCode)
{
  addCommand<VolumeArguments>(app, exitCode, "volume",
    "Computes the cut and fill volumes between two surfaces, exactly", footer, addOptions, run);
}

} // namespace tipp
