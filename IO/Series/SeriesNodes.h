// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSeriesNodes_h
#define tippSeriesNodes_h

#include "Predicates/Geometry.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// Returns x and y of nodes, interleaved.
inline std::vector<double> interleaved(const std::vector<double>& x, const std::vector<double>& y)
{
  std::vector<double> xy(2 * x.size());
  for (std::size_t i = 0; i < x.size(); ++i)
  {
    xy[2 * i] = x[i];
    xy[2 * i + 1] = y[i];
  }
  return xy;
}

/// The nodes of a model's mesh: those of the file, and copies of them where a mesh is wrapped. They
/// are in blocks, whose memory is returned to the system block by block.
class SeriesNodes
{
public:
  std::int64_t size() const { return this->Count; }

  Point2 operator[](std::int64_t node) const
  {
    const double* const at =
      this->Blocks[std::size_t(node >> Shift)].data() + 2 * std::size_t(node & Mask);
    return { at[0], at[1] };
  }

  /// Adds nodes of the file, x and y interleaved, to be followed by `more` others.
  void add(const std::vector<double>& xy, std::int64_t more = 0)
  {
    const auto end = std::int64_t(xy.size() / 2);
    for (std::int64_t i = 0; i < end; ++i)
    {
      this->push({ xy[2 * std::size_t(i)], xy[2 * std::size_t(i) + 1] }, end - i + more);
    }
    this->FileNodes = this->Count;
  }

  /// Adds a copy of a node of the file, and returns its index.
  std::int64_t addCopy(std::int64_t of, Point2 position)
  {
    this->push(position, 1);
    this->CopyOf.push_back(of);
    return this->Count - 1;
  }

  /// The nodes of which those after the file's are copies.
  const std::vector<std::int64_t>& copies() const { return this->CopyOf; }

  /// The node of the file that has the values of a node.
  std::int64_t stored(std::int64_t node) const
  {
    return node < this->FileNodes ? node : this->CopyOf[std::size_t(node - this->FileNodes)];
  }

  /// Calls visit(node, position) for all nodes, and frees them.
  template <typename Visit>
  void consume(const Visit& visit)
  {
    for (std::int64_t node = 0; node < this->Count; ++node)
    {
      visit(node, (*this)[node]);
      if ((node & Mask) == Mask)
      {
        this->Blocks[std::size_t(node >> Shift)] = std::vector<double>();
      }
    }
    this->Blocks.clear();
    this->Count = 0;
  }

private:
  /// A block has 64 MB, above what the C library keeps for itself when it is freed.
  static constexpr int Shift = 22;
  static constexpr std::int64_t Mask = (std::int64_t(1) << Shift) - 1;

  void push(Point2 position, std::int64_t expected)
  {
    if ((this->Count & Mask) == 0)
    {
      this->Blocks.emplace_back().reserve(2 * std::size_t(std::min(expected, Mask + 1)));
    }
    this->Blocks.back().push_back(position.x);
    this->Blocks.back().push_back(position.y);
    ++this->Count;
  }

  std::vector<std::vector<double>> Blocks;
  std::int64_t Count = 0;
  std::int64_t FileNodes = 0;
  std::vector<std::int64_t> CopyOf;
};

} // namespace tipp

#endif
