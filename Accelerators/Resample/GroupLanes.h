// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippGroupLanes_h
#define tippGroupLanes_h

#include "Resample/Lanes.h"

#include <cstdint>

namespace tipp
{

/// The corners of four cells in the lexicographic order of their coordinates, and by how much the
/// barycentric weights of all but the first rise along each axis.
///
/// Aligned for functions that are compiled for wider instructions than others.
template <typename Access>
struct alignas(32) GroupLanes
{
  static constexpr int D = Access::Dimension;

  /// Takes four cells.
  [[gnu::always_inline]] void set(const Access& access, const std::int32_t* cells)
  {
    for (int corner = 0; corner <= D; ++corner)
    {
      double p[laneCount][D];
      for (int lane = 0; lane < laneCount; ++lane)
      {
        const std::int64_t id = access.ids(cells[lane])[corner];
        this->Ids[corner][lane] = id;
        access.coordinates(id, p[lane]);
      }
      for (int axis = 0; axis < D; ++axis)
      {
        this->Corners[corner][axis] = Lanes{ p[0][axis], p[1][axis], p[2][axis], p[3][axis] };
      }
    }
    this->sort();
    this->findNormals();
  }

  LaneTruths Ids[D + 1];
  Lanes Corners[D + 1][D];
  Lanes Normals[D][D]; ///< of each corner but the first, along each axis
  LaneTruths Thin;     ///< where roundings would show in the Normals

private:
  [[gnu::always_inline]] void sort()
  {
    if constexpr (D == 2)
    {
      this->order(0, 1);
      this->order(1, 2);
      this->order(0, 1);
    }
    else
    {
      this->order(0, 1);
      this->order(2, 3);
      this->order(0, 2);
      this->order(1, 3);
      this->order(1, 2);
    }
  }

  /// Exchanges corners so that i comes before j.
  [[gnu::always_inline]] void order(int i, int j)
  {
    LaneTruths swap = {};
    for (int axis = D - 1; axis >= 0; --axis)
    {
      const Lanes a = this->Corners[i][axis];
      const Lanes b = this->Corners[j][axis];
      swap = (b < a) | ((b == a) & swap);
    }
    for (int axis = 0; axis < D; ++axis)
    {
      exchange(swap, this->Corners[i][axis], this->Corners[j][axis]);
    }
    exchange(swap, this->Ids[i], this->Ids[j]);
  }

  template <typename T>
  [[gnu::always_inline]] static void exchange(LaneTruths swap, T& a, T& b)
  {
    const T first = a;
    a = swap ? b : a;
    b = swap ? first : b;
  }

  [[gnu::always_inline]] void findNormals()
  {
    Lanes edges[D][D]; // of each corner but the first, from that
    Lanes product = allLanes(1);
    for (int axis = 0; axis < D; ++axis)
    {
      Lanes largest = {};
      for (int i = 0; i < D; ++i)
      {
        edges[i][axis] = this->Corners[i + 1][axis] - this->Corners[0][axis];
        largest = most(absolute(edges[i][axis]), largest);
      }
      product *= largest;
    }
    const Lanes determinant = this->cofactors(edges);
    // Thinner than that, the roundings of the determinants would show in the thirteenth digit.
    this->Thin = ~(absolute(determinant) * 64 > product) | (product < 1e-280);
    const Lanes inverse = 1 / determinant;
    for (int i = 0; i < D; ++i)
    {
      for (int axis = 0; axis < D; ++axis)
      {
        this->Normals[i][axis] *= inverse;
      }
    }
  }

  /// Makes the Normals the columns of the adjugate, and returns the determinant.
  [[gnu::always_inline]] Lanes cofactors(const Lanes (&e)[D][D])
  {
    auto& n = this->Normals;
    if constexpr (D == 2)
    {
      n[0][0] = e[1][1];
      n[0][1] = -e[1][0];
      n[1][0] = -e[0][1];
      n[1][1] = e[0][0];
      return e[0][0] * e[1][1] - e[1][0] * e[0][1];
    }
    else
    {
      for (int i = 0; i < 3; ++i)
      {
        const auto& u = e[(i + 1) % 3];
        const auto& v = e[(i + 2) % 3];
        n[i][0] = u[1] * v[2] - u[2] * v[1];
        n[i][1] = u[2] * v[0] - u[0] * v[2];
        n[i][2] = u[0] * v[1] - u[1] * v[0];
      }
      return n[0][0] * e[0][0] + n[0][1] * e[0][1] + n[0][2] * e[0][2];
    }
  }
};

} // namespace tipp

#endif
