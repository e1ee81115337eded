// SPDX-License-Identifier: BSD-3-Clause
#include "Series/SeriesOutput.h"

#include "Crs/ReferenceSystem.h"
#include "Files/IOError.h"

#include <dlfcn.h>
#include <netcdf.h>

#include <algorithm>
#include <cstdint>
#include <limits>

namespace tipp
{
namespace
{

/// Calls a function of the HDF5 library that NetCDF is linked to; does nothing if there is none.
template <typename Function, typename... Arguments>
void callHdf5(const char* name, Arguments... arguments)
{
  if (const auto function = reinterpret_cast<Function>(dlsym(RTLD_DEFAULT, name)))
  {
    function(arguments...);
  }
}

/// HDF5 crashes when a file that could not be written, as on a full disk, is still open at the end
/// of the process. All files are closed here, so it has nothing to do then.
void keepHdf5FromExit()
{
  callHdf5<int (*)()>("H5dont_atexit");
}

/// Stops HDF5 from printing errors of this thread, which are exceptions here.
void silenceHdf5()
{
  callHdf5<int (*)(std::int64_t, void*, void*)>("H5Eset_auto2", std::int64_t(0), nullptr, nullptr);
}

class NetcdfGrids : public SeriesOutput
{
public:
  NetcdfGrids(
    const std::string& path, const SeriesDescription& description, const PathState& before)
    : Path(path)
    , Of(description)
    , Pending(path, before)
  {
    this->Pending.unlock();
    keepHdf5FromExit();
    this->check(nc_create(this->Pending.temporaryPath().c_str(),
      NC_CLOBBER | NC_NETCDF4 | NC_CLASSIC_MODEL, &this->File));
    this->IsOpen = true;
    this->define();
    this->check(nc_enddef(this->File));
    this->writeAxes();
  }

  ~NetcdfGrids() override
  {
    // After a failed write, as on a full disk, HDF5 crashes when it is told to give up the file.
    if (this->IsOpen && !this->HasFailed)
    {
      nc_abort(this->File);
    }
  }
  NetcdfGrids(const NetcdfGrids&) = delete;
  NetcdfGrids& operator=(const NetcdfGrids&) = delete;

  void write(std::size_t field, std::size_t step, const float* samples) override
  {
    silenceHdf5();
    const bool varies = this->Of.Fields[field].Varies;
    const std::size_t start[3] = { step, 0, 0 };
    const std::size_t count[3] = { 1, this->rows(), this->columns() };
    const int skipped = varies ? 0 : 1;
    this->check(nc_put_vara_float(
      this->File, this->Variables[field], start + skipped, count + skipped, samples));
  }

  void close() override
  {
    silenceHdf5();
    this->IsOpen = false;
    this->check(nc_close(this->File));
    this->Pending.commit();
  }

private:
  std::size_t columns() const { return std::size_t(this->Of.Grid.size(0)); }
  std::size_t rows() const { return std::size_t(this->Of.Grid.size(1)); }

  /// `name`: of the variable or attribute at which a call may fail.
  void check(int status, const std::string& name = "") const
  {
    if (status != NC_NOERR)
    {
      this->HasFailed = true;
      throw IOError(this->Path,
        std::string("cannot be written as NetCDF") + (name.empty() ? "" : ", at '" + name + "'") +
          ": " + nc_strerror(status) +
          (name.empty() ? "; is the disk full?" : "; leave it out with --arrays, or write .tif."));
    }
  }

  void setText(int variable, const char* name, const std::string& text) const
  {
    if (!text.empty())
    {
      this->check(nc_put_att_text(this->File, variable, name, text.size(), text.c_str()));
    }
  }

  int addDimension(const std::string& name, std::size_t size) const
  {
    int dimension = 0;
    this->check(nc_def_dim(this->File, name.c_str(), size, &dimension));
    return dimension;
  }

  int addVariable(const std::string& name, nc_type type, const std::vector<int>& dimensions) const
  {
    int variable = 0;
    this->check(nc_def_var(this->File, name.c_str(), type, int(dimensions.size()),
                  dimensions.data(), &variable),
      name);
    return variable;
  }

