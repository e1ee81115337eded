// SPDX-License-Identifier: BSD-3-Clause
#include "Kernel/Cavity.h"

namespace tipp
{

Cavity::Cavity()
  : Triangles(64)
  , Ring(64)
  , Stack(64)
{
}

void Cavity::grow()
{
  const std::size_t size = 2 * this->Triangles.size();
  this->Triangles.resize(size);
  this->Ring.resize(size);
  this->Stack.resize(size);
}

} // namespace tipp
