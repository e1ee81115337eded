// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDamagePiece_h
#define tippDamagePiece_h

#include "TemporaryFolder.h"

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <ios>
#include <string>

namespace tipp
{
namespace test
{

/// Changes a bit of an array's first value in the file of a piece.
inline void damagePiece(const std::string& path, const std::string& array)
{
  std::string content = contentOf(path);
  const std::string key = "offset=\"";
  const std::size_t at = content.find(key, content.find("Name=\"" + array + "\"")) + key.size();
  const std::size_t data = content.find('_', content.find("encoding=\"raw\"")) + 1;
  content[data + std::stoull(content.substr(at)) + sizeof(std::uint64_t)] ^= 1;
  std::ofstream(path, std::ios::binary) << content;
}

} // namespace test
} // namespace tipp

#endif
