// SPDX-License-Identifier: BSD-3-Clause
#include "Points/WritePoints.h"

#include "Npy/NpyFile.h"

namespace tipp
{

void writePoints(const std::string& path, const std::vector<double>& xy)
{
  NpyWriter writer(path, "<f8", { std::int64_t(xy.size() / 2), 2 });
  writer.write(xy.data(), xy.size() * sizeof(double));
  writer.close();
}

} // namespace tipp
