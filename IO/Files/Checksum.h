// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippChecksum_h
#define tippChecksum_h

#include "vtkTIPPIOModule.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

namespace tipp
{

/// Returns the XXH3 checksum with 64 bits and no seed (https://github.com/Cyan4973/xxHash).
VTKTIPPIO_EXPORT std::uint64_t checksumOf(const void* data, std::size_t bytes);

/// Computes the checksum of checksumOf() from bytes that are added part by part.
class VTKTIPPIO_EXPORT Checksum
{
public:
  Checksum();
  ~Checksum();

  void add(const void* data, std::size_t bytes);
  /// Returns the checksum of all bytes since the last call, and resets the state.
  std::uint64_t finish();

private:
  struct State;
  std::unique_ptr<State> Progress;
};

/// Returns the checksum of a file's bytes. Throws IOError.
VTKTIPPIO_EXPORT std::uint64_t fileChecksum(const std::string& path);

/// Converts to 16 hexadecimal digits in lower case.
VTKTIPPIO_EXPORT std::string checksumText(std::uint64_t checksum);
/// The inverse of checksumText(). Returns false if the text is no checksum.
VTKTIPPIO_EXPORT bool parseChecksum(const std::string& text, std::uint64_t& checksum);

} // namespace tipp

#endif
