// SPDX-License-Identifier: BSD-3-Clause
#include "Adcirc/AdcircValues.h"

#include "Files/IOError.h"
#include "Files/TextFile.h"

#include <utility>

namespace tipp
{
namespace
{

class ValuesReader
{
public:
  ValuesReader(const std::string& path, const std::string& text)
    : Path(path)
    , Lines(text)
  {
  }

  AdcircValues read()
  {
    std::string_view title;
    this->Lines.next(title);
    this->readRow(5, "the numbers of steps, nodes and values");
    const std::int64_t steps = this->integer(0);
    this->Result.Nodes = this->integer(1);
    const std::int64_t components = this->integer(4);
    const std::int64_t lines = this->Lines.remainingLines();
    // A step has one line at least; how many nodes it gives is seen there.
    if (steps < 1 || steps > lines || this->Result.Nodes < 1 || this->Result.Nodes > lines ||
      components < 1 || components > 3)
    {
      this->fail("announces " + std::to_string(steps) + " steps of " +
        std::to_string(this->Result.Nodes) + " nodes with " + std::to_string(components) +
        " values, but " + std::to_string(lines) + " lines follow; copy the file again.");
    }
    this->Result.Components = int(components);
    for (std::int64_t step = 0; step < steps; ++step)
    {
      this->readStep();
    }
    return std::move(this->Result);
  }

private:
  [[noreturn]] void fail(const std::string& problem) const
  {
    throw IOError(this->Path, this->Lines.lineNumber(), problem);
  }

  void readRow(std::size_t fields, const char* what)
  {
    std::string_view line;
    if (!this->Lines.next(line))
    {
      this->fail(std::string("the file ends before ") + what + "; copy it again.");
    }
    splitFields(line, ' ', this->Row);
    if (this->Row.size() < fields)
    {
      this->fail(std::string("has too few numbers for ") + what +
        "; check that it is ADCIRC's output in ASCII.");
    }
  }

  std::int64_t integer(std::size_t field) const
  {
    std::int64_t value = 0;
    if (!parseInteger(this->Row[field], value))
    {
      this->fail("'" + std::string(this->Row[field]) + "' is not an integer; correct the line.");
    }
    return value;
  }

  double number(std::size_t field) const
  {
    double value = 0;
    if (!parseNumber(this->Row[field], value))
    {
      this->fail("'" + std::string(this->Row[field]) + "' is not a number; correct the line.");
    }
    return value;
  }

  void readStep()
  {
    this->readRow(2, "a step");
    this->Result.Times.push_back(this->number(0));
    const bool sparse = this->Row.size() >= 4;
    const std::int64_t given = sparse ? this->integer(2) : this->Result.Nodes;
    if (given < 0 || given > this->Result.Nodes || given > this->Lines.remainingLines())
    {
      this->fail("announces " + std::to_string(given) + " nodes, but " +
        std::to_string(this->Lines.remainingLines()) + " lines follow; copy the file again.");
    }
    const auto components = std::size_t(this->Result.Components);
    const std::size_t first = this->Result.Values.size();
    const double rest = sparse ? this->number(3) : 0;
    this->Result.Values.resize(first + std::size_t(this->Result.Nodes) * components, rest);
    for (std::int64_t i = 0; i < given; ++i)
    {
      this->readRow(1 + components, "a node's values");
      const std::int64_t node = this->integer(0);
      if (node < 1 || node > this->Result.Nodes)
      {
        this->fail("names node " + std::to_string(node) + " of " +
          std::to_string(this->Result.Nodes) + ", counted from 1.");
      }
      for (std::size_t c = 0; c < components; ++c)
      {
        this->Result.Values[first + std::size_t(node - 1) * components + c] = this->number(1 + c);
      }
    }
  }

  const std::string& Path;
  LineReader Lines;
  std::vector<std::string_view> Row;
  AdcircValues Result;
};

} // namespace

AdcircValues readAdcircValues(const std::string& path)
{
  const std::string text = readTextFile(path);
  return ValuesReader(path, text).read();
}

} // namespace tipp
