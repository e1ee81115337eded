// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippOpenSeries_h
#define tippOpenSeries_h

#include "Series/MeshSeries.h"

#include <memory>
#include <string>

namespace tipp
{

/// openAnySeries(), with a warning of what is left out. Throws IOError, or CLI::ValidationError for
/// options that the mesh does not take.
std::unique_ptr<MeshSeries> openSeries(const std::string& path, const SeriesOptions& options);

} // namespace tipp

#endif
