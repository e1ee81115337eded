// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippNpyHeader_h
#define tippNpyHeader_h

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tipp
{

/// The dictionary at the start of an .npy file.
struct NpyHeader
{
  std::string Descr; ///< as "<f8"
  bool FortranOrder = false;
  std::vector<std::int64_t> Shape;
};

/// Nothing if the text is not such a dictionary with exactly the three keys and plain values, no
/// extent of the shape being negative.
std::optional<NpyHeader> parseNpyHeader(std::string_view text);

} // namespace tipp

#endif
