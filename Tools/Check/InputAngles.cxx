// SPDX-License-Identifier: BSD-3-Clause
#include "Check/InputAngles.h"

#include "Check/ExactVector.h"

#include <algorithm>
#include <array>
#include <tuple>

namespace tipp
{
namespace check
{

void InputAngles::add(Position a, Position b, const std::vector<std::int64_t>& chain)
{
  for (std::size_t place = 0; place < chain.size(); ++place)
  {
    if (chain[place] != MeshEdges::None)
    {
      this->Passings.push_back({ chain[place], this->Segments.size(), place });
    }
  }
  this->Segments.push_back({ a, b });
}

void InputAngles::finish()
{
  std::sort(this->Passings.begin(), this->Passings.end(),
    [](const Passing& a, const Passing& b)
    { return std::tie(a.Vertex, a.Segment) < std::tie(b.Vertex, b.Segment); });
  this->MeetingsOf.assign(this->Segments.size(), {});
  for (auto first = this->Passings.begin(), last = first; first != this->Passings.end();
       first = last)
  {
    last = std::find_if(first, this->Passings.end(),
      [first](const Passing& passing) { return passing.Vertex != first->Vertex; });
    for (auto passing = first; last - first > 1 && passing != last; ++passing)
    {
      this->MeetingsOf[passing->Segment].push_back(*passing);
    }
  }
}

bool InputAngles::explain(std::int64_t a, std::int64_t b, std::int64_t c) const
{
  const auto square = [this](const std::array<std::int64_t, 2>& edge)
  { return ExactVector(this->Mesh.at(edge[0]), this->Mesh.at(edge[1])).square(); };
  std::array<std::array<std::int64_t, 2>, 3> edges{ { { a, b }, { b, c }, { c, a } } };
  const ExactNumber shortest = std::min({ square(edges[0]), square(edges[1]), square(edges[2]) });
  return std::any_of(edges.begin(), edges.end(),
    [&](const auto& edge) { return square(edge) == shortest && this->joins(edge[0], edge[1]); });
}

std::vector<InputAngles::Passing> InputAngles::passingsOf(std::int64_t vertex) const
{
  const auto first = std::lower_bound(this->Passings.begin(), this->Passings.end(), vertex,
    [](const Passing& passing, std::int64_t wanted) { return passing.Vertex < wanted; });
  const auto last = std::find_if(first, this->Passings.end(),
    [vertex](const Passing& passing) { return passing.Vertex != vertex; });
  return { first, last };
}

bool InputAngles::joins(std::int64_t p, std::int64_t q) const
{
  const std::vector<Passing> ofP = this->passingsOf(p);
  const std::vector<Passing> ofQ = this->passingsOf(q);
  const auto isOn = [](const std::vector<Passing>& passings, std::size_t segment)
  {
    return std::any_of(passings.begin(), passings.end(),
      [segment](const Passing& passing) { return passing.Segment == segment; });
  };
  return std::any_of(ofP.begin(), ofP.end(),
    [&](const Passing& atP)
    {
      // Where segments overlap, two points of one segment are no points of two that meet.
      return !isOn(ofQ, atP.Segment) &&
        std::any_of(ofQ.begin(), ofQ.end(),
          [&](const Passing& atQ)
          { return !isOn(ofP, atQ.Segment) && this->meetAtSmallAngle(atP, atQ); });
    });
}

bool InputAngles::meetAtSmallAngle(const Passing& p, const Passing& q) const
{
  // Rounding has moved the points; the directions of the segments have not been rounded.
  const auto towards = [this](const Passing& point, std::size_t meeting)
  {
    const Segment& segment = this->Segments[point.Segment];
    return point.Place > meeting ? ExactVector(segment.A, segment.B)
                                 : ExactVector(segment.B, segment.A);
  };
  const Meetings& others = this->MeetingsOf[q.Segment];
  const auto isBefore = [](const Passing& a, std::int64_t vertex) { return a.Vertex < vertex; };
  for (const Passing& meeting : this->MeetingsOf[p.Segment])
  {
    const auto other = std::lower_bound(others.begin(), others.end(), meeting.Vertex, isBefore);
    if (other == others.end() || other->Vertex != meeting.Vertex)
    {
      continue;
    }
    const ExactVector u = towards(p, meeting.Place);
    const ExactVector v = towards(q, other->Place);
    const ExactNumber dot = u.dot(v);
    // The cosine of 60 degrees is 1/2.
    if (dot > 0 && u.cross(v) != 0 && 4 * dot * dot > u.square() * v.square())
    {
      return true;
    }
  }
  return false;
}

} // namespace check
} // namespace tipp
