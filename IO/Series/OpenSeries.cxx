// SPDX-License-Identifier: BSD-3-Clause
#include "Series/ModelSeries.h"

#include "Files/Formats.h"
#include "Files/IOError.h"
#include "Models/ModelMesh.h"
#include "Series/NetcdfSeries.h"
#include "Series/VtkHdfSeries.h"

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
      if (isVtkHdfSeries(path))
      {
        return openVtkHdfSeries(path, options);
      }
      refuseKind(path, "has no extension that tells a kind of mesh of a model.");
  }
}

bool isMeshSeries(const std::string& path)
{
  return isModelMesh(path) || isVtkHdfSeries(path);
}

void refuseValues(const std::string& path, const SeriesOptions& options)
{
  if (!options.Values.empty())
  {
    throw IOError(path, "is of a kind whose values are not in other files; leave out --values.");
  }
}

} // namespace tipp
