// SPDX-License-Identifier: BSD-3-Clause
#include "Arrays.h"
#include "Functions.h"

#include "Parallel/ParallelFor.h"
#include "Triangulation/TriangleLocator.h"

#include <algorithm>

namespace tipp::python
{
namespace
{

constexpr std::int64_t pointsAtOnce = 4096;

/// TriangleLocator over NumPy arrays, which it keeps: float64 points of two columns, int32 corners
/// and neighbours.
class Locator
{
public:
  Locator(InputArray points, InputArray corners, InputArray neighbors)
    : Points(std::move(points))
    , Corners(std::move(corners))
    , Neighbors(std::move(neighbors))
    , Finder(PointsView(static_cast<const double*>(this->Points.data()), this->Points.shape(0), 2),
        static_cast<const std::int32_t*>(this->Corners.data()),
        static_cast<const std::int32_t*>(this->Neighbors.data()), this->Corners.shape(0))
  {
  }

  /// The triangle of each point, or -1.
  nb::object find(const InputArray& points, int threads) const
  {
    RawBuffer found(points.shape(0) * sizeof(std::int32_t));
    this->forPoints(points, threads,
      [&](std::int64_t i, Point2 p)
      { found.as<std::int32_t>()[i] = std::int32_t(this->Finder.find(p)); });
    return arrayOf(std::move(found), Scalar::Int32, 1);
  }

  /// Linear in each triangle; `fill` outside. `values` are float64 rows of the triangulated points.
  nb::object interpolate(
    const InputArray& points, const InputArray& values, double fill, int threads) const
  {
    const std::size_t columns = values.shape(1);
    const auto* const rows = static_cast<const double*>(values.data());
    RawBuffer samples(points.shape(0) * columns * sizeof(double));
    this->forPoints(points, threads,
      [&](std::int64_t i, Point2 p)
      {
        double* const sample = samples.as<double>() + std::size_t(i) * columns;
        const std::int64_t triangle = this->Finder.find(p);
        if (triangle < 0)
        {
          std::fill_n(sample, columns, fill);
          return;
        }
        double weights[3];
        this->Finder.weights(triangle, p, weights);
        const std::int32_t* const corners = this->Finder.corners(triangle);
        for (std::size_t c = 0; c < columns; ++c)
        {
          sample[c] = 0;
          for (int corner = 0; corner < 3; ++corner)
          {
            sample[c] += weights[corner] * rows[std::size_t(corners[corner]) * columns + c];
          }
        }
      });
    void* const memory = samples.release();
    return owningArray(memory, Scalar::Float64, { points.shape(0), columns });
  }

private:
  template <typename Work>
  void forPoints(const InputArray& points, int threads, const Work& work) const
  {
    const nb::gil_scoped_release released;
    const auto* const xy = static_cast<const double*>(points.data());
    forChunks(std::int64_t(points.shape(0)), pointsAtOnce, threadCount(threads), {},
      [&](std::int64_t begin, std::int64_t end, int)
      {
        for (std::int64_t i = begin; i < end; ++i)
        {
          work(i, { xy[2 * i], xy[2 * i + 1] });
        }
      });
  }

  InputArray Points;
  InputArray Corners;
  InputArray Neighbors;
  TriangleLocator<std::int32_t> Finder;
};

} // namespace

void addLocatorClass(nb::module_& module)
{
  nb::class_<Locator>(module, "Locator")
    .def(nb::init<InputArray, InputArray, InputArray>())
    .def("find", &Locator::find)
    .def("interpolate", &Locator::interpolate);
}

} // namespace tipp::python
