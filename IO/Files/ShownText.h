// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippShownText_h
#define tippShownText_h

#include "vtkTIPPIOModule.h"

#include <set>
#include <string>

namespace tipp
{

/// Formats text from a file for a message: on one line, and shortened if it is long.
VTKTIPPIO_EXPORT std::string shownText(const std::string& text);

/// Returns `intro` and the quoted names, for a message that lists alternatives: "; there are 'a',
/// 'b'". After twenty names it gives the number of the others. Without names: "; there are none".
VTKTIPPIO_EXPORT std::string listOfNames(
  const std::set<std::string>& names, const std::string& intro);

} // namespace tipp

#endif
