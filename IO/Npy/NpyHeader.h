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

class InputFile;

/// The dictionary at the start of an .npy file.
struct NpyHeader
{
  std::string Descr; ///< as "<f8"
  bool FortranOrder = false;
  std::vector<std::int64_t> Shape;
};

/// Parses the dictionary; nullopt unless it has exactly the three keys with plain values, and no
/// negative extent.
std::optional<NpyHeader> parseNpyHeader(std::string_view text);

/// Reads the dictionary of a file of version 1 to 3 and the offset of its data in bytes; throws
/// IOError.
NpyHeader readNpyHeader(const InputFile& file, std::uint64_t& dataOffset);

/// Returns the bytes before the data of a file of version 1; the data start at a multiple of 64
/// bytes.
std::string npyFileStart(const std::string& descr, const std::vector<std::int64_t>& shape);

} // namespace tipp

#endif
