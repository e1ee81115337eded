// SPDX-License-Identifier: BSD-3-Clause
#include "Adcirc/AdcircGrid.h"

#include "Files/IOError.h"
#include "Files/TextFile.h"

#include <unordered_map>
#include <utility>

namespace tipp
{
namespace
{

class AdcircReader
{
public:
  AdcircReader(const std::string& path, const std::string& text)
    : Path(path)
    , Lines(text)
  {
  }

  AdcircGrid read()
  {
    std::string_view title;
    this->Lines.next(title);
    this->readRow(2, "the numbers of elements and nodes");
    const std::int64_t elements = this->integer(0);
    const std::int64_t nodes = this->integer(1);
    const std::int64_t lines = this->Lines.remainingLines();
    if (elements < 0 || nodes < 0 || elements > lines || nodes > lines - elements)
    {
      this->fail("announces " + std::to_string(elements) + " elements and " +
        std::to_string(nodes) + " nodes, but " + std::to_string(lines) +
        " lines follow; copy the file again or correct the numbers.");
    }
    this->readNodes(nodes);
    this->readElements(elements);
    return std::move(this->Grid);
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
      this->fail(
        std::string("has too few numbers for ") + what + "; check that it is an ADCIRC grid.");
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

  void readNodes(std::int64_t count)
  {
    this->Grid.XY.reserve(2 * std::size_t(count));
    this->Grid.Depth.reserve(std::size_t(count));
    for (std::int64_t i = 0; i < count; ++i)
    {
      this->readRow(4, "a node");
      if (!this->IndexOf.emplace(this->integer(0), i).second)
      {
        this->fail("node " + std::to_string(this->integer(0)) + " is given twice.");
      }
      this->Grid.XY.push_back(this->number(1));
      this->Grid.XY.push_back(this->number(2));
      this->Grid.Depth.push_back(this->number(3));
    }
  }

  void readElements(std::int64_t count)
  {
    this->Grid.Triangles.reserve(3 * std::size_t(count));
    for (std::int64_t i = 0; i < count; ++i)
    {
      this->readRow(5, "an element");
      if (this->integer(1) != 3)
      {
        this->fail("holds an element that is not a triangle; only triangles can be read.");
      }
      for (std::size_t corner = 2; corner < 5; ++corner)
      {
        const auto node = this->IndexOf.find(this->integer(corner));
        if (node == this->IndexOf.end())
        {
          this->fail("names node " + std::string(this->Row[corner]) + ", which is not given.");
        }
        this->Grid.Triangles.push_back(node->second);
      }
    }
  }

  const std::string& Path;
  LineReader Lines;
  std::vector<std::string_view> Row;
  std::unordered_map<std::int64_t, std::int64_t> IndexOf; // node numbers may have gaps
  AdcircGrid Grid;
};

} // namespace

AdcircGrid readAdcircGrid(const std::string& path)
{
  const std::string text = readTextFile(path);
  return AdcircReader(path, text).read();
}

} // namespace tipp
