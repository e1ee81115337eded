// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippStepSelection_h
#define tippStepSelection_h

#include "vtkTIPPIOModule.h"

#include <cstddef>
#include <string>
#include <vector>

namespace tipp
{

/// Whether a text is one number of a time step, or empty.
VTKTIPPIO_EXPORT bool isOneStep(const std::string& text);

/// Returns what is wrong with a text for parseSteps(); empty if it is right.
VTKTIPPIO_EXPORT std::string checkSteps(const std::string& text);

/// Returns the numbers of the time steps that a text asks for, of the `count` steps of the file
/// `path`: "N", "all" or "FIRST:LAST:STRIDE", where each may be left out, and LAST is included. An
/// empty text is step 0. Throws IOError if there is no such step.
VTKTIPPIO_EXPORT std::vector<std::size_t> parseSteps(
  const std::string& text, std::size_t count, const std::string& path);

} // namespace tipp

#endif
