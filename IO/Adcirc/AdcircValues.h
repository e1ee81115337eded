// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippAdcircValues_h
#define tippAdcircValues_h

#include "Adcirc/AdcircGrid.h"
#include "vtkTIPPIOModule.h"

#include <cstdint>
#include <string>
#include <vector>

namespace tipp
{

/// Values at the nodes of an ADCIRC grid (https://adcirc.org; fort.63, fort.64, maxele.63 ...): a
/// title; the numbers of steps and nodes, two numbers that are not used, and how many values a node
/// has; for each step a line of time and time step, and a line `node value...` a node. A step may
/// give a number of nodes and a default on its first line, and then only the nodes that differ.
/// Nodes go by the grid's numbers. Where fewer steps are there than announced, as in a run that was
/// stopped, the file is refused.
struct AdcircValues
{
  int Components = 1;
  std::vector<double> Times; ///< of the steps, in seconds
  std::vector<double>
    Values; ///< step by step, in the order of the grid's nodes; -99999 where a node is dry
};

/// Throws IOError, for the output of another grid too.
VTKTIPPIO_EXPORT AdcircValues readAdcircValues(const std::string& path, const AdcircGrid& grid);

} // namespace tipp

#endif
