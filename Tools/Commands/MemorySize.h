// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippMemorySize_h
#define tippMemorySize_h

#include <cstdint>
#include <optional>
#include <string>

namespace tipp
{

/// Bytes, or with K, M, G units of 2^10, 2^20, 2^30 of them, as "512M"; nothing for other texts
/// and for 0.
std::optional<std::uint64_t> parseMemorySize(const std::string& text);

/// For the command line: empty, or what is wrong.
std::string checkMemorySize(const std::string& text);

} // namespace tipp

#endif
