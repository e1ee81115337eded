// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippBoxTree_h
#define tippBoxTree_h

#include "Locate/MortonOrder.h"
#include "Predicates/Geometry.h"

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

/// Finds which of many boxes meet a given box: a packed R-tree (Kamel and Faloutsos, On Packing
/// R-trees, 1993) over the boxes, sorted by their centres along the Morton curve. A node stores the
/// bounds of eight children in single precision, relative to the centre of all boxes and rounded
/// outward. The tree takes about 23 bytes per box in 2D, 31 in 3D. Several threads may search at
/// once.
template <int D>
class BoxTree
{
public:
  BoxTree() = default;

  /// `boxOf(i)` returns box i of `count`; it is called several times for each i, by several
  /// threads. Boxes that are empty or have infinite or NaN bounds are left out. Throws
  /// std::length_error if there are more than 2^31 - 1 boxes.
  template <typename BoxOf>
  BoxTree(std::int64_t count, int threads, const BoxOf& boxOf)
  {
    if (count > std::numeric_limits<std::int32_t>::max())
    {
      throw std::length_error("A search tree can hold 2147483647 boxes at most.");
    }
    const Box<D> all = boundsOf<D>(count, threads, boxOf);
    if (isFinite(all))
    {
      this->Centre = all.center();
      this->Order = mortonOrder(count, threads, all, boxOf);
      this->makeNodes(threads, boxOf);
    }
  }

  /// Calls visit(i) for each box i that meets `box`, in an order that depends on the boxes alone.
  /// Because of single precision it may also visit boxes that miss it narrowly.
  template <typename Visit>
  void search(const Box<D>& box, const Visit& visit) const
  {
    this->forMet(box,
      [&](const Node&, int, std::int32_t entry)
      {
        visit(this->Order[std::size_t(entry)]);
        return true;
      });
  }

  /// Calls visit(i) for boxes, nearest to the point first. visit() returns the distance up to which
  /// boxes are still of interest, `wanted` before the first call; every nearer box is visited.
  template <typename Visit>
  void searchNear(const Point<D>& point, const Visit& visit,
    double wanted = std::numeric_limits<double>::infinity()) const
  {
    struct Child
    {
      double Distance;
      int Level;
      std::int32_t Number;
    };
    std::array<Child, (Width - 1) * MostLevels + Width> stack;
    std::size_t top = 0;
    if (!this->Levels.empty())
    {
      stack[top++] = { 0, int(this->Levels.size()) - 1, 0 };
    }
    while (top > 0)
    {
      const Child at = stack[--top];
      if (at.Distance > wanted)
      {
        continue;
      }
      if (at.Level < 0)
      {
        wanted = visit(this->Order[std::size_t(at.Number)]);
        continue;
      }
      const Node& node = this->Levels[std::size_t(at.Level)][std::size_t(at.Number)];
      const std::size_t first = top;
      for (int child = 0; child < Width; ++child)
      {
        const double distance = this->distanceTo(node, child, point);
        if (distance <= wanted) // false for NaN: there is no child
        {
          std::size_t to = top++;
          for (; to > first && stack[to - 1].Distance < distance; --to)
          {
            stack[to] = stack[to - 1];
          }
          stack[to] = { distance, at.Level - 1, at.Number * Width + child };
        }
      }
    }
  }

  /// The boxes that meet a region, for repeated searches within it.
  struct alignas(16) Gathered
  {
    static constexpr int Most = 256;
    int Count = 0;
    std::array<std::int32_t, Most + 4> Numbers;
    float Low[D][Most + 4];
    float High[D][Most + 4];
  };

  /// Gathers the boxes that meet a region. Returns false if there are too many.
  bool gather(const Box<D>& region, Gathered& to) const
  {
    to.Count = 0;
    const bool isWhole = this->forMet(region,
      [&](const Node& node, int child, std::int32_t entry)
      {
        if (to.Count == Gathered::Most)
        {
          return false;
        }
        for (int axis = 0; axis < D; ++axis)
        {
          to.Low[axis][to.Count] = node.Low[axis][child];
          to.High[axis][to.Count] = node.High[axis][child];
        }
        to.Numbers[std::size_t(to.Count++)] = this->Order[std::size_t(entry)];
        return true;
      });
    for (int axis = 0; axis < D; ++axis) // completes the last four
    {
      std::fill_n(to.Low[axis] + to.Count, 4, std::numeric_limits<float>::quiet_NaN());
    }
    return isWhole;
  }