  void define()
  {
    const std::string wkt = this->Of.Crs.empty() ? "" : wkt1Of(this->Of.Crs, true);
    const bool isGeographic = wkt.rfind("GEOGCS", 0) == 0;
    this->XName = isGeographic ? "lon" : "x";
    this->YName = isGeographic ? "lat" : "y";
    this->setText(NC_GLOBAL, "Conventions", "CF-1.8");
    this->setText(NC_GLOBAL, "source", this->Of.Source);
    const bool hasTime = std::any_of(this->Of.Fields.begin(), this->Of.Fields.end(),
      [](const SeriesField& field) { return field.Varies; });
    std::vector<int> dimensions;
    if (hasTime)
    {
      dimensions.push_back(this->addDimension("time", NC_UNLIMITED));
      this->Time = this->addVariable("time", NC_DOUBLE, { dimensions[0] });
      this->setText(this->Time, "standard_name", "time");
      this->setText(this->Time, "axis", "T");
      this->setText(this->Time, "units", this->Of.TimeUnits);
      this->setText(this->Time, "calendar", this->Of.Calendar);
    }
    dimensions.push_back(this->addDimension(this->YName, this->rows()));
    dimensions.push_back(this->addDimension(this->XName, this->columns()));
    this->defineAxes(dimensions, wkt, isGeographic);
    for (const SeriesField& field : this->Of.Fields)
    {
      this->Variables.push_back(this->defineField(field, dimensions, !wkt.empty()));
    }
  }

  void defineAxes(const std::vector<int>& dimensions, const std::string& wkt, bool isGeographic)
  {
    const std::size_t last = dimensions.size() - 1;
    this->X = this->addVariable(this->XName, NC_DOUBLE, { dimensions[last] });
    this->Y = this->addVariable(this->YName, NC_DOUBLE, { dimensions[last - 1] });
    this->setText(this->X, "axis", "X");
    this->setText(this->Y, "axis", "Y");
    if (isGeographic)
    {
      this->setText(this->X, "standard_name", "longitude");
      this->setText(this->Y, "standard_name", "latitude");
      this->setText(this->X, "units", "degrees_east");
      this->setText(this->Y, "units", "degrees_north");
    }
    else if (!wkt.empty())
    {
      this->setText(this->X, "standard_name", "projection_x_coordinate");
      this->setText(this->Y, "standard_name", "projection_y_coordinate");
    }
    if (!wkt.empty())
    {
      const int crs = this->addVariable("crs", NC_INT, {});
      this->setText(crs, "grid_mapping_name", isGeographic ? "latitude_longitude" : "");
      this->setText(crs, "crs_wkt", wkt);
      this->setText(crs, "spatial_ref", wkt);
    }
  }

  int defineField(const SeriesField& field, const std::vector<int>& dimensions, bool hasCrs) const
  {
    const bool isPlane = !field.Varies && dimensions.size() == 3;
    const std::vector<int> own(dimensions.begin() + (isPlane ? 1 : 0), dimensions.end());
    const int variable = this->addVariable(field.Name, NC_FLOAT, own);
    const float missing = std::numeric_limits<float>::quiet_NaN();
    this->check(nc_put_att_float(this->File, variable, "_FillValue", NC_FLOAT, 1, &missing));
    this->setText(variable, "long_name", field.LongName);
    this->setText(variable, "units", field.Units);
    this->setText(variable, "grid_mapping", hasCrs ? "crs" : "");
    // Chunks of a quarter of a million samples of one step: they are read for a map or a station.
    constexpr std::size_t side = 512;
    const std::size_t chunk[3] = { 1, std::min(side, this->rows()),
      std::min(side, this->columns()) };
    this->check(
      nc_def_var_chunking(this->File, variable, NC_CHUNKED, chunk + (field.Varies ? 0 : 1)));
    constexpr int fast = 1; // of 9: larger ones take twice the time for a few per cent
    this->check(nc_def_var_deflate(this->File, variable, 1, 1, fast));
    return variable;
  }

  void writeAxes() const
  {
    const LatticeAxis columns(this->Of.Grid, 0);
    const LatticeAxis rows(this->Of.Grid, 1);
    this->check(nc_put_var_double(this->File, this->X, columns.data()));
    this->check(nc_put_var_double(this->File, this->Y, rows.data()));
    if (this->Time >= 0)
    {
      const std::size_t start = 0;
      const std::size_t count = this->Of.Times.size();
      this->check(
        nc_put_vara_double(this->File, this->Time, &start, &count, this->Of.Times.data()));
    }
  }

  std::string Path;
  SeriesDescription Of;
  PendingFile Pending;
  int File = 0;
  bool IsOpen = false;
  mutable bool HasFailed = false;
  std::string XName;
  std::string YName;
  int X = -1;
  int Y = -1;
  int Time = -1;
  std::vector<int> Variables;
};

} // namespace

std::unique_ptr<SeriesOutput> createNetcdfSeries(
  const std::string& path, const SeriesDescription& description, const PathState& before)
{
  return std::make_unique<NetcdfGrids>(path, description, before);
}

} // namespace tipp
