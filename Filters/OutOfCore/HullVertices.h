// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippHullVertices_h
#define tippHullVertices_h

#include "Distributed/SeamGroups.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace tipp
{

/// The true vertices of final triangles at artificial points: all that the hull's repair needs of
/// them. Each has two such triangles or more, so now and then those that came again are dropped.
class HullVertices
{
public:
  void add(const PlainVertex& v)
  {
    if (this->Vertices.size() >= this->Different + this->Different / 4 + someVertices)
    {
      this->dropRepeated();
    }
    this->Vertices.push_back(v);
  }

  /// All, each once, by id; none are left.
  std::vector<PlainVertex> take()
  {
    this->dropRepeated();
    this->Different = 0;
    return std::exchange(this->Vertices, {});
  }

  /// Shows what is kept to an archive, to save or to restore it.
  template <typename Archive>
  void exchange(Archive& archive)
  {
    archive(this->Vertices);
  }

private:
  static constexpr std::size_t someVertices = 4096;

  void dropRepeated()
  {
    std::sort(this->Vertices.begin(), this->Vertices.end(),
      [](const PlainVertex& a, const PlainVertex& b) { return a.Id < b.Id; });
    this->Vertices.erase(std::unique(this->Vertices.begin(), this->Vertices.end(),
                           [](const PlainVertex& a, const PlainVertex& b) { return a.Id == b.Id; }),
      this->Vertices.end());
    this->Different = this->Vertices.size();
  }

  std::vector<PlainVertex> Vertices;
  std::size_t Different = 0; ///< when repeated ones were last dropped
};

} // namespace tipp

#endif
