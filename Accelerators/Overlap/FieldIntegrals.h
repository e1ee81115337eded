// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippFieldIntegrals_h
#define tippFieldIntegrals_h

#include "Overlap/OverlapSums.h"
#include "Overlap/PlaneTriangles.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// Adds the integrals of fields over a part of a source triangle.
class FieldIntegrals
{
public:
  /// `parents`: the cell of each triangle, whose values it has; null: the same index. All must
  /// outlive the object.
  FieldIntegrals(const TriangleReader& reader, const std::vector<OverlapField>& fields,
    const std::int64_t* parents)
    : Reader(reader)
    , Fields(fields)
    , Parents(parents)
  {
  }

  /// `weights`: the integrals over the part of the barycentric weights of the triangle's corners;
  /// may be null if all fields are of cells. `sums`: as in OverlapSums.
  void add(std::int64_t triangle, double area, const double* weights, RunningSum* sums) const
  {
    sums->add(area);
    const std::int64_t cell = this->Parents ? this->Parents[triangle] : triangle;
    for (const OverlapField& field : this->Fields)
    {
      const std::size_t components = std::size_t(field.Components);
      for (std::size_t k = 0; k < components; ++k)
      {
        (++sums)->add(field.OfCells ? area * field.Values[std::size_t(cell) * components + k]
                                    : this->ofPoints(triangle, field, weights, k));
      }
    }
  }

private:
  double ofPoints(std::int64_t triangle, const OverlapField& field, const double* weights,
    std::size_t component) const
  {
    double integral = 0;
    for (int i = 0; i < 3; ++i)
    {
      const std::size_t id = std::size_t(this->Reader.id(triangle, i));
      integral += weights[i] * field.Values[id * std::size_t(field.Components) + component];
    }
    return integral;
  }

  const TriangleReader& Reader;
  const std::vector<OverlapField>& Fields;
  const std::int64_t* Parents;
};

} // namespace tipp

#endif
