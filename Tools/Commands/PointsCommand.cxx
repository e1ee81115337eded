// SPDX-License-Identifier: BSD-3-Clause
#include "Arrays/Random.h"
#include "Commands/Commands.h"
#include "Commands/PointArguments.h"
#include "Commands/Report.h"
#include "Console/Process.h"
#include "Distributions/GeneratePoints.h"
#include "Files/Formats.h"
#include "Files/TextFile.h"
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

constexpr const char* footer = R"(Distributions:
  uniform    independent and uniform in the unit square
  clustered  100 Gaussian clusters in the unit square, standard deviations 1e-5 to 1e-2
  kuzmin     Kuzmin's disk: dense at the centre, unbounded
  lattice    integer points row by row, ceil(sqrt(N)) per row
  coast      fractal shorelines in degrees, 6 decimals, in polyline order
  circle     random points on the unit circle
  collinear  points exactly on a line, in random order

--like accepts any file of points that 'tipp delaunay' reads. The new points are random in
the triangles of its points' triangulation, all triangles being equally likely.

Example:
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
  std::string Distribution;
  std::string Like;
  std::int64_t Count = 0;
  std::uint64_t Seed = 1;
  std::string Output;
};

void runPoints(const PointsArguments& arguments)
{
  const bool isLike = !arguments.Like.empty();
  const PathState before = requireWritable(arguments.Output, "", { arguments.Like });
  writePoints(arguments.Output,
    isLike ? pointsLike(arguments.Like, arguments.Count, arguments.Seed)
           : generatePoints(
               *distributionFromName(arguments.Distribution), arguments.Count, arguments.Seed),
    before);
  fmt::print("{} {} points, seed {}, in {}\n", arguments.Count,
    isLike ? "like '" + arguments.Like + "'" : arguments.Distribution, arguments.Seed,
    arguments.Output);
}

void addOptions(CLI::App& command, PointsArguments& arguments)
{
  CLI::Option_group* const kind = command.add_option_group("kind");
  kind->add_option("--distribution", arguments.Distribution, "The distribution, see below")
    ->check(CLI::IsMember(distributionNames()));
  kind->add_option("--like", arguments.Like, "A file of points with the wanted distribution");
  kind->require_option(1);
  command.add_option("--count", arguments.Count, "Number of points")
    ->required()
    ->check(CLI::Range(std::int64_t(0), std::int64_t(1) << 40));
  addChecked(command, "--seed", arguments.Seed, checkSeed, "The seed of the random numbers");
  addOutput(command, arguments.Output, "The .npy file to write", Use::WritesPoints);
}

int run(PointsArguments& arguments)
{
  if (!isIdleRank())
  {
    runPoints(arguments);
  }
  return Success;
}

} // namespace

void addPointsCommand(CLI::App& app, int& exitCode)
{
  addCommand<PointsArguments>(app, exitCode, "points",
    "Writes points of a known distribution as an .npy file (N x 2 float64), the same on every "
    "machine",
    footer, addOptions, run);
}

} // namespace tipp
