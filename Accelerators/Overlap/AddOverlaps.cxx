// SPDX-License-Identifier: BSD-3-Clause
#include "Overlap/AddOverlaps.h"

#include "Overlap/FieldIntegrals.h"
#include "Overlap/OverlapVisitor.h"
#include "Parallel/Instructions.h"

#include <algorithm>
#include <cstddef>

namespace tipp
{
namespace
{

/// Adds the common parts of one target after another to its sums.
template <int Values>
class SumCollector
{
public:
  SumCollector(const FieldIntegrals& fields, OverlapSums& sums)
    : Fields(fields)
    , Sums(sums)
  {
  }

  void begin(const PlaneTriangle& target) { this->Target = this->Sums.of(target.Cell); }
  void add(const PlaneTriangle& source, const CommonPart<Values>& part, double area)
  {
    double weights[3] = {};
    if constexpr (Values == 6)
    {
      part.integrate(3, 3, weights);
    }
    this->Fields.add(source.Cell, area, weights, this->Target);
  }
  void end() {}

private:
  const FieldIntegrals& Fields;
  OverlapSums& Sums;
  RunningSum* Target = nullptr;
};

template <int Values>
bool addWith(const SimplexMesh& targets, const OverlapSource& source, OverlapSums& sums,
  int threads, const Report& report)
{
  const OverlapVisitor<Values> visitor(targets, source.Mesh, threads);
  const FieldIntegrals fields(visitor.sources(), source.Fields, source.Parents);
  return visitor.visit([&](int) { return SumCollector<Values>(fields, sums); }, report);
}

} // namespace

bool addOverlaps(const SimplexMesh& targets, const OverlapSource& source, OverlapSums& sums,
  int threads, const Report& report)
{
  return anyOfPoints(source.Fields) ? addWith<6>(targets, source, sums, threads, report)
                                    : addWith<3>(targets, source, sums, threads, report);
}

std::vector<double> areasOfTriangles(const SimplexMesh& targets, int threads)
{
  std::vector<double> areas(std::size_t(targets.Cells), 0);
  const TriangleReader reader(targets);
  forIndices(
    targets.Cells,
    [&](std::int64_t i)
    {
      PlaneTriangle triangle;
      if (reader.read(i, triangle))
      {
        const double twice =
          cross(triangle.At[1] - triangle.At[0], triangle.At[2] - triangle.At[0]);
        areas[std::size_t(i)] = std::max(twice / 2, 0.0); // it may be only rounding
      }
    },
    threads);
  return areas;
}

std::vector<double> sharesOfTriangles(
  const SimplexMesh& targets, const OverlapSums& sums, int threads)
{
  std::vector<double> shares = areasOfTriangles(targets, threads);
  for (std::size_t i = 0; i < shares.size(); ++i)
  {
    shares[i] = coveredShare(sums.areaOf(std::int64_t(i)), shares[i]);
  }
  return shares;
}

} // namespace tipp
