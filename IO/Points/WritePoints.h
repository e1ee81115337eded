// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippWritePoints_h
#define tippWritePoints_h

#include "Files/OutputPath.h"
#include "vtkTIPPIOModule.h"

#include <optional>
#include <string>
#include <vector>

namespace tipp
{

/// Writes x and y interleaved as an .npy file of n x 2 float64; `before` as for PendingFile. Throws
/// IOError.
VTKTIPPIO_EXPORT void writePoints(const std::string& path, const std::vector<double>& xy,
  const std::optional<PathState>& before = std::nullopt);

} // namespace tipp

#endif
