// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippXmlDataCheck_h
#define tippXmlDataCheck_h

#include "Files/InputFile.h"

#include <cstdint>
#include <string_view>
#include <vector>

namespace tipp
{

/// Checks that the arrays of a VTK XML file are complete. VTK's readers do not: if text is not
/// base64, or ends early, they leave values uninitialised.
class XmlDataCheck
{
public:
  /// Attributes of the file's VTKFile element.
  bool IsCompressed = false;
  bool IsBigEndian = false;
  std::uint64_t HeaderBytes = 4; ///< of the number of bytes before each array

  /// Checks an array in base64 between its tags.
  bool isWholeText(std::string_view text) const;

  /// Checks the arrays at these offsets after the '_' at byte `begin`.
  bool areWhole(const InputFile& file, std::uint64_t begin, bool isEncoded,
    std::vector<std::uint64_t> offsets) const;

private:
  template <typename Text>
  bool isWhole(const Text& text) const;
  std::uint64_t number(const unsigned char* bytes) const;
  bool isWholeRaw(const InputFile& file, std::uint64_t begin, std::uint64_t end) const;
  bool isWholeEncoded(const InputFile& file, std::uint64_t begin, std::uint64_t end) const;
};

} // namespace tipp

#endif
