// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippBoxTree_h
#define tippBoxTree_h

#include "Locate/MortonOrder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <vector>

namespace tipp
{

/// Finds which of many boxes meet a box: a packed R-tree (Kamel and Faloutsos, On Packing R-trees,
/// 1993) over the boxes in the order of their centres along the Morton curve. A node has the bounds
/// of eight children, relative to the centre of all, in single precision, rounded outward. Takes
/// about 23 bytes a box in 2D, 31 in 3D. Several threads may search at once.
template <int D>
class BoxTree
{
public:
  BoxTree() = default;

  /// `boxOf(i)` returns box i of `count`, at most 2^31 - 1; it is called several times for each, by
  /// several threads. Boxes that are empty, or have bounds that are infinite or NaN, are left out.
  /// Throws std::length_error if there are too many boxes.
  template <typename BoxOf>
  BoxTree(std::int64_t count, int threads, const BoxOf& boxOf)
  {
    if (count > std::numeric_limits<std::int32_t>::max())
    {
      throw std::length_error("A search tree can hold 2147483647 boxes at most.");
    }
    const Box<D> all = boundsOf<D>(count, threads, boxOf);
    if (!all.isEmpty())
    {
      for (int axis = 0; axis < D; ++axis)
      {
        this->Centre[axis] = all.Low[axis] / 2 + all.High[axis] / 2;
      }
      this->Order = mortonOrder(count, threads, all, boxOf);
      this->makeNodes(threads, boxOf);
    }
  }

  /// Calls visit(i) for each box i that meets `box`, in an order that depends on the boxes alone.
  /// Some are visited that do not meet it, but are near in single precision.
  template <typename Visit>
  void search(const Box<D>& box, const Visit& visit) const
  {
    if (this->Levels.empty())
    {
      return;
    }
    float low[D];
    float high[D];
    this->roundOutward(box, low, high);
    struct Child
    {
      int Level;
      std::int32_t Number;
    };
    std::array<Child, Width * MostLevels> stack;
    std::size_t top = 0;
    stack[top++] = { int(this->Levels.size()) - 1, 0 };
    while (top > 0)
    {
      const Child at = stack[--top];
      unsigned met = this->Levels[std::size_t(at.Level)][std::size_t(at.Number)].met(low, high);
      for (; met != 0; met &= met - 1)
      {
        const std::int32_t child = at.Number * Width + __builtin_ctz(met);
        if (at.Level == 0)
        {
          visit(this->Order[std::size_t(child)]);
        }
        else
        {
          stack[top++] = { at.Level - 1, child };
        }
      }
    }
  }

private:
  static constexpr int Width = 8;
  static constexpr int MostLevels = 11; // 8^11 > 2^31

  struct alignas(32) Node
  {
    float Low[D][Width];
    float High[D][Width];

    /// The children that meet a box, a bit each.
    unsigned met(const float (&low)[D], const float (&high)[D]) const
    {
      unsigned bits = 0;
      for (int part = 0; part < Width; part += 4)
      {
        Ints hits = this->four(this->Low[0], part) <= high[0];
        hits &= this->four(this->High[0], part) >= low[0];
        for (int axis = 1; axis < D; ++axis)
        {
          hits &= this->four(this->Low[axis], part) <= high[axis];
          hits &= this->four(this->High[axis], part) >= low[axis];
        }
        bits |= signsOf(hits) << part;
      }
      return bits;
    }

  private:
    using Floats = float __attribute__((vector_size(16)));
    using Ints = std::int32_t __attribute__((vector_size(16)));

    static Floats four(const float (&values)[Width], int part)
    {
      Floats result;
      std::memcpy(&result, values + part, sizeof result);
      return result;
    }

    static unsigned signsOf(const Ints& mask)
    {
#ifdef __SSE__
      Floats bits;
      std::memcpy(&bits, &mask, sizeof bits);
      return unsigned(__builtin_ia32_movmskps(bits));
#else
      return (mask[0] & 1u) | (mask[1] & 2u) | (mask[2] & 4u) | (mask[3] & 8u);
#endif
    }
  };

  template <typename BoxOf>
  void makeNodes(int threads, const BoxOf& boxOf)
  {
    const auto nodesFor = [](std::size_t children) { return (children + Width - 1) / Width; };
    this->Levels.emplace_back(nodesFor(this->Order.size()));
    forChunks(std::int64_t(this->Levels[0].size()), 1 << 11, threads, {},
      [&](std::int64_t begin, std::int64_t end, int)
      {
        for (std::int64_t n = begin; n < end; ++n)
        {
          this->fill(this->Levels[0][std::size_t(n)], std::size_t(n), this->Order.size(),
            [&](std::size_t child, float(&low)[D], float(&high)[D])
            { this->roundOutward(boxOf(this->Order[child]), low, high); });
        }
      });
    while (this->Levels.back().size() > 1)
    {
      const std::vector<Node>& below = this->Levels.back();
      std::vector<Node> nodes(nodesFor(below.size()));
      for (std::size_t n = 0; n < nodes.size(); ++n)
      {
        this->fill(nodes[n], n, below.size(),
          [&](std::size_t child, float(&low)[D], float(&high)[D])
          {
            for (int axis = 0; axis < D; ++axis)
            {
              for (int i = 0; i < Width; ++i) // fmin() and fmax() pass over NaN
              {
                low[axis] = std::fmin(low[axis], below[child].Low[axis][i]);
                high[axis] = std::fmax(high[axis], below[child].High[axis][i]);
              }
            }
          });
      }
      this->Levels.push_back(std::move(nodes));
    }
  }

  /// Fills node `n` with the bounds of its children among `children`; NaN, which meets nothing,
  /// where there is none.
  template <typename BoundsOf>
  static void fill(Node& node, std::size_t n, std::size_t children, const BoundsOf& boundsOf)
  {
    for (int i = 0; i < Width; ++i)
    {
      float low[D];
      float high[D];
      std::fill_n(low, D, std::numeric_limits<float>::quiet_NaN());
      std::fill_n(high, D, std::numeric_limits<float>::quiet_NaN());
      const std::size_t child = n * Width + std::size_t(i);
      child < children ? boundsOf(child, low, high) : void();
      for (int axis = 0; axis < D; ++axis)
      {
        node.Low[axis][i] = low[axis];
        node.High[axis][i] = high[axis];
      }
    }
  }

  /// One unit outward covers the rounding to single precision and that of the difference before.
  void roundOutward(const Box<D>& box, float (&low)[D], float (&high)[D]) const
  {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    for (int axis = 0; axis < D; ++axis)
    {
      low[axis] = std::nextafter(float(box.Low[axis] - this->Centre[axis]), -infinity);
      high[axis] = std::nextafter(float(box.High[axis] - this->Centre[axis]), infinity);
    }
  }

  std::array<double, D> Centre{};
  std::vector<std::int32_t> Order; ///< box numbers along the curve
  std::vector<std::vector<Node>>
    Levels; ///< the first one's children are boxes; the last is one node
};

} // namespace tipp

#endif
