// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippFlattenAdcirc_h
#define tippFlattenAdcirc_h

#include "Adcirc/AdcircGrid.h"
#include "Flat/FlatFolder.h"
#include "vtkTIPPIOModule.h"

#include <cstdint>
#include <string>
#include <vector>

namespace tipp
{

/// Values at the nodes of an ADCIRC grid (https://adcirc.org; fort.63, fort.64, maxele.63 ...): a
/// title; the numbers of steps and nodes, two unused numbers, and the number of values per node;
/// for each step a line of time and time step, and a line `node value...` per node. A step may give
/// a number of nodes and a default value on its first line, and then only the nodes that differ.
/// Nodes are identified by the grid's node numbers. A file with fewer steps than announced, as from
/// an interrupted run, is rejected.
struct AdcircValues
{
  int Components = 1;
  std::vector<double> Times; ///< of the steps, in seconds
  std::vector<double>
    Values; ///< step by step, in the order of the grid's nodes; -99999 at dry nodes
};

/// Throws IOError, also if the values belong to another grid.
VTKTIPPIO_EXPORT AdcircValues readAdcircValues(const std::string& path, const AdcircGrid& grid);

/// Converts an ADCIRC grid (AdcircGrid) with the point data "depth" and, for each file of values
/// (AdcircValues), point data named after the file without extension; "fort.63" and "fort.64" are
/// kept as they are. Several steps become an array that varies in time; files of several steps must
/// have equal times. Throws IOError.
VTKTIPPIO_EXPORT FlatContent flattenAdcirc(
  const std::string& grid, const std::vector<std::string>& values);

} // namespace tipp

#endif
