// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPopulatePages_h
#define tippPopulatePages_h

#include "vtkTIPPFiltersModule.h"

#include <cstddef>

namespace tipp
{

/// Has the system provide the pages of fresh memory at once, which takes less time than a fault at
/// the first touch of each. What is in memory stays, and where systems cannot do it, nothing
/// happens.
VTKTIPPFILTERS_EXPORT void populatePages(void* memory, std::size_t bytes);

} // namespace tipp

#endif
