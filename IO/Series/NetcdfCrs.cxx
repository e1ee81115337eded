// SPDX-License-Identifier: BSD-3-Clause
#include "Series/NetcdfCrs.h"

namespace tipp
{

bool isGeographicWkt(const std::string& wkt)
{
  return wkt.rfind("GEOGCS", 0) == 0;
}

void describeAxes(const NetcdfOutput& output, int x, int y, const std::string& wkt)
{
  if (isGeographicWkt(wkt))
  {
    output.setText(x, "standard_name", "longitude");
    output.setText(y, "standard_name", "latitude");
    output.setText(x, "units", "degrees_east");
    output.setText(y, "units", "degrees_north");
  }
  else if (!wkt.empty())
  {
    output.setText(x, "standard_name", "projection_x_coordinate");
    output.setText(y, "standard_name", "projection_y_coordinate");
  }
}

void defineCrs(const NetcdfOutput& output, const std::string& wkt)
{
  if (!wkt.empty())
  {
    const int crs = output.addVariable("crs", Scalar::Int32, {});
    output.setText(crs, "grid_mapping_name", isGeographicWkt(wkt) ? "latitude_longitude" : "");
    output.setText(crs, "crs_wkt", wkt);
    output.setText(crs, "spatial_ref", wkt);
  }
}

} // namespace tipp
