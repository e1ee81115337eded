// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippNetcdfTime_h
#define tippNetcdfTime_h

#include "Netcdf/NetcdfFile.h"

#include <string>
#include <vector>

namespace tipp
{

/// The time steps of a NetCDF file.
struct NetcdfTime
{
  int Dimension = -1; ///< -1: the file has no time
  std::vector<double> Values;
  std::string Units;       ///< such as "seconds since 2008-09-01"
  std::string Calendar;    ///< empty: the standard one
  bool AreNumbers = false; ///< the file has no times: the values count the steps from 0
  std::string UnreadDate;  ///< a text that should be the time of a step
};

/// Finds and reads the times: a variable of one dimension with the standard name time, the axis T,
/// a unit such as "days since ...", or the name time. Throws IOError if the times are not finite
/// and ascending.
NetcdfTime readNetcdfTime(NetcdfFile& file);

} // namespace tipp

#endif
