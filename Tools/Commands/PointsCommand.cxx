// SPDX-License-Identifier: BSD-3-Clause
#include "Arrays/Random.h"
#include "Commands/Commands.h"
#include "Commands/PointArguments.h"
#include "Commands/Report.h"
#include "Console/Process.h"
#include "Distributions/GeneratePoints.h"
#include "Files/Formats.h"
#include "Files/IOError.h"
#include "Files/TextFile.h"
#include "Las/WriteLas.h"
#include "Npy/NpyFile.h"
#include "Points/ReadPoints.h"
#include "Triangulation/Triangulate.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <memory>
#include <stdexcept>

namespace tipp
{
namespace
{

/// Returns `count` points, x and y of each, with about the same distribution as those of a file.
/// Each is uniform in a triangle of the file's Delaunay triangulation, and all triangles are
/// equally likely, so dense areas stay dense. The dissertation's chapter 3.3.3 enlarges its
/// storm-surge meshes in this way. Throws IOError, and std::runtime_error if the file's points have
/// no triangles.
std::vector<double> pointsLike(const std::string& path, std::int64_t count, std::uint64_t seed)
{
  const PointTable table = readPoints(path);
  TriangulationOptions options;
  // With several threads, the order of the triangles, and so the points, could depend on the
  // machine.
  options.Threads = 1;
  const Triangulation mesh = triangulate(PointsView(table.XY.data(), table.size(), 2), options);
  const std::int64_t triangles = std::int64_t(mesh.triangleCount());
  if (triangles == 0)
  {
    throw std::runtime_error(
      "'" + path + "': its points have no triangles, because all lie on one line.");
  }
  const auto corner = [&](std::int64_t triangle, std::int64_t i)
  {
    const std::size_t at = std::size_t(3 * triangle + i);
    return 2 * std::size_t(mesh.Ids64.empty() ? mesh.Ids32[at] : mesh.Ids64[at]);
  };
  Random random(seed);
  std::vector<double> xy;
  xy.reserve(2 * std::size_t(count));
  for (std::int64_t n = 0; n < count; ++n)
  {
    const std::int64_t triangle = random.index(triangles);
    double u = random.uniform();
    double v = random.uniform();
    if (u + v > 1)
    {
      u = 1 - u;
      v = 1 - v;
    }
    const double* a = &table.XY[corner(triangle, 0)];
    const double* b = &table.XY[corner(triangle, 1)];
    const double* c = &table.XY[corner(triangle, 2)];
    for (int k = 0; k < 2; ++k)
    {
      xy.push_back(a[k] + u * (b[k] - a[k]) + v * (c[k] - a[k]));
    }
  }
  return xy;
}

constexpr const char* footer =
  R"(INPUT   one or more files of points, as for 'tipp delaunay'. The options of reading choose
        points, which are copied in their order.
OUTPUT  .las, .laz: version 1.4, format 6, 7 (with colour) or 8 (with infrared). All fields and
        extra bytes of LAS files stay; columns of other files become extra bytes, unless they are
        called as a field and fit. .npy: x, y and z, if there are heights, as float64.

Distributions:
  uniform    independent and uniform in the unit square
  clustered  100 Gaussian clusters in the unit square, standard deviations 1e-5 to 1e-2
  kuzmin     Kuzmin's disk: dense at the centre, unbounded
  lattice    integer points row by row, ceil(sqrt(N)) per row
  coast      fractal shorelines in degrees, 6 decimals, in polyline order
  circle     random points on the unit circle
  collinear  points exactly on a line, in random order

--like accepts any file of points that 'tipp delaunay' reads. The new points are random in
the triangles of its points' triangulation, all triangles being equally likely.

Examples:
  tipp points tiles/*.laz -o ground.laz --class 2 --thin 0.5:min
  tipp points survey.csv -o survey.las --crs EPSG:25832
  tipp points --distribution coast --count 1000000 --seed 7 -o coast.npy
  tipp points --like fort.14 --count 1000000 -o dense.npy
)";

/// Validates the seed: returns an error message, or an empty text. CLI11's message would name the
/// largest double.
std::string checkSeed(const std::string& text)
{
  return wholeNumber<std::uint64_t>(text)
    ? ""
    : "'" + text + "' is not a whole number from 0 to 18446744073709551615";
}

struct PointsArguments
{
  const CLI::App* Command = nullptr;
  std::vector<std::string> Inputs;
  PointOptions Columns;
  std::vector<std::string> ReadingOptions; ///< the names of those that fill Columns
  std::string Distribution;
  std::string Like;
  std::int64_t Count = 0;
  std::uint64_t Seed = 1;
  std::vector<double> Scale;
  int Threads = 0;
  std::string Output;

  bool makesLas() const { return openerOf(this->Output, Use::WritesPoints) == Opener::Las; }
  LasOptions lasOptions(const PathState& before) const
  {
    return { "TIPP " TIPP_VERSION, this->Scale, this->Threads, before };
  }
};

std::string describe(const LasReport& report)
{
  const auto& scale = report.Transform.Scale;
  return fmt::format("format {}, scales {} {} {}", report.Format, scale[0], scale[1], scale[2]);
}

void warn(const LasReport& report)
{
  printWarnings(report.Warnings);
  if (report.NotFinite > 0)
  {
    fmt::print(stderr, "tipp: warning: {} left out, since x, y or z is not a number.\n",
      report.NotFinite == 1 ? "1 point is" : fmt::format("{} points are", report.NotFinite));
  }
}

/// Writes points of a known distribution.
void makePoints(const PointsArguments& arguments)
{
  const bool isLike = !arguments.Like.empty();
  const PathState before = requireWritable(arguments.Output, "", { arguments.Like });
  PointTable table;
  table.XY = isLike ? pointsLike(arguments.Like, arguments.Count, arguments.Seed)
                    : generatePoints(*distributionFromName(arguments.Distribution), arguments.Count,
                        arguments.Seed);
  std::string more;
  if (arguments.makesLas())
  {
    const LasReport report =
      writeLas(*streamTable(std::move(table)), arguments.Output, arguments.lasOptions(before));
    warn(report);
    more = ", " + describe(report);
  }
  else
  {
    writePoints(arguments.Output, table.XY, before);
  }
  fmt::print("{} {} points, seed {}{}, in {}\n", arguments.Count,
    isLike ? "like '" + arguments.Like + "'" : arguments.Distribution, arguments.Seed, more,
    arguments.Output);
}

/// Returns the names of the columns that an .npy file of points does not have.
std::string columnsBesides(std::size_t height, const std::vector<std::string>& columns)
{
  std::string names;
  for (std::size_t i = 0; i < columns.size(); ++i)
  {
    names += i == height ? "" : (names.empty() ? "" : ", ") + shownText(columns[i]);
  }
  return names;
}

/// Copies x, y and, if there are heights, z.
void copyToNpy(const PointsArguments& arguments, const PathState& before)
{
  constexpr std::size_t blockPoints = std::size_t(1) << 16;
  PointOptions options = arguments.Columns;
  options.Threads = arguments.Threads;
  const std::unique_ptr<PointStream> points = openPointStream(arguments.Inputs, options);
  reportTables(points->reports());
  const std::vector<std::string> columns = points->columns();
  const std::size_t height = findElevation(columns);
  const std::size_t width = height < columns.size() ? 3 : 2;
  std::int64_t count = 0; // the header is written first
  forEachBlock(
    *points, blockPoints, [&](const PointBlock& block) { count += std::int64_t(block.size()); });
  requireInBounds(arguments.Inputs, options, count, points->readFigures());
  if (count == 0)
  {
    throw IOError(arguments.Output,
      "is not written, since there are no points to write; compare the options that choose points "
      "with what 'tipp info' prints.");
  }
  NpyWriter writer(arguments.Output, "<f8", { count, std::int64_t(width) }, before);
  std::vector<double> rows;
  forEachBlock(*points, blockPoints,
    [&](const PointBlock& block)
    {
      rows.clear();
      for (std::size_t i = 0; i < block.size(); ++i)
      {
        rows.insert(rows.end(), { block.XY[2 * i], block.XY[2 * i + 1] });
        if (width == 3)
        {
          rows.push_back(block.Columns[height][i]);
        }
      }
      writer.write(rows.data(), rows.size() * sizeof(double));
    });
  writer.close();
  reportRead(points->readFigures());
  reportLeftOut(points->leftOut(), points->thinnedOut());
  const std::string besides = columnsBesides(height, columns);
  if (!besides.empty())
  {
    fmt::print(
      stderr, "tipp: warning: {} has no room for these columns: {}.\n", arguments.Output, besides);
  }
  fmt::print("{} points in {}\n", count, arguments.Output);
}

void copyPoints(const PointsArguments& arguments)
{
  const PathState before = requireWritable(arguments.Output, "", arguments.Inputs);
  if (!arguments.makesLas())
  {
    copyToNpy(arguments, before);
    return;
  }
  const LasReport report =
    copyToLas(arguments.Inputs, arguments.Columns, arguments.Output, arguments.lasOptions(before));
  reportTables(report.Tables);
  reportRead(report.Read);
  reportLeftOut(report.LeftOut, report.ThinnedOut);
  warn(report);
  fmt::print("{} points, {}, in {}\n", report.Points, describe(report), arguments.Output);
}

void addOptions(CLI::App& command, PointsArguments& arguments)
{
  arguments.Command = &command;
  command.add_option("input", arguments.Inputs, "The points to copy, of one or more files");
  addOutput(command, arguments.Output, "The file to write", Use::WritesPoints);
  command.add_option("--distribution", arguments.Distribution, "The distribution, see below")
    ->check(CLI::IsMember(distributionNames()));
  command.add_option("--like", arguments.Like, "A file of points with the wanted distribution");
  command.add_option("--count", arguments.Count, "Number of points to make")
    ->check(CLI::Range(std::int64_t(0), std::int64_t(1) << 40));
  addChecked(command, "--seed", arguments.Seed, checkSeed, "The seed of the random numbers");
  command
    .add_option("--scale", arguments.Scale,
      "Round the coordinates of a .las or .laz file to multiples of this, or of three numbers "
      "for x, y and z, such as 1e-7,1e-7,0.01 (default: that of LAS inputs, else the decimals)")
    ->delimiter(',')
    ->allow_extra_args(false)
    ->check(checkPositive);
  const std::size_t before = command.get_options().size();
  addPointOptions(command, arguments.Columns);
  addBoundsOption(command, arguments.Columns);
  const std::vector<CLI::Option*> options = command.get_options();
  for (std::size_t i = before; i < options.size(); ++i)
  {
    arguments.ReadingOptions.push_back(options[i]->get_name());
  }
  addThreadsOption(command, arguments.Threads);
}

/// Throws CLI::ValidationError for options that are missing or would have no effect.
void requireUseful(const PointsArguments& arguments)
{
  const CLI::App& command = *arguments.Command;
  const bool copies = !arguments.Inputs.empty();
  const int kinds =
    int(copies) + int(!arguments.Distribution.empty()) + int(!arguments.Like.empty());
  refuseIf(kinds != 1, "INPUT",
    kinds == 0 ? "is required: files of points, --distribution or --like"
               : "cannot be combined: give files of points, --distribution or --like");
  refuseIf(!copies && command.count("--count") == 0, "--count",
    "is required with --distribution and --like");
  for (const char* const name : { "--count", "--seed" })
  {
    refuseIf(copies && command.count(name) > 0, name, "needs --distribution or --like");
  }
  for (const std::string& name : arguments.ReadingOptions)
  {
    refuseIf(!copies && command.count(name) > 0, name, "needs files of points");
  }
  refuseIf(!copies && !arguments.makesLas() && command.count("--threads") > 0, "--threads",
    "needs files of points, or an output named .las or .laz");
  refuseIf(!arguments.Scale.empty() && !arguments.makesLas(), "--scale",
    "needs an output named .las or .laz");
  refuseIf(arguments.Scale.size() == 2 || arguments.Scale.size() > 3, "--scale",
    "is one number, or three for x, y and z");
}

int run(PointsArguments& arguments)
{
  requireUseful(arguments);
  if (!isIdleRank())
  {
    arguments.Inputs.empty() ? makePoints(arguments) : copyPoints(arguments);
  }
  return Success;
}

} // namespace

void addPointsCommand(CLI::App& app, int& exitCode)
{
  addCommand<PointsArguments>(app, exitCode, "points",
    "Copies points, chosen and thinned, to a LAS, LAZ or .npy file; or makes points of a known "
    "distribution, the same on every machine",
    footer, addOptions, run);
}

} // namespace tipp
