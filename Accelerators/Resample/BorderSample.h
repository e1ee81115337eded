// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippBorderSample_h
#define tippBorderSample_h

#include "Resample/CellKey.h"

#include <cstdint>

namespace tipp
{

/// A sample that cells touch but none contains, with the key of the one that answers it.
struct BorderSample
{
  std::int64_t Sample;
  CellKey Key;
};

} // namespace tipp

#endif
