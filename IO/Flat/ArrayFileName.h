// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippArrayFileName_h
#define tippArrayFileName_h

#include "vtkTIPPIOModule.h"

#include <string>

namespace tipp
{

/// Returns the file name, without extension, for an array: slashes, control characters, per cent
/// signs and a leading dot become % and two hexadecimal digits.
VTKTIPPIO_EXPORT std::string arrayFileName(const std::string& name);

/// The inverse of arrayFileName(). A % that two hexadecimal digits do not follow is kept.
VTKTIPPIO_EXPORT std::string arrayNameOf(const std::string& fileName);

} // namespace tipp

#endif
