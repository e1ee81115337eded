// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTablePoints_h
#define tippTablePoints_h

#include "Points/PointStream.h"
#include "Points/PointTable.h"
#include "vtkTIPPIOModule.h"

#include <memory>

namespace tipp
{

/// The points of a table as a stream, those that thinning keeps. Throws IOError as thinPoints().
VTKTIPPIO_EXPORT std::unique_ptr<PointStream> streamTable(
  PointTable table, const Thinning& thinning = {});

} // namespace tipp

#endif
