// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPartitionReport_h
#define tippPartitionReport_h

#include "Partitioning/PartitionMesh.h"

#include <string>

namespace tipp
{

/// One line for the user.
std::string summarize(const PartitionStatistics& statistics);

/// Writes a JSON file; throws IOError.
void writeReport(const std::string& path, const std::string& input, const std::string& output,
  const PartitionStatistics& statistics);

} // namespace tipp

#endif
