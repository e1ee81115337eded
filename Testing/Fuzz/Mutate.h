// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippMutate_h
#define tippMutate_h

#include <random>
#include <string>

namespace tipp
{
namespace test
{

/// Changes a file's bytes in one to four ways, mostly in its first `header` bytes: changes bits,
/// bytes, digits or whole numbers; duplicates, moves or removes parts; truncates or extends the
/// end.
std::string mutate(std::string bytes, std::size_t header, std::mt19937_64& random);

} // namespace test
} // namespace tipp

#endif
