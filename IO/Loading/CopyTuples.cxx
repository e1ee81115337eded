// SPDX-License-Identifier: BSD-3-Clause
#include "Loading/CopyTuples.h"

#include <cstring>
#include <type_traits>

namespace tipp
{
namespace
{

template <std::size_t Bytes>
using Size = std::integral_constant<std::size_t, Bytes>;

/// Calls work(bytes), with a compile-time constant for the usual sizes.
template <typename Work>
void withSize(std::size_t bytes, const Work& work)
{
  switch (bytes)
  {
    case 1:
      return work(Size<1>());
    case 4:
      return work(Size<4>());
    case 8:
      return work(Size<8>());
    case 12:
      return work(Size<12>());
    case 16:
      return work(Size<16>());
    case 24:
      return work(Size<24>());
    default:
      return work(bytes);
  }
}

} // namespace

void scatterTuples(const char* from, const std::uint64_t* sources, char* to,
  const std::uint64_t* targets, std::size_t count, std::size_t bytes)
{
  withSize(bytes,
    [=](auto size)
    {
      for (std::size_t i = 0; i < count; ++i)
      {
        std::memcpy(to + targets[i] * size, from + sources[i] * size, size);
      }
    });
}

template <typename Source>
void gatherTuples(
  const char* from, const Source* sources, char* to, std::size_t count, std::size_t bytes)
{
  withSize(bytes,
    [=](auto size)
    {
      for (std::size_t i = 0; i < count; ++i)
      {
        std::memcpy(to + i * size, from + sources[i] * size, size);
      }
    });
}

template void gatherTuples(
  const char*, const std::uint16_t*, char*, std::size_t count, std::size_t bytes);
template void gatherTuples(
  const char*, const std::uint32_t*, char*, std::size_t count, std::size_t bytes);
template void gatherTuples(
  const char*, const std::uint64_t*, char*, std::size_t count, std::size_t bytes);

} // namespace tipp
