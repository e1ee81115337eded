// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippLazEncoder_h
#define tippLazEncoder_h

#include "Laz/LazFormat.h"
#include "vtkTIPPIOModule.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace tipp
{

/// Compresses chunks of points of formats 6 to 8, by layers. The bytes are those that LASzip makes
/// of the same points. Objects are independent of each other, so that threads encode chunks in
/// parallel; an object encodes one chunk after the other with the same memory.
class VTKTIPPIO_EXPORT LazChunkEncoder
{
public:
  /// `format` must be one of LazFormat::layered().
  explicit LazChunkEncoder(const LazFormat& format);
  ~LazChunkEncoder();
  LazChunkEncoder(LazChunkEncoder&&) noexcept;

  /// Appends the chunk of `count` records, one at least, to `bytes`.
  void encode(std::size_t count, const std::uint8_t* records, std::vector<std::uint8_t>& bytes);

private:
  class Items;
  std::unique_ptr<Items> Parts;
};

} // namespace tipp

#endif
