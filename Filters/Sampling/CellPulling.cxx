// SPDX-License-Identifier: BSD-3-Clause
#include "Sampling/CellPulling.h"

#include "vtkCellType.h"

#include <algorithm>

namespace tipp
{
namespace
{

using Corner = CellPulling::Corner;
using Face = CellPulling::Face;

/// The index in `face` of its lexicographically least corner.
std::size_t leastOf(const std::vector<Corner>& corners, const Face& face)
{
  const auto less = [&](int a, int b)
  { return lexicographicLess(corners[std::size_t(a)].Place, corners[std::size_t(b)].Place); };
  return std::size_t(std::min_element(face.begin(), face.end(), less) - face.begin());
}

Point3 crossProduct(Point3 a, Point3 b, Point3 c)
{
  const Point3 u{ b.x - a.x, b.y - a.y, b.z - a.z };
  const Point3 v{ c.x - a.x, c.y - a.y, c.z - a.z };
  return { u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x };
}

/// Whether the triangles abc and acd of a quad have the same orientation.
bool cutsInside(Point3 a, Point3 b, Point3 c, Point3 d)
{
  const Point3 u = crossProduct(a, b, c);
  const Point3 v = crossProduct(a, c, d);
  return u.x * v.x + u.y * v.y + u.z * v.z > 0;
}

} // namespace

const std::vector<Face>& CellPulling::facesOf(int cellType)
{
  static const std::vector<Face> none;
  static const std::vector<Face> hexahedron = { { 0, 4, 7, 3 }, { 1, 2, 6, 5 }, { 0, 1, 5, 4 },
    { 3, 7, 6, 2 }, { 0, 3, 2, 1 }, { 4, 5, 6, 7 } };
  static const std::vector<Face> voxel = { { 0, 2, 6, 4 }, { 1, 3, 7, 5 }, { 0, 1, 5, 4 },
    { 2, 3, 7, 6 }, { 0, 1, 3, 2 }, { 4, 5, 7, 6 } };
  static const std::vector<Face> wedge = { { 0, 1, 2 }, { 3, 5, 4 }, { 0, 3, 4, 1 }, { 1, 4, 5, 2 },
    { 2, 5, 3, 0 } };
  static const std::vector<Face> pyramid = { { 0, 3, 2, 1 }, { 0, 1, 4 }, { 1, 2, 4 }, { 2, 3, 4 },
    { 3, 0, 4 } };
  switch (cellType)
  {
    case VTK_HEXAHEDRON:
      return hexahedron;
    case VTK_VOXEL:
      return voxel;
    case VTK_WEDGE:
      return wedge;
    case VTK_PYRAMID:
      return pyramid;
    default:
      return none;
  }
}

void CellPulling::polygon(const std::vector<Corner>& corners, std::vector<std::int64_t>& ids)
{
  Face face(corners.size());
  for (std::size_t i = 0; i < face.size(); ++i)
  {
    face[i] = int(i);
  }
  std::rotate(face.begin(), face.begin() + std::ptrdiff_t(leastOf(corners, face)), face.end());
  const auto place = [&](std::size_t i) { return corners[std::size_t(face[i])].Place; };
  if (face.size() == 4 && !cutsInside(place(0), place(1), place(2), place(3)))
  {
    std::rotate(face.begin(), face.begin() + 1, face.end());
  }
  for (std::size_t i = 1; i + 1 < face.size(); ++i)
  {
    for (const std::size_t corner : { std::size_t(0), i, i + 1 })
    {
      ids.push_back(corners[std::size_t(face[corner])].Id);
    }
  }
}

void CellPulling::polyhedron(const std::vector<Corner>& corners, const std::vector<Face>& faces,
  std::vector<std::int64_t>& ids)
{
  Face all(corners.size());
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    all[i] = int(i);
  }
  const int apex = int(leastOf(corners, all));
  for (Face face : faces)
  {
    if (std::find(face.begin(), face.end(), apex) != face.end())
    {
      continue;
    }
    std::rotate(face.begin(), face.begin() + std::ptrdiff_t(leastOf(corners, face)), face.end());
    for (std::size_t i = 1; i + 1 < face.size(); ++i)
    {
      for (const int corner : { apex, face[0], face[i], face[i + 1] })
      {
        ids.push_back(corners[std::size_t(corner)].Id);
      }
    }
  }
}

} // namespace tipp
