// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippNetcdfValues_h
#define tippNetcdfValues_h

#include "Netcdf/NetcdfContent.h"

#include <cstddef>
#include <limits>
#include <vector>

namespace tipp
{

/// How the stored values of a NetCDF variable become numbers, by its attributes
/// (https://cfconventions.org, sections 2.5.1 and 8.1).
struct NetcdfPacking
{
  std::vector<double> Missing;                           ///< stored values that mean: no value
  double Low = -std::numeric_limits<double>::infinity(); ///< stored values below are not valid
  double High = std::numeric_limits<double>::infinity();
  double Scale = 1;
  double Offset = 0;
  Scalar Stored = Scalar::Float64; ///< how the stored bytes are read
};

/// The variable must be of numbers.
NetcdfPacking packingOf(const NetcdfVariable& variable);

/// Converts `count` stored values; NaN where there is none.
void unpackValues(
  const NetcdfPacking& packing, const char* stored, std::size_t count, double* values);

} // namespace tipp

#endif
