// SPDX-License-Identifier: BSD-3-Clause
#include "Arguments.h"

#include "PointSets.h"

#include <algorithm>
#include <cstdio>
#include <regex>
#include <stdexcept>

namespace tipp
{
namespace benchmark
{
namespace
{

std::size_t toCount(const std::string& text)
{
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != 0 || !(value >= 1 && value <= 1e11))
  {
    throw std::invalid_argument("'" + text + "' is not a number; write 10000000 or 1e7");
  }
  return std::size_t(value);
}

std::vector<std::string> split(const std::string& text)
{
  static const std::regex comma(",");
  return { std::sregex_token_iterator(text.begin(), text.end(), comma, -1), {} };
}

std::vector<std::string> toPeers(const std::string& text)
{
  const std::vector<std::string> peers = text == "none" ? std::vector<std::string>{} : split(text);
  for (const std::string& peer : peers)
  {
    const std::vector<std::string> known = { "cgal", "kernel", "sweep", "filter", "vtk" };
    if (std::find(known.begin(), known.end(), peer) == known.end())
    {
      throw std::invalid_argument(
        "no peer is called '" + peer + "'; there are cgal, kernel, sweep, filter, vtk");
    }
  }
  return peers;
}

/// Parses NAME or NAME:COUNT, the value of --input. A COUNT of 0 means the value of --count.
Arguments::Input toInput(const std::string& text)
{
  const std::size_t colon = text.rfind(':');
  if (colon == std::string::npos)
  {
    return { text, 0 };
  }
  return { text.substr(0, colon), toCount(text.substr(colon + 1)) };
}

void setPartitions(const std::string& text, TriangulationOptions& options)
{
  char rest = 0;
  if (text != "auto" &&
    (std::sscanf(text.c_str(), "%dx%d%c", &options.Columns, &options.Rows, &rest) != 2 ||
      options.Columns < 1 || options.Rows < 1))
  {
    throw std::invalid_argument("'" + text + "' is not a grid of partitions; write auto or 8x8");
  }
}

void apply(const std::string& option, const std::string& value, Arguments& arguments)
{
  if (option == "--input")
  {
    arguments.Inputs.push_back(toInput(value));
  }
  else if (option == "--threads")
  {
    arguments.Threads.clear();
    for (const std::string& part : split(value))
    {
      arguments.Threads.push_back(int(toCount(part)));
    }
  }
  else if (option == "--repeat")
  {
    arguments.Repeat = int(toCount(value));
  }
  else if (option == "--seed")
  {
    arguments.Seed = toCount(value);
  }
  else if (option == "--peers")
  {
    arguments.Peers = toPeers(value);
  }
  else if (option == "--partitions")
  {
    setPartitions(value, arguments.Options);
  }
  else if (option == "--initial-points")
  {
    arguments.Options.InitialPointsPerPartition = int(toCount(value));
  }
  else if (option == "--schedule" && (value == "stages" || value == "dynamic"))
  {
    arguments.Options.Order = value == "stages" ? Schedule::Stages : Schedule::Dynamic;
  }
  else
  {
    throw std::invalid_argument("'" + option + " " + value + "' is not understood; see --help");
  }
}

} // namespace

bool Arguments::hasPeer(const std::string& name) const
{
  return std::find(this->Peers.begin(), this->Peers.end(), name) != this->Peers.end();
}

std::string usage()
{
  std::string text =
    "usage: benchmarkDelaunay --input NAME[:COUNT]|FILE.npy [--input ...]\n"
    "  --count N             points of an input that names no count (1000000)\n"
    "  --threads 1,2         our own runs\n"
    "  --repeat R            runs of each; the fastest counts (3)\n"
    "  --peers P,P...        cgal, kernel (one for all points), sweep (the kernel along a line),\n"
    "                        filter (vtkTIPPDelaunay2D), vtk (vtkDelaunay2D), or none (cgal)\n"
    "  --partitions CxR      or auto (auto)\n"
    "  --initial-points N    per partition (chosen)\n"
    "  --schedule S          stages or dynamic (dynamic)\n"
    "  --seed S              of the inputs made here (1)\n"
    "  --phases              our phases' seconds and stages below each line\n"
    "Columns: 'faster' and 'same' (the set of triangles) are against the first line of an input;\n"
    "'own MB' is the peak besides what was in memory before the call; 'vertices' are those of all\n"
    "workers for each point; 'boxes' are the partitions, or the sweep's strips.\n"
    "inputs:";
  for (const std::string& name : test::pointSetNames())
  {
    text += " " + name;
  }
  return text + "\n";
}

Arguments parseArguments(int argc, char** argv)
{
  Arguments arguments;
  std::size_t count = 1000000;
  for (int i = 1; i < argc; ++i)
  {
    const std::string option = argv[i];
    if (option == "--help")
    {
      return {};
    }
    if (option == "--phases")
    {
      arguments.Phases = true;
      continue;
    }
    if (i + 1 == argc)
    {
      throw std::invalid_argument("'" + option + "' lacks a value; see --help");
    }
    const std::string value = argv[++i];
    if (option == "--count")
    {
      count = toCount(value);
    }
    else
    {
      apply(option, value, arguments);
    }
  }
  for (Arguments::Input& input : arguments.Inputs)
  {
    input.Count = input.Count == 0 ? count : input.Count;
  }
  return arguments;
}

} // namespace benchmark
} // namespace tipp
