// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPopulatePages_h
#define tippPopulatePages_h

#include "vtkTIPPFiltersModule.h"

#include <cstddef>

namespace tipp
{

/// Commits the pages of fresh memory at once, which is faster than a page fault at the first touch
/// of each. The content stays. Does nothing if the system does not support it.
VTKTIPPFILTERS_EXPORT void populatePages(void* memory, std::size_t bytes);

} // namespace tipp

#endif
