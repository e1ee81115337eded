// SPDX-License-Identifier: BSD-3-Clause
#include "Series/MeshSeries.h"

#include "Files/Formats.h"
#include "Files/IOError.h"
#include "Models/ModelMesh.h"
#include "Series/ModelSeries.h"
#include "Series/NetcdfSeries.h"

#include <algorithm>
#include <set>

namespace tipp
{

std::unique_ptr<MeshSeries> openMeshSeries(const std::string& path, const SeriesOptions& options)
{
  switch (openerOf(path, Use::Triangles))
  {
    case Opener::Netcdf:
      return openNetcdfSeries(path, options);
    case Opener::Selafin:
      return openSelafinSeries(path, options);
    case Opener::Adcirc:
      return openAdcircSeries(path, options);
    case Opener::Sms:
      return openSmsSeries(path, options);
    case Opener::Gmsh:
    case Opener::Triangle:
      return openModelSeries(path, options);
    default:
      refuseKind(path, "has no extension that tells a kind of mesh of a model.");
  }
}

bool isMeshSeries(const std::string& path)
{
  return isModelMesh(path);
}

std::size_t findSeriesVariable(const MeshSeries& series, const std::string& name)
{
  const auto found = std::find_if(series.Variables.begin(), series.Variables.end(),
    [&](const SeriesVariable& variable) { return variable.Name == name; });
  if (found != series.Variables.end())
  {
    return std::size_t(found - series.Variables.begin());
  }
  for (const SeriesLeftOut& left : series.LeftOut)
  {
    if (left.Name == name)
    {
      throw IOError(
        series.Path, "'" + shownText(name) + "' " + left.Reason + ", so it cannot be used.");
    }
  }
  std::set<std::string> names;
  for (const SeriesVariable& variable : series.Variables)
  {
    names.insert(variable.Name);
  }
  throw IOError(series.Path,
    "has no variable '" + shownText(name) + "'" + listOfNames(names, "; there are ") + ".");
}

void refuseValues(const std::string& path, const SeriesOptions& options)
{
  if (!options.Values.empty())
  {
    throw IOError(path, "is of a kind whose values are not in other files; leave out --values.");
  }
}

} // namespace tipp
