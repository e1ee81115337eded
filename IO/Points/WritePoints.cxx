// SPDX-License-Identifier: BSD-3-Clause
#include "Points/WritePoints.h"

#include "Npy/NpyFile.h"

namespace tipp
{

void writePoints(
  const std::string& path, const std::vector<double>& xy, const std::optional<PathState>& before)
{
  NpyWriter writer(path, "<f8", { std::int64_t(xy.size() / 2), 2 }, before);
  writer.write(xy.data(), xy.size() * sizeof(double));
  writer.close();
}

} // namespace tipp
