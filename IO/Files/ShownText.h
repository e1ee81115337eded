// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippShownText_h
#define tippShownText_h

#include "vtkTIPPIOModule.h"

#include <set>
#include <string>

namespace tipp
{

/// A text of a file as it can stand in a message: one line, and not too long.
VTKTIPPIO_EXPORT std::string shownText(const std::string& text);

/// `intro` and the names in quotes, for a message that says what there is: "; there are 'a', 'b'".
/// After twenty it says how many more there are. "; there are none" without names.
VTKTIPPIO_EXPORT std::string listOfNames(
  const std::set<std::string>& names, const std::string& intro);

} // namespace tipp

#endif
