// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippVectorFeatures_h
#define tippVectorFeatures_h

#include "Raster/GdalLibrary.h"

#include <functional>
#include <string>

namespace tipp
{

/// Calls visit(feature, geometry) for each feature of all layers of a vector file, in their order.
/// Curves are converted to straight lines; the geometry may be null. Throws IOError, and whatever
/// visit() throws.
void forFeatures(
  const std::string& path, const std::function<void(OGRFeatureH, OGRGeometryH)>& visit);

} // namespace tipp

#endif
