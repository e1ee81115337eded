// SPDX-License-Identifier: BSD-3-Clause
#include "Mutate.h"

#include <algorithm>
#include <cctype>

namespace tipp
{
namespace test
{
namespace
{

/// Numbers that are likely to break the handling of counts and offsets.
const char* const hardNumbers[] = { "0", "1", "-1", "2", "3", "7", "255", "65536", "2147483647",
  "2147483648", "4294967295", "4294967296", "9223372036854775807", "9223372036854775808",
  "18446744073709551615", "99999999999999999999", "1e3", "", " ", "0x10" };

void replaceNumber(std::string& bytes, std::size_t at, std::mt19937_64& random)
{
  const auto isDigit = [](unsigned char c) { return std::isdigit(c) != 0; };
  const auto first = std::find_if(bytes.begin() + std::ptrdiff_t(at), bytes.end(), isDigit);
  const auto last = std::find_if_not(first, bytes.end(), isDigit);
  constexpr std::size_t count = sizeof(hardNumbers) / sizeof(hardNumbers[0]);
  bytes.replace(first, last, hardNumbers[random() % count]);
}

void mutateOnce(std::string& bytes, std::size_t header, std::mt19937_64& random)
{
  if (bytes.empty())
  {
    return;
  }
  const std::size_t within = random() % 8 ? std::min(header, bytes.size()) : bytes.size();
  const std::size_t at = random() % std::max<std::size_t>(within, 1);
  const std::size_t size = 1 + random() % 24;
  switch (random() % 8)
  {
    case 0:
      bytes[at] = char(bytes[at] ^ (1 << random() % 8));
      break;
    case 1:
      bytes[at] = char(random());
      break;
    case 2:
    case 3:
      replaceNumber(bytes, at, random);
      break;
    case 4:
      bytes.erase(at, size);
      break;
    case 5:
      bytes.insert(at, bytes.substr(random() % bytes.size(), size));
      break;
    case 6:
      bytes.resize(
        random() % 2 ? at : bytes.size() - random() % std::min<std::size_t>(bytes.size(), 40));
      break;
    default:
      bytes.append(size, char(random()));
  }
}

} // namespace

std::string mutate(std::string bytes, std::size_t header, std::mt19937_64& random)
{
  for (std::uint64_t i = random() % 4 + 1; i > 0; --i)
  {
    mutateOnce(bytes, header, random);
  }
  return bytes;
}

} // namespace test
} // namespace tipp
