// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippThinWeights_h
#define tippThinWeights_h

#include <cmath>
#include <utility>

namespace tipp
{

/// Barycentric weights of samples in a thin triangle (D = 2) or tetrahedron (D = 3): those of all
/// corners but the first, whose weight is the remainder.
///
/// Elimination with complete pivoting has a small residual: the weighted sum of the corners is the
/// sample to a few roundings, so linear fields are reproduced, however thin the cell is.
template <int D>
class ThinWeights
{
public:
  /// `edges`: from the first corner to each of the others.
  explicit ThinWeights(const double (&edges)[D][D])
  {
    for (int axis = 0; axis < D; ++axis)
    {
      for (int i = 0; i < D; ++i)
      {
        this->Matrix[axis][i] = edges[i][axis];
      }
    }
    this->eliminate();
  }

  /// Computes the weights of the sample at `offset` from the first corner: weights[i] is that of
  /// corner i + 1.
  void solve(const double (&offset)[D], double (&weights)[D]) const
  {
    double right[D];
    for (int i = 0; i < D; ++i)
    {
      right[i] = offset[this->Rows[i]];
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

private:
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

  double Matrix[D][D];
  double Reciprocals[D];
  int Rows[D];
  int Columns[D];
};

} // namespace tipp

#endif
