// SPDX-License-Identifier: BSD-3-Clause
#include "Adcirc/AdcircGrid.h"

#include "Adcirc/ListDirectedRows.h"

#include <optional>
#include <utility>

namespace tipp
{

namespace
{

/// How the boundaries of a kind, ADCIRC's IBTYPE, list their nodes.
enum class Listing
{
  Chain,  ///< a node per line, which parameters may follow
  Island, ///< a closed chain
  Weir,   ///< a pair of nodes per line, on both sides of a weir or wall
  Pairs   ///< a pair of nodes per line, on two sides of a periodic domain
};

/// Returns nothing for a number that is no kind of ADCIRC's.
std::optional<Listing> listingOf(std::int64_t kind)
{
  constexpr std::int64_t baroclinic = 100; // added to the kinds of rivers
  switch (kind >= baroclinic && kind < 2 * baroclinic ? kind - baroclinic : kind)
  {
    case 1:
    case 11:
    case 21:
      return Listing::Island;
    case 4:
    case 5:
    case 24:
    case 25:
    case 64:
      return Listing::Weir;
    case 94:
      return Listing::Pairs;
    case 0:
    case 2:
    case 3:
    case 10:
    case 12:
    case 13:
    case 18:
    case 20:
    case 22:
    case 23:
    case 30:
    case 32:
    case 40:
    case 41:
    case 52:
    case 60:
    case 61:
      return Listing::Chain;
    default:
      return std::nullopt;
  }
}

/// What is read besides the nodes. Elements are always checked.
enum class Contents
{
  Nodes,
  Triangles,
  Boundaries
};

class AdcircReader
{
public:
  AdcircReader(const std::string& path, Contents contents)
    : Rows(path, "an ADCIRC grid")
    , Wanted(contents)
  {
  }

  AdcircGrid read()
  {
    this->Grid.Title = this->Rows.title();
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
    LineReader boundaries(this->Rows.rest());
    for (std::string_view line; boundaries.next(line);)
    {
      this->Grid.Boundaries.append(line) += '\n';
    }
    if (this->Wanted == Contents::Boundaries)
    {
      this->readBoundaries();
    }
    return std::move(this->Grid);
  }

private:
  /// Reads the open boundaries, then the land boundaries.
  void readBoundaries()
  {
    for (const bool isLand : { false, true })
    {
      const std::int64_t boundaries = this->nextCount(1, "the number of boundaries");
      this->Rows.next(1, "the number of boundary nodes");
      for (std::int64_t i = 0; i < boundaries; ++i)
      {
        this->readBoundary(isLand);
      }
    }
    this->closeWeirs();
  }

  void readBoundary(bool isLand)
  {
    const std::int64_t count =
      this->nextCount(isLand ? 2 : 1, "the number of a boundary's nodes and its kind");
    const std::int64_t kind = isLand ? this->Rows.integer(1) : 0;
    const std::optional<Listing> listing = listingOf(kind);
    if (!listing)
    {
      this->Rows.fail("has a boundary of the kind " + std::to_string(kind) +
        ", which is no IBTYPE of ADCIRC; correct it.");
    }
    const bool isWeir = *listing == Listing::Weir;
    const bool hasPairs = isWeir || *listing == Listing::Pairs;
    std::vector<std::int64_t> front;
    std::vector<std::int64_t> back;
    for (std::int64_t i = 0; i < count; ++i)
    {
      this->Rows.next(hasPairs ? 2 : 1, "a node of a boundary");
      front.push_back(this->node(0));
      if (hasPairs)
      {
        back.push_back(this->node(1));
      }
    }
    if (*listing == Listing::Island && !front.empty() && front.front() != front.back())
    {
      front.push_back(front.front());
    }
    if (isWeir && !front.empty())
    {
      this->WeirEnds.push_back({ front.front(), back.front() });
      this->WeirEnds.push_back({ front.back(), back.back() });
    }
    for (const auto& nodes : { front, back })
    {
      for (std::size_t i = 1; i < nodes.size(); ++i)
      {
        this->Grid.BoundaryEdges.push_back({ nodes[i - 1], nodes[i] });
      }
    }
  }

  std::int64_t nextCount(std::size_t fields, const char* what)
  {
    this->Rows.next(fields, what);
    const std::int64_t count = this->Rows.integer(0);
    if (count < 0 || count > this->Rows.remainingLines())
    {
      this->Rows.fail("announces " + std::to_string(count) + " boundaries or nodes, but " +
        std::to_string(this->Rows.remainingLines()) +
        " lines follow; copy the file again or correct the number.");
    }
    return count;
  }

  /// The two sides of a weir are continued by other boundaries; where they are not, an edge is
  /// added between their ends.
  void closeWeirs()
  {
    std::unordered_map<std::int64_t, int> degrees;
    for (const auto& edge : this->Grid.BoundaryEdges)
    {
      ++degrees[edge[0]];
      ++degrees[edge[1]];
    }
    for (const auto& ends : this->WeirEnds)
    {
      if (ends[0] != ends[1] && degrees[ends[0]] % 2 != 0 && degrees[ends[1]] % 2 != 0)
      {
        this->Grid.BoundaryEdges.push_back(ends);
        ++degrees[ends[0]];
        ++degrees[ends[1]];
      }
    }
  }

  std::int64_t node(std::size_t field) const
  {
    const std::int64_t number = this->Rows.integer(field);
    const auto node = this->Grid.IndexOf.find(number);
    if (node == this->Grid.IndexOf.end())
    {
      this->Rows.fail("names node " + std::to_string(number) + ", which is not given.");
    }
    return node->second;
  }

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
    for (std::int64_t i = 0; i < count; ++i)
    {
      this->Rows.next(5, "an element");
      const std::int64_t corners = this->Rows.integer(1);
      const bool needsTriangle = this->Wanted == Contents::Triangles;
      if (corners != 3 && (needsTriangle || corners != 4))
      {
        this->Rows.fail("the element is not a triangle but has " + std::to_string(corners) +
          " corners; divide such elements, or use the nodes alone, as 'tipp delaunay' does.");
      }
      if (this->Rows.fields() < std::size_t(2 + corners))
      {
        this->Rows.fail("has too few numbers for an element; check that it is an ADCIRC grid.");
      }
      for (std::int64_t corner = 0; corner < corners; ++corner)
      {
        const std::int64_t node = this->node(std::size_t(2 + corner));
        if (needsTriangle)
        {
          this->Grid.Triangles.push_back(node);
        }
      }
    }
  }

  ListDirectedRows Rows;
  const Contents Wanted;
  AdcircGrid Grid;
  std::vector<std::array<std::int64_t, 2>> WeirEnds; ///< pairs of opposite nodes
};

} // namespace

AdcircGrid readAdcircGrid(const std::string& path)
{
  return AdcircReader(path, Contents::Triangles).read();
}

AdcircGrid readAdcircNodes(const std::string& path)
{
  return AdcircReader(path, Contents::Nodes).read();
}

AdcircGrid readAdcircBoundaries(const std::string& path)
{
  return AdcircReader(path, Contents::Boundaries).read();
}

} // namespace tipp
