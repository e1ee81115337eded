// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippStatedCodes_h
#define tippStatedCodes_h

#include "vtkTIPPIOModule.h"

#include <string>

namespace tipp
{

/// The EPSG codes of a system and of its heights, as its text states them; 0: none.
struct StatedCodes
{
  int Horizontal = 0;
  int Heights = 0;
};

/// Reads "CODE" or "CODE+CODE". Returns no codes for any other text.
StatedCodes codesIn(const std::string& text);

/// Reads the codes of a system: "EPSG:CODE", "EPSG:CODE+CODE", or those that a WKT states for the
/// whole system or, if it is compound, for its two parts. Returns no codes for any other text.
VTKTIPPIO_EXPORT StatedCodes codesOf(const std::string& text);

/// Whether the text has a system of heights besides the horizontal one.
VTKTIPPIO_EXPORT bool hasHeightSystem(const std::string& text);

/// The text without blanks.
std::string withoutBlanks(const std::string& text);

} // namespace tipp

#endif
