// SPDX-License-Identifier: BSD-3-Clause
#include "Series/LocatedVariables.h"

#include "Files/IOError.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace tipp
{
namespace
{

/// Returns the file's dimension of nodes or cells: by its name or, in a file without the mesh that
/// has no such name, by its size, if it is not that of time. -1 if there is none.
int findAlike(const std::string& path, const NetcdfContent& content, int time,
  const std::string& name, std::int64_t size, const std::string& what)
{
  const int named = content.findDimension(name);
  if (named >= 0 && content.size(named) != size)
  {
    throw IOError(path,
      "has " + std::to_string(content.size(named)) + " " + what + " by its dimension '" + name +
        "', but the mesh has " + std::to_string(size) + "; name the mesh that it belongs to.");
  }
  const auto alike = std::find_if(content.Dimensions.begin(), content.Dimensions.end(),
    [&](const NetcdfDimension& dimension)
    { return dimension.Size == size && &dimension - content.Dimensions.data() != time; });
  return named >= 0                     ? named
    : alike == content.Dimensions.end() ? -1
                                        : int(alike - content.Dimensions.begin());
}

class VariableLocator
{
public:
  VariableLocator(
    const std::string& path, const NetcdfContent& content, const LocatingContext& context)
    : Content(content)
    , Context(context)
    , Node(context.HasMesh ? context.Mesh->NodeDimension
                           : findAlike(path, content, context.TimeDimension,
                               context.Dimensions.NodeName, context.Dimensions.Nodes, "nodes"))
    , Cell(context.HasMesh ? context.Mesh->CellDimension
                           : findAlike(path, content, context.TimeDimension,
                               context.Dimensions.CellName, context.Dimensions.Cells, "cells"))
  {
  }

  LocatedVariables locate()
  {
    for (const NetcdfVariable& variable : this->Content.Variables)
    {
      if (this->Context.Mesh->Parts.count(variable.Name) == 0)
      {
        this->add(variable);
      }
    }
    return std::move(this->Result);
  }

private:
  void leaveOut(const NetcdfVariable& variable, const std::string& reason)
  {
    this->Result.LeftOut.push_back({ variable.Name, reason });
  }

  void add(const NetcdfVariable& variable)
  {
    const auto has = [&](int dimension)
    {
      return dimension >= 0
        ? std::count(variable.Dimensions.begin(), variable.Dimensions.end(), dimension)
        : 0;
    };
    const auto onNodes = has(this->Node);
    const auto onCells = this->Cell != this->Node ? has(this->Cell) : 0;
    if (onNodes + onCells == 0)
    {
      if (variable.text("location") == "edge")
      {
        this->leaveOut(variable, "has values on edges, not at nodes or cells");
      }
      return;
    }
    if (onNodes + onCells > 1)
    {
      this->leaveOut(variable, "relates nodes or cells to each other");
      return;
    }
    if (!variable.Type)
    {
      this->leaveOut(variable, "has no numbers");
      return;
    }
    this->addNumbers(variable, onCells > 0);
  }

  void addNumbers(const NetcdfVariable& variable, bool isOnCells)
  {
    LocatedVariable located;
    for (std::size_t i = 0; i < variable.Dimensions.size(); ++i)
    {
      const int dimension = variable.Dimensions[i];
      const NetcdfDimension& described = this->Content.Dimensions[std::size_t(dimension)];
      if (dimension == this->Context.TimeDimension && located.TimeAxis < 0)
      {
        located.TimeAxis = int(i);
      }
      else if (dimension == (isOnCells ? this->Cell : this->Node))
      {
        located.SpaceAxis = int(i);
      }
      else if (dimension != this->Node && dimension != this->Cell && described.Size != 1)
      {
        this->leaveOut(variable,
          "has the dimension '" + described.Name + "' of " + std::to_string(described.Size) +
            " besides space in the plane and time");
        return;
      }
    }
    if (located.SpaceAxis < 0)
    {
      this->leaveOut(variable, "has its nodes or cells along the dimension of time");
      return;
    }
    if (located.TimeAxis >= 0 && this->Content.size(this->Context.TimeDimension) == 0)
    {
      this->leaveOut(variable, "has no time steps");
      return;
    }
    located.Variable = &variable;
    located.Described = { variable.Name, variable.text("long_name"), variable.text("units"),
      variable.unpackedType(), isOnCells, located.TimeAxis >= 0 };
    located.Described.StandardName = variable.text("standard_name");
    this->Result.Variables.push_back(std::move(located));
  }

  const NetcdfContent& Content;
  const LocatingContext& Context;
  const int Node;
  const int Cell;
  LocatedVariables Result;
};

} // namespace

MeshDimensions dimensionsOf(const NetcdfContent& content, const NetcdfMesh& mesh)
{
  return { content.Dimensions[std::size_t(mesh.NodeDimension)].Name,
    content.Dimensions[std::size_t(mesh.CellDimension)].Name, content.size(mesh.NodeDimension),
    content.size(mesh.CellDimension) };
}

LocatedVariables locateVariables(
  const std::string& path, const NetcdfContent& content, const LocatingContext& context)
{
  return VariableLocator(path, content, context).locate();
}

} // namespace tipp