  /// Calls visit(i) for each gathered box i that meets `box`, which must be inside the region for
  /// which the boxes were gathered. May also visit boxes that miss it narrowly.
  template <typename Visit>
  void search(const Gathered& gathered, const Box<D>& box, const Visit& visit) const
  {
    float low[D];
    float high[D];
    this->roundOutward(box, low, high);
    for (int part = 0; part < gathered.Count; part += 4)
    {
      for (unsigned met = metOf(gathered, part, low, high); met != 0; met &= met - 1)
      {
        visit(gathered.Numbers[std::size_t(part) + std::size_t(__builtin_ctz(met))]);
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
  };

  using Floats = float __attribute__((vector_size(16)));
  using Ints = std::int32_t __attribute__((vector_size(16)));

  static Floats four(const float* values)
  {
    Floats result;
    std::memcpy(&result, values, sizeof result);
    return result;
  }

  /// Returns a bit mask: which of four boxes of a node, or of gathered boxes, meet a box.
  template <typename Boxes>
  static unsigned metOf(
    const Boxes& boxes, int first, const float (&low)[D], const float (&high)[D])
  {
    Ints hits = four(boxes.Low[0] + first) <= high[0];
    hits &= four(boxes.High[0] + first) >= low[0];
    for (int axis = 1; axis < D; ++axis)
    {
      hits &= four(boxes.Low[axis] + first) <= high[axis];
      hits &= four(boxes.High[axis] + first) >= low[axis];
    }
#ifdef __SSE__
    Floats bits;
    std::memcpy(&bits, &hits, sizeof bits);
    return unsigned(__builtin_ia32_movmskps(bits));
#else
    return (hits[0] & 1u) | (hits[1] & 2u) | (hits[2] & 4u) | (hits[3] & 8u);
#endif
  }

  /// A lower bound of the distance of a point from a child's box.
  double distanceTo(const Node& node, int child, const Point<D>& point) const
  {
    double squared = 0;
    double largest = 0;
    for (std::size_t axis = 0; axis < D; ++axis)
    {
      const double at = point[axis] - this->Centre[axis];
      const double low = double(node.Low[axis][child]) - at;
      const double high = at - double(node.High[axis][child]);
      const double apart = std::max(low > high ? low : high, 0.0);
      squared += low == low ? apart * apart : low;
      largest = std::max(largest, std::fabs(at));
    }
    return std::sqrt(squared) * (1 - 1e-14) - largest * 1e-15;
  }

  /// Calls visit(node, child, entry) for each stored box that meets `box`, until visit() returns
  /// false; Order[entry] is the stored box's number. Returns false if visit() did.
  template <typename Visit>
  bool forMet(const Box<D>& box, const Visit& visit) const
  {
    if (this->Levels.empty())
    {
      return true;
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
      const Node& node = this->Levels[std::size_t(at.Level)][std::size_t(at.Number)];
      unsigned met = metOf(node, 0, low, high) | metOf(node, 4, low, high) << 4;
      for (; met != 0; met &= met - 1)
      {
        const int child = __builtin_ctz(met);
        const std::int32_t entry = at.Number * Width + child;
        if (at.Level > 0)
        {
          stack[top++] = { at.Level - 1, entry };
        }
        else if (!visit(node, child, entry))
        {
          return false;
        }
      }
    }
    return true;
  }

  template <typename BoxOf>
  void makeNodes(int threads, const BoxOf& boxOf)
  {
    const auto nodesFor = [](std::size_t children) { return (children + Width - 1) / Width; };
    this->Levels.emplace_back(nodesFor(this->Order.size()));
    forIndices(
      std::int64_t(this->Levels[0].size()),
      [&](std::int64_t n)
      {
        this->fill(this->Levels[0][std::size_t(n)], std::size_t(n), this->Order.size(),
          [&](std::size_t child, float(&low)[D], float(&high)[D])
          { this->roundOutward(boxOf(this->Order[child]), low, high); });
      },
      threads, 1 << 11);
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
              for (int i = 0; i < Width; ++i) // fmin() and fmax() ignore NaN
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

  /// Fills node `n` with the bounds of its children, of the `children` on the level below. Missing
  /// children get NaN bounds, which meet nothing.
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
      if (child < children)
      {
        boundsOf(child, low, high);
      }
      for (int axis = 0; axis < D; ++axis)
      {
        node.Low[axis][i] = low[axis];
        node.High[axis][i] = high[axis];
      }
    }
  }

  /// Rounds outward by more than one ulp, which covers the rounding of the difference and of the
  /// conversion to single precision. The result stays finite where single precision would overflow.
  void roundOutward(const Box<D>& box, float (&low)[D], float (&high)[D]) const
  {
    constexpr double most = std::numeric_limits<float>::max();
    const auto rounded = [&](double value, int axis)
    { return float(std::min(std::max(value - this->Centre[axis], -most), most)); };
    const auto margin = [](float value)
    { return std::fabs(value) * 2.4e-7f + std::numeric_limits<float>::min(); };
    for (int axis = 0; axis < D; ++axis)
    {
      const float lowest = rounded(box.Min[axis], axis);
      const float highest = rounded(box.Max[axis], axis);
      low[axis] = lowest - margin(lowest);
      high[axis] = highest + margin(highest);
    }
  }

  Point<D> Centre{};
  std::vector<std::int32_t> Order; ///< box indices along the Morton curve
  std::vector<std::vector<Node>>
    Levels; ///< of the first level, the children are boxes; the last level is the root
};

} // namespace tipp

#endif
