// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSamplingAccess_h
#define tippSamplingAccess_h

#include "Resample/SimplexMesh.h"

#include <type_traits>

namespace tipp
{

/// Calls work(access) as withAccess() does. With TIPP_SAMPLES_DOUBLES the mesh must have
/// coordinates of 64 bits: the wheel's resample() converts others, because code for both is 5 % of
/// the wheel.
template <typename Work>
void withSamplingAccess(const SimplexMesh& mesh, const Work& work)
{
#ifdef TIPP_SAMPLES_DOUBLES
  const auto withIds = [&](auto dimension)
  {
    constexpr int d = decltype(dimension)::value;
    mesh.Wide ? work(SimplexAccess<d, double, std::int64_t>(mesh))
              : work(SimplexAccess<d, double, std::int32_t>(mesh));
  };
  mesh.Dimension == 2 ? withIds(std::integral_constant<int, 2>())
                      : withIds(std::integral_constant<int, 3>());
#else
  withAccess(mesh, work);
#endif
}

} // namespace tipp

#endif
