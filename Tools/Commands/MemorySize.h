// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippMemorySize_h
#define tippMemorySize_h

#include <cstdint>
#include <optional>
#include <string>

namespace tipp
{

/// Parses a number of bytes, or with the suffix K, M, G of 2^10, 2^20, 2^30 bytes, such as "512M";
/// nullopt for any other text and for 0.
std::optional<std::uint64_t> parseMemorySize(const std::string& text);

/// A validator for the command line: returns an error message, or an empty string.
std::string checkMemorySize(const std::string& text);

} // namespace tipp

#endif
