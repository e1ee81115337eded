// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/Commands.h"

#include "Adcirc/AdcircGrid.h"
#include "Console/Process.h"
#include "Files/OutputPath.h"
#include "Files/PendingOutput.h"
#include "Flat/FlatMesh.h"
#include "Flat/FlattenDataSet.h"
#include "Vtk/ReadDataSet.h"

#include "vtkDataSet.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <memory>
#include <vector>

namespace tipp
{
namespace
{

constexpr const char* footer =
  R"(INPUT   any VTK file, which is read into memory, or an ADCIRC grid (.14, .grd).
FOLDER  cells.npy, points.npy, point_data/NAME.npy, cell_data/NAME.npy and, for
        values that vary in time, time.npy. It must not exist yet.

Other cells are cut into triangles or tetrahedra. Cells of a lower dimension, ghost
cells and arrays of strings are left out. The command reports the cells that it has cut
or left out. A .vtu file with appended, raw, uncompressed triangles or tetrahedra need
not be flattened: other commands read it in place.

Examples:
  tipp flatten bracket.vtu -o bracket
  tipp flatten fort.14 -o surge --values fort.63 --values maxele.63
)";

struct FlattenArguments
{
  std::string Input;
  std::string Output;
  std::vector<std::string> Values;
};

void reportCut(const FlattenArguments& arguments, const Flattened& flattened)
{
  for (const auto& [name, count] : flattened.Cut)
  {
    fmt::print("{} cells {} were cut.\n", count, name);
  }
  for (const auto& [name, count] : flattened.LeftOut)
  {
    fmt::print(stderr, "tipp: warning: {}: {} of {} left out.\n", arguments.Input, count, name);
  }
  for (const std::string& name : flattened.ArraysLeftOut)
  {
    fmt::print(stderr, "tipp: warning: {}: array '{}' holds no numbers and is left out.\n",
      arguments.Input, name);
  }
}

bool writeContent(const FlattenArguments& arguments, const FlatContent& content)
{
  if (!writeFlatMesh(arguments.Output, content, isInterrupted))
  {
    reportInterrupt();
    return false;
  }
  fmt::print("{} {}, {} points, {} arrays{} in {}\n",
    content.Cells.size() / std::size_t(content.CellSize),
    content.CellSize == 3 ? "triangles" : "tetrahedra", content.Points.Tuples,
    content.PointData.size() + content.CellData.size(),
    content.Times.empty() ? "" : fmt::format(", {} steps", content.Times.size()), arguments.Output);
  return true;
}

int runFlatten(const FlattenArguments& arguments)
{
  {
    // Check the paths before the computation.
    std::vector<std::string> inputs = arguments.Values;
    inputs.push_back(arguments.Input);
    requireApart({ arguments.Output }, inputs);
    const PendingFolder writable(arguments.Output);
  }
  if (isAdcircFile(arguments.Input))
  {
    const FlatContent content = flattenAdcirc(arguments.Input, arguments.Values);
    return writeContent(arguments, content) ? Success : interruptedExitCode;
  }
  const vtkSmartPointer<vtkDataSet> data = readDataSet(arguments.Input);
  const Flattened flattened = flattenDataSet(data, arguments.Input);
  if (!writeContent(arguments, flattened.Content))
  {
    return interruptedExitCode;
  }
  reportCut(arguments, flattened);
  return Success;
}

} // namespace

void addFlattenCommand(CLI::App& app, int& exitCode)
{
  auto arguments = std::make_shared<FlattenArguments>();
  CLI::App* const command = app.add_subcommand("flatten",
    "Writes the triangles or tetrahedra of a mesh as a folder of .npy arrays, in their order");
  command->add_option("input", arguments->Input, "The mesh")->required();
  command->add_option("-o,--output", arguments->Output, "The folder to write")->required();
  command->add_option("--values", arguments->Values,
    "With an ADCIRC grid: ASCII output at its nodes (fort.63, maxele.63 ...)");
  command->footer(footer);
  command->callback(
    [arguments, &exitCode]()
    {
      if (!arguments->Values.empty() && !isAdcircFile(arguments->Input))
      {
        throw CLI::ValidationError("--values needs an ADCIRC grid (.14, .grd)");
      }
      exitCode = isIdleRank() ? Success : runFlatten(*arguments);
    });
}

} // namespace tipp
