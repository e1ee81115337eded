// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippAdcircValues_h
#define tippAdcircValues_h

#include "Adcirc/AdcircGrid.h"

#include <string>
#include <vector>

namespace tipp
{

/// Values at the nodes of an ADCIRC grid (https://adcirc.org; fort.63, fort.64, maxele.63 ...): a
/// title; the numbers of steps and nodes, two unused numbers, and the number of values per node;
/// for each step a line of time and time step, and a line `node value...` per node. A step may give
/// a number of nodes and a default value on its first line, and then only the nodes that differ.
/// Nodes are identified by the grid's node numbers. A file may end before its last step is
/// complete, as after an interrupted run.
struct AdcircValues
{
  bool IsCutOff = false;     ///< the file has fewer steps than it announces; one at least
  int Components = 1;        ///< values per node
  std::vector<double> Times; ///< times of the steps, in seconds
  std::vector<double>
    Values; ///< step by step, in the order of the grid's nodes; -99999 at dry nodes
};

/// Throws IOError if the file cannot be read or its values belong to another grid.
AdcircValues readAdcircValues(const std::string& path, const AdcircGrid& grid);

} // namespace tipp

#endif
