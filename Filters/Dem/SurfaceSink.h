// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSurfaceSink_h
#define tippSurfaceSink_h

#include "Constraints/ConstraintPoints.h"
#include "Constraints/TableConstraints.h"
#include "OutOfCore/OutOfCoreTriangulation.h"
#include "vtkTIPPFiltersModule.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace tipp
{

/// Whether points of the constraints need values from the surface for these bands.
VTKTIPPFILTERS_EXPORT bool needsSurface(
  const TableConstraints& constraints, const std::vector<std::string>& bands);

/// Evaluates the surface of the input points at the points of constraints (see
/// TableConstraints::Surface), during an out-of-core triangulation of the input points.
class VTKTIPPFILTERS_EXPORT SurfaceSink : public TriangleConsumer
{
public:
  explicit SurfaceSink(const TableConstraints& constraints);

  /// Moves out the values: for each column those at the points of both tables, NaN outside of the
  /// surface. On the first rank, after the run.
  std::vector<std::vector<double>> takeValues() { return std::move(this->Values); }

  std::string identity() const override { return this->Identity; }
  std::uint64_t fileBytes(const Box2&, const std::vector<std::string>&) const override;
  void begin(
    const Box2&, const std::vector<std::string>& columns, const std::string& files) override;
  void take(const std::string& name, const double* rows, const PointRowLayout& layout,
    std::size_t points, const std::vector<TriangleRange>& triangles) override;
  bool end(const std::function<bool(double)>& progress) override;

private:
  const std::string Identity;
  const std::vector<Point2> Positions;
  const SurfacePositions Wanted;
  std::size_t Columns = 0;
  std::string Files;
  std::vector<std::vector<double>> Values;
};

/// The files whose paths begin with this one. Throws IOError.
std::vector<std::string> filesBeginning(const std::string& path);

} // namespace tipp

#endif
