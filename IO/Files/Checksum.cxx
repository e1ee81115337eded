// SPDX-License-Identifier: BSD-3-Clause
#include "Files/Checksum.h"

#include "Files/InputFile.h"

// Compiled into this file, so that no library is needed.
#define XXH_INLINE_ALL
#include <xxhash.h>

#include <charconv>

namespace tipp
{

// In ChecksumAvx2.cxx: the same checksum, computed faster.
XXH64_hash_t checksumAvx2(const void* data, size_t bytes);
void updateChecksumAvx2(XXH3_state_t* state, const void* data, size_t bytes);

namespace
{

#ifdef TIPP_CHECKSUM_AVX2
const bool hasAvx2 = __builtin_cpu_supports("avx2") != 0;
#else
constexpr bool hasAvx2 = false;
#endif

} // namespace

struct Checksum::State
{
  XXH3_state_t Xxh3;
};

std::uint64_t checksumOf(const void* data, std::size_t bytes)
{
  return hasAvx2 ? checksumAvx2(data, bytes) : XXH3_64bits(data, bytes);
}

Checksum::Checksum()
  : Progress(std::make_unique<State>())
{
  XXH3_64bits_reset(&this->Progress->Xxh3);
}

Checksum::~Checksum() = default;

void Checksum::add(const void* data, std::size_t bytes)
{
  hasAvx2 ? updateChecksumAvx2(&this->Progress->Xxh3, data, bytes)
          : static_cast<void>(XXH3_64bits_update(&this->Progress->Xxh3, data, bytes));
}

std::uint64_t Checksum::finish()
{
  const std::uint64_t value = XXH3_64bits_digest(&this->Progress->Xxh3);
  XXH3_64bits_reset(&this->Progress->Xxh3);
  return value;
}

std::uint64_t fileChecksum(const std::string& path)
{
  const InputFile file(path);
  Checksum sum;
  file.readBlocks(
    0, file.size(), [&sum](const char* data, std::size_t bytes) { sum.add(data, bytes); });
  return sum.finish();
}

std::string checksumText(std::uint64_t checksum)
{
  std::string text(16, '0');
  for (std::size_t i = text.size(); i > 0; checksum >>= 4)
  {
    text[--i] = "0123456789abcdef"[checksum & 15];
  }
  return text;
}

bool parseChecksum(const std::string& text, std::uint64_t& checksum)
{
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, checksum, 16);
  return stop == end && error == std::errc() && checksumText(checksum) == text;
}

} // namespace tipp
