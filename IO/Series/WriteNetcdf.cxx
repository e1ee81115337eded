// SPDX-License-Identifier: BSD-3-Clause
#include "Series/SeriesOutput.h"

#include "Crs/ReferenceSystem.h"
#include "Netcdf/NetcdfOutput.h"
#include "Series/NetcdfCrs.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace tipp
{
namespace
{

class NetcdfGrids : public SeriesOutput
{
public:
  NetcdfGrids(
    const std::string& path, const SeriesDescription& description, const PathState& before)
    : Of(description)
    , Output(path, before, true, "leave it out with --arrays, or write .tif.")
  {
    this->define();
    this->Output.endDefinitions();
    this->writeAxes();
  }

  void write(std::size_t field, std::size_t step, const float* samples) override
  {
    std::vector<std::size_t> start{ step, 0, 0 };
    std::vector<std::size_t> count{ 1, this->rows(), this->columns() };
    if (!this->Of.Fields[field].Varies)
    {
      start.erase(start.begin());
      count.erase(count.begin());
    }
    this->Output.write(this->Variables[field], start, count, samples);
  }

  void close() override { this->Output.close(); }

private:
  std::size_t columns() const { return std::size_t(this->Of.Grid.size(0)); }
  std::size_t rows() const { return std::size_t(this->Of.Grid.size(1)); }

  void define()
  {
    const std::string wkt = this->Of.Crs.empty() ? "" : wkt1Of(this->Of.Crs, true);
    const bool isGeographic = isGeographicWkt(wkt);
    this->XName = isGeographic ? "lon" : "x";
    this->YName = isGeographic ? "lat" : "y";
    this->Output.setText(NetcdfOutput::global, "Conventions", "CF-1.8");
    this->Output.setText(NetcdfOutput::global, "source", this->Of.Source);
    const bool hasTime = std::any_of(this->Of.Fields.begin(), this->Of.Fields.end(),
      [](const SeriesField& field) { return field.Varies; });
    std::vector<int> dimensions;
    if (hasTime)
    {
      dimensions.push_back(this->Output.addUnlimited("time"));
      this->Time = this->Output.addVariable("time", Scalar::Float64, { dimensions[0] });
      this->Output.setText(this->Time, "standard_name", "time");
      this->Output.setText(this->Time, "axis", "T");
      this->Output.setText(this->Time, "units", this->Of.TimeUnits);
      this->Output.setText(this->Time, "calendar", this->Of.Calendar);
    }
    dimensions.push_back(this->Output.addDimension(this->YName, this->rows()));
    dimensions.push_back(this->Output.addDimension(this->XName, this->columns()));
    this->defineAxes(dimensions, wkt);
    for (const SeriesField& field : this->Of.Fields)
    {
      this->Variables.push_back(this->defineField(field, dimensions, !wkt.empty()));
    }
  }

  void defineAxes(const std::vector<int>& dimensions, const std::string& wkt)
  {
    const std::size_t last = dimensions.size() - 1;
    this->X = this->Output.addVariable(this->XName, Scalar::Float64, { dimensions[last] });
    this->Y = this->Output.addVariable(this->YName, Scalar::Float64, { dimensions[last - 1] });
    this->Output.setText(this->X, "axis", "X");
    this->Output.setText(this->Y, "axis", "Y");
    describeAxes(this->Output, this->X, this->Y, wkt);
    defineCrs(this->Output, wkt);
  }

  int defineField(const SeriesField& field, const std::vector<int>& dimensions, bool hasCrs) const
  {
    const bool isPlane = !field.Varies && dimensions.size() == 3;
    const std::vector<int> own(dimensions.begin() + (isPlane ? 1 : 0), dimensions.end());
    const int variable = this->Output.addVariable(field.Name, Scalar::Float32, own);
    this->Output.fillWithNaN(variable, Scalar::Float32);
    this->Output.setText(variable, "long_name", field.LongName);
    this->Output.setText(variable, "standard_name", field.StandardName);
    this->Output.setText(variable, "units", field.Units);
    this->Output.setText(variable, "grid_mapping", hasCrs ? "crs" : "");
    // Chunks of a quarter of a million samples of one step: they are read for a map or a station.
    constexpr std::size_t side = 512;
    std::vector<std::size_t> chunk{ 1, std::min(side, this->rows()),
      std::min(side, this->columns()) };
    chunk.erase(chunk.begin(), chunk.begin() + (field.Varies ? 0 : 1));
    this->Output.compress(variable, chunk);
    return variable;
  }

  void writeAxes() const
  {
    const LatticeAxis columns(this->Of.Grid, 0);
    const LatticeAxis rows(this->Of.Grid, 1);
    this->Output.write(this->X, { 0 }, { this->columns() }, columns.data());
    this->Output.write(this->Y, { 0 }, { this->rows() }, rows.data());
    if (this->Time >= 0)
    {
      this->Output.write(this->Time, { 0 }, { this->Of.Times.size() }, this->Of.Times.data());
    }
  }

  SeriesDescription Of;
  NetcdfOutput Output;
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
