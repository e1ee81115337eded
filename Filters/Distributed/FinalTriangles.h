// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippFinalTriangles_h
#define tippFinalTriangles_h

#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <utility>
#include <vector>

namespace tipp
{

/// A triangle by its vertices' ids.
using IdTriangle = std::array<std::int64_t, 3>;

/// Triangles that nothing changes any more, as they come. In blocks that stay where they are: a
/// master has no time to move what it is done with.
class FinalTriangles
{
public:
  void push_back(const IdTriangle& triangle)
  {
    if (this->Blocks.empty() || this->Blocks.back().size() == BlockSize)
    {
      this->Blocks.emplace_back().reserve(BlockSize);
    }
    this->Blocks.back().push_back(triangle);
  }

  void append(FinalTriangles&& others)
  {
    std::move(others.Blocks.begin(), others.Blocks.end(), std::back_inserter(this->Blocks));
    others.Blocks.clear();
  }

  template <typename Visit>
  void visit(Visit&& visit) const
  {
    for (const std::vector<IdTriangle>& block : this->Blocks)
    {
      for (const IdTriangle& triangle : block)
      {
        visit(triangle);
      }
    }
  }

private:
  static constexpr std::size_t BlockSize = 4096;

  std::vector<std::vector<IdTriangle>> Blocks;
};

} // namespace tipp

#endif
