// SPDX-License-Identifier: BSD-3-Clause
// Compares input and output with their peers. Each subject has its own file.
#include "IoSubjects.h"

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <sstream>
#include <stdexcept>

namespace
{

using namespace tipp::benchmark;

int toCount(const std::string& text)
{
  char* end = nullptr;
  const long value = std::strtol(text.c_str(), &end, 10);
  if (text.empty() || *end != 0 || value < 1 || value > 1000000000)
  {
    throw std::invalid_argument("'" + text + "' is not a number from 1 to 1e9");
  }
  return int(value);
}

std::vector<std::int64_t> toCounts(const std::string& text)
{
  std::vector<std::int64_t> counts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, ',');)
  {
    counts.push_back(toCount(part));
  }
  return counts;
}

IoArguments parse(int argc, char** argv)
{
  IoArguments arguments;
  for (int i = 2; i < argc; ++i)
  {
    const std::string word = argv[i];
    if (word.rfind("--", 0) != 0)
    {
      arguments.Meshes.push_back(word);
    }
    else if (i + 1 < argc && (word == "--repeat" || word == "--threads"))
    {
      (word == "--repeat" ? arguments.Repeat : arguments.Threads) = toCount(argv[++i]);
    }
    else if (i + 1 < argc && (word == "--parts" || word == "--chunks"))
    {
      (word == "--parts" ? arguments.Parts : arguments.Chunks) = toCounts(argv[++i]);
    }
    else
    {
      throw std::invalid_argument("'" + word + "' is not understood");
    }
  }
  return arguments;
}

} // namespace

int main(int argc, char** argv)
{
  try
  {
    const std::string subject = argc > 1 ? argv[1] : "";
    const IoArguments arguments = parse(argc, argv);
    if (subject == "loaders" && arguments.Meshes.size() == 2)
    {
      benchmarkLoaders(arguments);
      return 0;
    }
    if (subject == "classify" && arguments.Meshes.size() == 1)
    {
      benchmarkClassify(arguments);
      return 0;
    }
    if (subject == "reading" && arguments.Meshes.size() == 2)
    {
      benchmarkReading(arguments);
      return 0;
    }
    if (subject == "borrowing" && arguments.Meshes.size() == 2)
    {
      benchmarkBorrowing(arguments);
      return 0;
    }
    if (subject == "points" && !arguments.Meshes.empty())
    {
      benchmarkPoints(arguments);
      return 0;
    }
    if (subject == "laz" && !arguments.Meshes.empty())
    {
      benchmarkLaz(arguments);
      return 0;
    }
    std::fputs(
      "usage: benchmarkIo loaders [--repeat R] [--threads T] [--parts P,P...] [--chunks C,C...] "
      "RANDOM-MESH LOCAL-MESH\n"
      "       benchmarkIo classify [--repeat R] [--threads T] MESH\n"
      "       benchmarkIo reading [--repeat R] [--threads T] ONE.vtu PARTITIONED-MESH\n"
      "       benchmarkIo borrowing [--repeat R] LENT-MESH COPIED-MESH\n"
      "       benchmarkIo points [--repeat R] [--threads T] FILE...\n"
      "       benchmarkIo laz [--repeat R] [--threads T] FILE.laz...\n"
      "M is the number of vertices over P; chunks are in cells.\n",
      stderr);
    return 2;
  }
  catch (const std::exception& error)
  {
    std::fprintf(stderr, "benchmarkIo: %s\n", error.what());
    return 1;
  }
}
