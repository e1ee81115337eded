// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippWeights_h
#define tippWeights_h

#include <algorithm>
#include <cmath>
#include <utility>

namespace tipp
{

/// Barycentric weights of samples in a triangle (D = 2) or tetrahedron (D = 3): those of the
/// corners but the first, which has the rest.
///
/// Cells that are not thin are solved by determinants. For the others elimination with complete
/// pivoting keeps what matters: the weighted sum of the corners is the sample to a few roundings,
/// so that linear fields come back exact, however thin the cell is.
template <int D>
class Weights
{
public:
  using Vector = double[D];

  /// The corners in the order that the weights are for.
  void set(const double (&corners)[D + 1][D])
  {
    double product = 1;
    for (int axis = 0; axis < D; ++axis)
    {
      double largest = 0;
      this->Origin[axis] = corners[0][axis];
      for (int i = 0; i < D; ++i)
      {
        this->Matrix[axis][i] = corners[i + 1][axis] - corners[0][axis];
        largest = std::max(largest, std::fabs(this->Matrix[axis][i]));
      }
      product *= largest;
    }
    const double determinant = this->cofactors();
    // Thinner than that, the roundings of the determinants would show in the thirteenth digit.
    this->Thin = !(std::fabs(determinant) * 64 > product) || product < 1e-280;
    if (this->Thin)
    {
      this->eliminate();
      return;
    }
    const double inverse = 1 / determinant;
    for (int i = 0; i < D; ++i)
    {
      for (int axis = 0; axis < D; ++axis)
      {
        this->Normals[i][axis] *= inverse;
      }
    }
  }

  /// Of a sample: weights[i] is that of corner i + 1.
  void solve(const double* sample, double (&weights)[D]) const
  {
    if (this->Thin)
    {
      this->solveThin(sample, weights);
      return;
    }
    for (int i = 0; i < D; ++i)
    {
      double rest = 0;
      for (int axis = 1; axis < D; ++axis)
      {
        rest += this->Normals[i][axis] * (sample[axis] - this->Origin[axis]);
      }
      weights[i] = this->Normals[i][0] * (sample[0] - this->Origin[0]) + rest;
    }
  }

private:
  /// Fills Normals, the rows of the adjugate, and returns the determinant.
  double cofactors()
  {
    const auto& m = this->Matrix;
    auto& n = this->Normals;
    if constexpr (D == 2)
    {
      n[0][0] = m[1][1];
      n[0][1] = -m[0][1];
      n[1][0] = -m[1][0];
      n[1][1] = m[0][0];
      return m[0][0] * m[1][1] - m[0][1] * m[1][0];
    }
    else
    {
      for (int i = 0; i < 3; ++i)
      {
        const int j = (i + 1) % 3;
        const int k = (i + 2) % 3;
        n[i][0] = m[1][j] * m[2][k] - m[2][j] * m[1][k];
        n[i][1] = m[2][j] * m[0][k] - m[0][j] * m[2][k];
        n[i][2] = m[0][j] * m[1][k] - m[1][j] * m[0][k];
      }
      return n[0][0] * m[0][0] + n[0][1] * m[1][0] + n[0][2] * m[2][0];
    }
  }

  /// Matrix becomes its LU factors, rows and columns being exchanged as Rows and Columns tell.
  void eliminate()
  {
    auto& m = this->Matrix;
    for (int i = 0; i < D; ++i)
    {
      this->Rows[i] = this->Columns[i] = i;
    }
    double first = 0;
    for (int step = 0; step < D; ++step)
    {
      this->choosePivot(step);
      first = step == 0 ? std::fabs(m[0][0]) : first;
      // What is left of a cell flatter than the roundings says nothing.
      constexpr double rounding = 4.4408920985006262e-16;
      const bool flat = !(std::fabs(m[step][step]) > rounding * first);
      this->Reciprocals[step] = flat ? 0 : 1 / m[step][step];
      for (int row = step + 1; row < D; ++row)
      {
        m[row][step] *= this->Reciprocals[step];
        for (int column = step + 1; column < D; ++column)
        {
          m[row][column] -= m[row][step] * m[step][column];
        }
      }
    }
  }

  void choosePivot(int step)
  {
    auto& m = this->Matrix;
    int pivotRow = step;
    int pivotColumn = step;
    for (int row = step; row < D; ++row)
    {
      for (int column = step; column < D; ++column)
      {
        if (std::fabs(m[row][column]) > std::fabs(m[pivotRow][pivotColumn]))
        {
          pivotRow = row;
          pivotColumn = column;
        }
      }
    }
    std::swap(this->Rows[step], this->Rows[pivotRow]);
    std::swap(this->Columns[step], this->Columns[pivotColumn]);
    for (int i = 0; i < D; ++i)
    {
      std::swap(m[step][i], m[pivotRow][i]);
    }
    for (int i = 0; i < D; ++i)
    {
      std::swap(m[i][step], m[i][pivotColumn]);
    }
  }

  void solveThin(const double* sample, double (&weights)[D]) const
  {
    double right[D];
    for (int i = 0; i < D; ++i)
    {
      const int axis = this->Rows[i];
      right[i] = sample[axis] - this->Origin[axis];
      for (int k = 0; k < i; ++k)
      {
        right[i] -= this->Matrix[i][k] * right[k];
      }
    }
    for (int i = D - 1; i >= 0; --i)
    {
      for (int k = i + 1; k < D; ++k)
      {
        right[i] -= this->Matrix[i][k] * right[k];
      }
      right[i] *= this->Reciprocals[i];
      weights[this->Columns[i]] = right[i];
    }
  }

  double Origin[D];
  double Matrix[D][D];
  double Normals[D][D];
  double Reciprocals[D];
  int Rows[D];
  int Columns[D];
  bool Thin;
};

} // namespace tipp

#endif
