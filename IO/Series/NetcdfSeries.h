// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippNetcdfSeries_h
#define tippNetcdfSeries_h

#include "Series/MeshSeries.h"

#include <memory>
#include <string>

namespace tipp
{

/// Opens NetCDF files of the conventions that findUgridMesh(), findMpasMesh() and findNamedMesh()
/// know, with values in the same file or in others. Throws IOError; also if the NetCDF library is
/// not there.
std::unique_ptr<MeshSeries> openNetcdfSeries(const std::string& path, const SeriesOptions& options);

} // namespace tipp

#endif
