// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippArrayFileName_h
#define tippArrayFileName_h

#include "vtkTIPPIOModule.h"

#include <string>

namespace tipp
{

/// An array's name as a file's, without extension: slashes, control characters, per cent signs and
/// a leading dot become % and two hexadecimal digits.
VTKTIPPIO_EXPORT std::string arrayFileName(const std::string& name);

/// The other way round; a % without two hexadecimal digits after it stands for itself.
VTKTIPPIO_EXPORT std::string arrayNameOf(const std::string& fileName);

} // namespace tipp

#endif
