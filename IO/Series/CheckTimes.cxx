// SPDX-License-Identifier: BSD-3-Clause
#include "Series/CheckTimes.h"

#include "Files/IOError.h"
#include "Files/TextFile.h"

#include <cmath>
#include <cstddef>

namespace tipp
{

void checkTimes(const std::string& path, const std::vector<double>& times)
{
  for (std::size_t i = 0; i < times.size(); ++i)
  {
    if (!std::isfinite(times[i]))
    {
      throw IOError(path, "gives step " + std::to_string(i) + " (from 0) no time; copy it again.");
    }
    if (i > 0 && !(times[i - 1] < times[i]))
    {
      throw IOError(path,
        "has times that do not ascend: step " + std::to_string(i) + " (from 0) is at " +
          shortText(times[i]) + " and the one before at " + shortText(times[i - 1]) +
          "; keep each time once, in order.");
    }
  }
}

} // namespace tipp
