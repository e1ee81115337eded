// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippShortestText_h
#define tippShortestText_h

#include "vtkTIPPAcceleratorsModule.h"

#include <array>

namespace tipp
{

/// Room for the text of any double.
using NumberText = std::array<char, 32>;

/// Writes the shortest text that is read as `value`, with or without an exponent, as
/// std::to_chars() does. Returns its end. It is not terminated.
VTKTIPPACCELERATORS_EXPORT char* writeShortest(NumberText& text, double value);

/// Does the same, with an exponent in any case.
VTKTIPPACCELERATORS_EXPORT char* writeShortestScientific(NumberText& text, double value);

} // namespace tipp

#endif
