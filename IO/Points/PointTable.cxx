// SPDX-License-Identifier: BSD-3-Clause
#include "Points/PointTable.h"

namespace tipp
{

std::size_t PointTable::size() const
{
  return this->XY.size() / 2;
}

} // namespace tipp
