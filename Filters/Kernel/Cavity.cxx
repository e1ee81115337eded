// SPDX-License-Identifier: BSD-3-Clause
#include "Kernel/Cavity.h"

namespace tipp
{

Cavity::Cavity()
  : Places(64)
  , Stack(64)
{
}

void Cavity::grow()
{
  const std::size_t size = 2 * this->Places.size();
  this->Places.resize(size);
  this->Stack.resize(size);
}

} // namespace tipp
