// SPDX-License-Identifier: BSD-3-Clause
#include "Series/MeshSeries.h"

#include "Files/IOError.h"

namespace tipp
{

std::unique_ptr<MeshSeries> openMeshSeries(const std::string& path, const SeriesOptions&)
{
  throw IOError(path, "is not the output of a model.");
}

bool isMeshSeries(const std::string&)
{
  return false;
}

} // namespace tipp
