// SPDX-License-Identifier: BSD-3-Clause
// Changes bytes of LAZ files of all point formats, and of a COPC file, and reads them or a region
// of them with one thread and with two. Both must give the same points, or the same IOError. A seed
// and a number identify a case: 'fuzzLaz --seed S --case N' repeats it.
#include "CopcText.h"
#include "Files/IOError.h"
#include "FuzzDriver.h"
#include "LazText.h"
#include "Mutate.h"
#include "Points/ReadPoints.h"
#include "ScratchFile.h"

#include <cstdio>
#include <cstring>
#include <random>
#include <string>
#include <vector>

namespace
{

using namespace tipp;
using Engine = std::mt19937_64;

/// The points that were read, as bytes because some are not numbers, and the error that ended it.
struct Outcome
{
  std::string Points;
  std::string Error;

  bool operator==(const Outcome& other) const
  {
    return this->Points == other.Points && this->Error == other.Error;
  }
};

void append(const std::vector<double>& values, std::string& bytes)
{
  if (!values.empty())
  {
    bytes.append(reinterpret_cast<const char*>(values.data()), 8 * values.size());
  }
}

Outcome outcomeOf(const std::string& path, PointOptions options, int threads)
{
  options.Threads = threads;
  Outcome outcome;
  try
  {
    const auto stream = openPointStream({ path }, options);
    stream->rewind();
    for (PointBlock block; stream->next(block, 16);)
    {
      append(block.XY, outcome.Points);
      for (const std::vector<double>& column : block.Columns)
      {
        append(column, outcome.Points);
      }
    }
  }
  catch (const IOError& error)
  {
    outcome.Error = error.what();
    outcome.Points.clear(); // how many were read before the damage depends on the threads
  }
  return outcome;
}

PointOptions drawOptions(Engine& random)
{
  PointOptions options;
  const unsigned bits = unsigned(random());
  options.Las.KeepOverlap = options.Las.KeepSynthetic = options.Las.KeepWithheld = (bits & 1U) != 0;
  options.Las.KeepTruncated = (bits & 2U) != 0;
  options.Las.KeepUncounted = (bits & 4U) != 0;
  if (bits & 8U)
  {
    options.Columns = { "z" };
  }
  if (bits & 16U)
  {
    options.Las.Classes = { int(random() % 32) };
  }
  if ((bits & 96U) == 96U)
  {
    const double west = double(random() % 8000);
    options.Region = Box2{ { west, 100 }, { west + 3000, 5000 } };
  }
  if ((bits & 896U) == 896U)
  {
    options.Spacing = double(random() % 100);
  }
  return options;
}

/// Changes the header and its records, or the compressed points.
std::string damage(const test::LasAndLaz& file, Engine& random)
{
  if (random() % 2 == 0)
  {
    return test::mutate(file.Compressed, file.PointOffset + 8, random);
  }
  std::string bytes = file.Compressed;
  for (std::uint64_t i = random() % 4 + 1; i > 0; --i)
  {
    bytes[file.PointOffset + random() % (bytes.size() - file.PointOffset)] = char(random());
  }
  if (random() % 8 == 0)
  {
    bytes.resize(file.PointOffset + random() % (bytes.size() - file.PointOffset));
  }
  return bytes;
}

std::vector<test::LasAndLaz> makeFiles()
{
  std::vector<test::LasAndLaz> files;
  for (const test::LazInput& input : test::lazInputs)
  {
    files.push_back(test::filesOf(input));
  }
  test::CopcText copc;
  Engine random(52);
  for (int i = 0; i < 40; ++i)
  {
    const auto draw = [&] { return std::int32_t(random() % test::CopcText::Side); };
    copc.add(draw(), draw(), draw());
  }
  const std::string text = copc.text();
  files.push_back({ "", text, test::CopcText::Info + 160 });
  return files;
}

std::int64_t cases = 0;
std::int64_t refused = 0;

bool passes(std::uint64_t seed, std::uint64_t number)
{
  static const test::ScratchFile scratch("points.laz");
  static const std::vector<test::LasAndLaz> files = makeFiles();
  Engine random(seed * 1000003 + number);
  const std::string path = scratch.write(damage(files[random() % files.size()], random));
  const PointOptions options = drawOptions(random);
  const Outcome one = outcomeOf(path, options, 1);
  ++cases;
  refused += one.Error.empty() ? 0 : 1;
  // Starting two threads takes longer than all the rest.
  if (number % 8 != 0)
  {
    return true;
  }
  const Outcome two = outcomeOf(path, options, 2);
  if (!(one == two))
  {
    std::printf("case %llu of seed %llu: one thread: %zu bytes of points, '%s'; two: %zu, '%s'\n",
      static_cast<unsigned long long>(number), static_cast<unsigned long long>(seed),
      one.Points.size(), one.Error.c_str(), two.Points.size(), two.Error.c_str());
  }
  return one == two;
}

} // namespace

int main(int argc, char** argv)
{
  const int result = tipp::test::fuzz("fuzzLaz", argc, argv, passes);
  std::printf("%lld of %lld files were refused\n", static_cast<long long>(refused),
    static_cast<long long>(cases));
  return result;
}
