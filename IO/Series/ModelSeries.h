// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippModelSeries_h
#define tippModelSeries_h

#include "Series/MeshSeries.h"

#include <memory>
#include <string>

namespace tipp
{

///@{
/// Implement openMeshSeries() for one kind of file.
std::unique_ptr<MeshSeries> openAdcircSeries(const std::string& path, const SeriesOptions& options);
std::unique_ptr<MeshSeries> openSmsSeries(const std::string& path, const SeriesOptions& options);
std::unique_ptr<MeshSeries> openSelafinSeries(
  const std::string& path, const SeriesOptions& options);
/// For any file that readModelMesh() reads: without time steps.
std::unique_ptr<MeshSeries> openModelSeries(const std::string& path, const SeriesOptions& options);
///@}

/// Throws IOError if options.Values is not empty: files of this kind have no values elsewhere.
void refuseValues(const std::string& path, const SeriesOptions& options);

} // namespace tipp

#endif
