// SPDX-License-Identifier: BSD-3-Clause
#include "Adcirc/AdcircGrid.h"

#include "Adcirc/AdcircRows.h"

#include <utility>

namespace tipp
{
namespace
{

class AdcircReader
{
public:
  AdcircReader(const std::string& path, const std::string& text)
    : Rows(path, text, "an ADCIRC grid")
  {
  }

  AdcircGrid read()
  {
    this->Rows.skipTitle();
    this->Rows.next(2, "the numbers of elements and nodes");
    const std::int64_t elements = this->Rows.integer(0);
    const std::int64_t nodes = this->Rows.integer(1);
    const std::int64_t lines = this->Rows.remainingLines();
    if (elements < 0 || nodes < 0 || elements > lines || nodes > lines - elements)
    {
      this->Rows.fail("announces " + std::to_string(elements) + " elements and " +
        std::to_string(nodes) + " nodes, but " + std::to_string(lines) +
        " lines follow; copy the file again or correct the numbers.");
    }
    this->readNodes(nodes);
    this->readElements(elements);
    return std::move(this->Grid);
  }

private:
  void readNodes(std::int64_t count)
  {
    this->Grid.XY.reserve(2 * std::size_t(count));
    this->Grid.Depth.reserve(std::size_t(count));
    for (std::int64_t i = 0; i < count; ++i)
    {
      this->Rows.next(4, "a node");
      const std::int64_t number = this->Rows.integer(0);
      if (!this->Grid.IndexOf.emplace(number, i).second)
      {
        this->Rows.fail("node " + std::to_string(number) + " is given twice.");
      }
      this->Grid.XY.push_back(this->Rows.number(1));
      this->Grid.XY.push_back(this->Rows.number(2));
      this->Grid.Depth.push_back(this->Rows.number(3));
    }
  }

  void readElements(std::int64_t count)
  {
    this->Grid.Triangles.reserve(3 * std::size_t(count));
    for (std::int64_t i = 0; i < count; ++i)
    {
      this->Rows.next(5, "an element");
      if (this->Rows.integer(1) != 3)
      {
        this->Rows.fail("holds an element that is not a triangle; only triangles can be read.");
      }
      for (std::size_t corner = 2; corner < 5; ++corner)
      {
        const std::int64_t number = this->Rows.integer(corner);
        const auto node = this->Grid.IndexOf.find(number);
        if (node == this->Grid.IndexOf.end())
        {
          this->Rows.fail("names node " + std::to_string(number) + ", which is not given.");
        }
        this->Grid.Triangles.push_back(node->second);
      }
    }
  }

  AdcircRows Rows;
  AdcircGrid Grid;
};

} // namespace

AdcircGrid readAdcircGrid(const std::string& path)
{
  const std::string text = readTextFile(path);
  return AdcircReader(path, text).read();
}

} // namespace tipp
