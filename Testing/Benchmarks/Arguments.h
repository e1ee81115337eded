// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippBenchmarkArguments_h
#define tippBenchmarkArguments_h

#include "Triangulation/Triangulate.h"

#include <cstdint>
#include <string>
#include <vector>

namespace tipp
{
namespace benchmark
{

struct Arguments
{
  struct Input
  {
    std::string Name; ///< a point set, or the path of a .npy file
    std::size_t Count;
  };
  std::vector<Input> Inputs;
  std::vector<int> Threads{ 1, 2 };
  std::vector<std::string> Peers{ "cgal" };
  TriangulationOptions Options;
  std::uint64_t Seed = 1;
  int Repeat = 3;
  bool Phases = false;

  bool hasPeer(const std::string& name) const;
};

/// The text that --help prints.
std::string usage();
/// Throws std::invalid_argument with one sentence if an argument is not valid.
Arguments parseArguments(int argc, char** argv);

} // namespace benchmark
} // namespace tipp

#endif
