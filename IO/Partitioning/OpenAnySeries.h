// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippOpenAnySeries_h
#define tippOpenAnySeries_h

#include "Series/MeshSeries.h"
#include "vtkTIPPIOModule.h"

#include <memory>
#include <string>

namespace tipp
{

/// Opens the output of a model, or a flat or partitioned mesh of triangles, which takes no options.
/// Throws IOError.
VTKTIPPIO_EXPORT std::unique_ptr<MeshSeries> openAnySeries(
  const std::string& path, const SeriesOptions& options);

} // namespace tipp

#endif
