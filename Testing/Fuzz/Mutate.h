// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippMutate_h
#define tippMutate_h

#include <random>
#include <string>

namespace tipp
{
namespace test
{

/// Changes a file's bytes in one to four ways, mostly within its first `header` bytes: bits and
/// bytes, digits and whole numbers, pieces doubled, moved or taken out, an end cut off or put on.
std::string mutate(std::string bytes, std::size_t header, std::mt19937_64& random);

} // namespace test
} // namespace tipp

#endif
