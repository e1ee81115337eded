// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDataSetPoints_h
#define tippDataSetPoints_h

#include "Points/PointTable.h"
#include "vtkTIPPIOModule.h"

class vtkDataSet;

namespace tipp
{

/// A data set's points: column z and its numeric point data, the components of an array of several
/// as name_0, name_1 ...
VTKTIPPIO_EXPORT PointTable pointsOf(vtkDataSet* data);

} // namespace tipp

#endif
