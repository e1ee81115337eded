// SPDX-License-Identifier: BSD-3-Clause
#include "Adcirc/AdcircValues.h"

#include "Adcirc/ListDirectedRows.h"
#include "Files/IOError.h"

#include <utility>

namespace tipp
{

namespace
{

/// Reads a file of AdcircValues. The constructor and read() throw IOError if the file cannot be
/// read or its values belong to another grid.
class ValuesReader
{
public:
  ValuesReader(const std::string& path, const AdcircGrid& grid)
    : Grid(grid)
    , Rows(path, "ADCIRC's output in ASCII")
  {
  }

  AdcircValues read()
  {
    this->Rows.title();
    this->Rows.next(5, "the numbers of steps, nodes and values");
    const std::int64_t steps = this->Rows.integer(0);
    this->Nodes = this->Rows.integer(1);
    const std::int64_t components = this->Rows.integer(4);
    const std::int64_t lines = this->Rows.remainingLines();
    // A step has at least one line; the number of its nodes is checked when it is read.
    if (steps < 1 || steps > lines || this->Nodes < 1 || components < 1 || components > 3)
    {
      this->Rows.fail("announces " + std::to_string(steps) + " steps of " +
        std::to_string(this->Nodes) + " nodes with " + std::to_string(components) +
        " values, but " + std::to_string(lines) + " lines follow; copy the file again.");
    }
    if (std::size_t(this->Nodes) != this->Grid.Depth.size())
    {
      this->Rows.fail("gives values at " + std::to_string(this->Nodes) +
        " nodes, but the grid has " + std::to_string(this->Grid.Depth.size()) +
        "; name the grid that it belongs to.");
    }
    this->Result.Components = int(components);
    this->LastStep.assign(std::size_t(this->Nodes), -1);
    for (std::int64_t step = 0; step < steps && !this->Result.IsCutOff; ++step)
    {
      this->readStepOrEnd(step);
    }
    return std::move(this->Result);
  }

private:
  /// Reads a step, unless the file ends in it and there are steps before.
  void readStepOrEnd(std::int64_t step)
  {
    const std::size_t values = this->Result.Values.size();
    const std::size_t times = this->Result.Times.size();
    try
    {
      this->readStep(step);
      this->Result.IsCutOff = step > 0 && this->Rows.endsInLine();
    }
    catch (const IOError&)
    {
      this->Result.IsCutOff = step > 0 && (this->HasFewLines || this->Rows.isCutOff());
      if (!this->Result.IsCutOff)
      {
        throw;
      }
    }
    if (this->Result.IsCutOff)
    {
      this->Result.Values.resize(values);
      this->Result.Times.resize(times);
    }
  }

  void readStep(std::int64_t step)
  {
    this->Rows.next(2, "a step");
    this->Result.Times.push_back(this->Rows.number(0));
    const bool sparse =
      this->Rows.fields() >= 4 && this->Rows.isNumber(2) && this->Rows.isNumber(3);
    const std::int64_t given = sparse ? this->Rows.integer(2) : this->Nodes;
    const std::int64_t lines = this->Rows.remainingLines();
    this->HasFewLines = given >= 0 && given <= this->Nodes && given > lines;
    if (given < 0 || given > this->Nodes || given > lines)
    {
      this->Rows.fail("announces " + std::to_string(given) + " nodes, but " +
        std::to_string(lines) + " lines follow; copy the file again.");
    }
    const auto components = std::size_t(this->Result.Components);
    const std::size_t first = this->Result.Values.size();
    const double rest = sparse ? this->Rows.number(3) : 0;
    this->Result.Values.resize(first + std::size_t(this->Nodes) * components, rest);
    for (std::int64_t i = 0; i < given; ++i)
    {
      this->Rows.next(1 + components, "a node's values");
      const std::size_t node = this->nodeOf(this->Rows.integer(0), step);
      for (std::size_t c = 0; c < components; ++c)
      {
        this->Result.Values[first + node * components + c] = this->Rows.number(1 + c);
      }
    }
  }

  /// The index in the grid of a node number. A step may list a node only once.
  std::size_t nodeOf(std::int64_t number, std::int64_t step)
  {
    const auto node = this->Grid.IndexOf.find(number);
    if (node == this->Grid.IndexOf.end())
    {
      this->Rows.fail("names node " + std::to_string(number) +
        ", which the grid does not have; name the grid that it belongs to.");
    }
    std::int64_t& last = this->LastStep[std::size_t(node->second)];
    if (last == step)
    {
      this->Rows.fail(
        "gives node " + std::to_string(number) + " twice in a step; copy the file again.");
    }
    last = step;
    return std::size_t(node->second);
  }

  const AdcircGrid& Grid;
  ListDirectedRows Rows;
  std::int64_t Nodes = 0;
  bool HasFewLines = false;           ///< the file ends in the step that is read
  std::vector<std::int64_t> LastStep; ///< the last step that gave the node, or -1
  AdcircValues Result;
};

} // namespace

AdcircValues readAdcircValues(const std::string& path, const AdcircGrid& grid)
{
  return ValuesReader(path, grid).read();
}

} // namespace tipp
