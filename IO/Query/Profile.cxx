// SPDX-License-Identifier: BSD-3-Clause
#include "Arrays/SortUnique.h"
#include "Files/IOError.h"
#include "Query/ForPieces.h"
#include "Query/Lines.h"
#include "Query/RankAnswer.h"
#include "Query/SegmentCrossings.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace tipp
{
namespace
{

double distance(const Point3& a, const Point3& b)
{
  return a.z == b.z ? std::hypot(b.x - a.x, b.y - a.y)
                    : std::hypot(b.x - a.x, b.y - a.y, b.z - a.z);
}

/// Writes a value to an array of the answer, in the array's type.
void put(MeshAnswer::Array& array, std::size_t at, double value)
{
  withScalar(array.Type,
    [&](auto zero)
    {
      using Value = decltype(zero);
      array.Values.as<Value>()[at] = toScalar<Value>(value);
    });
}

void addSamples(const Point3& a, const Point3& b, double before, double spacing, Profile& profile)
{
  const double length = distance(a, b);
  // The multiples of the spacing inside the segment.
  for (auto i = std::int64_t(std::floor(before / spacing)) + 1;
       double(i) * spacing < before + length; ++i)
  {
    const double along = double(i) * spacing - before;
    const double share = along / length;
    profile.Distances.push_back(double(i) * spacing);
    profile.Points.push_back(between(a, b, share));
  }
}

void requirePolyline(const std::vector<Point3>& polyline, double spacing)
{
  double length = 0;
  for (std::size_t i = 0; i < polyline.size(); ++i)
  {
    if (!std::isfinite(polyline[i].x) || !std::isfinite(polyline[i].y) ||
      !std::isfinite(polyline[i].z))
    {
      throw IOError("Point " + std::to_string(i) + " of the polyline is not finite.");
    }
    length += i > 0 ? distance(polyline[i - 1], polyline[i]) : 0;
  }
  constexpr double most = 1e9;
  if (!(spacing >= 0) || (spacing > 0 && !(length / spacing < most)))
  {
    throw IOError("The spacing of the profile, " + std::to_string(spacing) +
      ", is negative or would give more than 1e9 samples; give a larger one, or 0 for all "
      "crossings.");
  }
}

using Crossings = std::vector<std::vector<Crossing>>;

/// The crossings of a polyline with the meshes of all ranks.
Crossings crossingsOf(const ResidentMesh& mesh, const std::vector<Point3>& own,
  const std::vector<std::string>& arrays, Communicator* ranks)
{
  const auto [first, end] = piecesOfRank(ranks, mesh);
  if (!ranks)
  {
    return crossingsIn(mesh, own, arrays, first, end);
  }
  std::vector<Crossings> replies;
  for (const std::vector<Point3>& corners : ranks->allGather(own))
  {
    replies.push_back(
      canQuery(ranks, mesh) ? crossingsIn(mesh, corners, arrays, first, end) : Crossings());
  }
  Crossings result(own.size());
  for (const Crossings& part : ranks->allToAll(replies))
  {
    for (std::size_t i = 0; i < part.size(); ++i)
    {
      result[i].insert(result[i].end(), part[i].begin(), part[i].end());
    }
  }
  std::for_each(result.begin(), result.end(), sortUnique<Crossing>);
  return result;
}

} // namespace

Profile profileOf(const ResidentMesh& mesh, const std::vector<Point3>& given, double spacing,
  const std::vector<std::string>& arrays, Communicator* ranks)
{
  requireIds(ranks, mesh);
  const bool inSpace = RankParts(ranks, mesh, arrays).Common.CellSize == 4;
  AnswerOptions options;
  options.Arrays = arrays;
  const auto answer = [&](const std::vector<Point3>& points)
  { return answerOf(mesh, points.data(), std::int64_t(points.size()), options, ranks); };
  std::vector<Point3> polyline;
  for (const Point3& p : given)
  {
    const Point3 corner{ p.x, p.y, inSpace ? p.z : 0 };
    polyline.empty() || !(polyline.back() == corner) ? polyline.push_back(corner) : void();
  }
  requirePolyline(polyline, spacing);
  Profile profile;
  Crossings crossings = spacing == 0 ? crossingsOf(mesh, polyline, arrays, ranks) : Crossings();
  crossings.resize(polyline.size());
  std::vector<const Crossing*> found; // per point of the profile; null for others
  double before = 0;
  for (std::size_t i = 0; i < polyline.size(); ++i)
  {
    profile.Distances.push_back(before);
    profile.Points.push_back(polyline[i]);
    found.push_back(nullptr);
    const double length = i + 1 < polyline.size() ? distance(polyline[i], polyline[i + 1]) : 0;
    for (const Crossing& crossing : crossings[i])
    {
      // Corners of the polyline are added anyway.
      if (!(crossing.At == polyline[i]) && !(crossing.At == polyline[i + 1]))
      {
        profile.Distances.push_back(before + crossing.Share * length);
        profile.Points.push_back(crossing.At);
        found.push_back(&crossing);
      }
    }
    length > 0 && spacing > 0 ? addSamples(polyline[i], polyline[i + 1], before, spacing, profile)
                              : void();
    before += length;
  }
  if (spacing > 0)
  {
    profile.Answer = answer(profile.Points);
    return profile;
  }
  // Cells and cell values are those at the middles between points; point values are those of the
  // crossings.
  std::vector<Point3> middles = profile.Points;
  for (std::size_t i = 0; i + 1 < middles.size(); ++i)
  {
    const Point3& a = profile.Points[i];
    const Point3& b = profile.Points[i + 1];
    middles[i] = { (a.x + b.x) / 2, (a.y + b.y) / 2, (a.z + b.z) / 2 };
  }
  profile.Answer = answer(middles);
  const MeshAnswer corners = answer(profile.Points);
  for (std::size_t i = 0; i < profile.Points.size(); ++i)
  {
    std::size_t k = 0;
    for (std::size_t a = 0; a < profile.Answer.Arrays.size(); ++a) // none if no rank has cells
    {
      MeshAnswer::Array& values = profile.Answer.Arrays[a];
      if (!values.OfPoints)
      {
        continue;
      }
      const auto components = std::size_t(values.Components);
      for (std::size_t c = 0; c < components && found[i]; ++c)
      {
        put(values, i * components + c, found[i]->Values[k + c]);
      }
      k += components;
      if (!found[i])
      {
        const std::size_t bytes = values.tupleBytes();
        std::memcpy(
          values.Values.data() + i * bytes, corners.Arrays[a].Values.data() + i * bytes, bytes);
      }
    }
  }
  return profile;
}

} // namespace tipp
