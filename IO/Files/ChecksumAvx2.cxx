// SPDX-License-Identifier: BSD-3-Clause
// The checksums of Checksum.cxx, compiled for processors with AVX2. No other header may be included
// here: its inline functions would be compiled with AVX2 as well, and the linker might use them
// everywhere.
#define XXH_INLINE_ALL
#include <xxhash.h>

namespace tipp
{

XXH64_hash_t checksumAvx2(const void* data, size_t bytes);
void updateChecksumAvx2(XXH3_state_t* state, const void* data, size_t bytes);

XXH64_hash_t checksumAvx2(const void* data, size_t bytes)
{
  return XXH3_64bits(data, bytes);
}

void updateChecksumAvx2(XXH3_state_t* state, const void* data, size_t bytes)
{
  XXH3_64bits_update(state, data, bytes);
}

} // namespace tipp
