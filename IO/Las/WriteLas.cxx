// SPDX-License-Identifier: BSD-3-Clause
#include "Las/WriteLas.h"

#include "Files/IOError.h"
#include "Files/RawValues.h"
#include "Files/TextFile.h"
#include "Las/LasInputs.h"
#include "Las/LasWriter.h"
#include "Las/RecordPlan.h"
#include "Parallel/ParallelFor.h"
#include "Parallel/Poll.h"

#include <cmath>
#include <cstring>
#include <limits>

namespace tipp
{
namespace
{

[[noreturn]] void refuseScale(
  const std::string& output, std::size_t axis, double scale, const AxisSurvey& survey)
{
  throw IOError(output,
    std::string("cannot have ") + "xyz"[axis] + " from " + shortText(survey.low()) + " to " +
      shortText(survey.high()) + " with the scale " + shortText(scale) +
      ", since LAS stores 32 bits; give a coarser one, such as --scale " +
      shortText(survey.finestScale()) + ".");
}

/// Whether all coordinates of a transform are those of another one, too, but for rounding.
bool isContained(const LasTransform& in, const LasTransform& transform)
{
  constexpr double slack = 1e-6; // of a step
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double steps = (transform.Offset[axis] - in.Offset[axis]) / in.Scale[axis];
    const bool isWhole = std::fabs(std::nearbyint(steps) - steps) <= slack;
    if (in.Scale[axis] != transform.Scale[axis] || !isWhole)
    {
      return false;
    }
  }
  return true;
}

/// Chooses scales and offsets. Warns if coordinates are rounded without being asked to.
LasTransform chooseTransform(const std::string& output, const RecordSurvey& survey,
  const LasInputs& inputs, const std::vector<double>& scales, std::vector<std::string>& warnings)
{
  LasTransform transform;
  bool isRounded = false;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const AxisSurvey& range = survey.axis(axis);
    double& scale = transform.Scale[axis];
    scale = !scales.empty() ? scales[scales.size() == 3 ? axis : 0]
      : !inputs.isEmpty()   ? inputs.finestScale(axis)
                            : range.scale();
    isRounded = isRounded || (inputs.isEmpty() && range.isRounded());
    constexpr double coarsest = 1; // that is chosen without being asked to
    if (scales.empty() && inputs.isEmpty() && range.isRounded() && scale > coarsest)
    {
      refuseScale(output, axis, coarsest, range);
    }
    const double wanted = inputs.isEmpty() ? 0 : inputs.transformOf(0).Offset[axis];
    transform.Offset[axis] = range.offset(scale, wanted, !scales.empty());
    if (!range.fits(scale, transform.Offset[axis]))
    {
      refuseScale(output, axis, scale, range);
    }
  }
  for (std::size_t i = 0; i < inputs.headers().size(); ++i)
  {
    isRounded = isRounded || !isContained(inputs.transformOf(i), transform);
  }
  if (isRounded && scales.empty())
  {
    warnings.push_back("Coordinates are rounded to multiples of " + shortText(transform.Scale[0]) +
      ", " + shortText(transform.Scale[1]) + " and " + shortText(transform.Scale[2]) +
      " in x, y and z.");
  }
  return transform;
}

/// Returns the reference system of the output.
CrsRecords crsToWrite(const PointStream& points, const LasInputs& inputs, const std::string& ofUser,
  std::vector<std::string>& warnings)
{
  CrsRecords written;
  if (!ofUser.empty())
  {
    written.Text = wkt1Of(ofUser, true);
    if (written.Text.empty())
    {
      throw IOError("The reference system of --crs '" + shownText(ofUser) +
        "' cannot be expressed as WKT 1, which LAS files have; give one that GDAL knows, such as "
        "EPSG:25832.");
    }
    return written;
  }
  const ReferenceSystem system = points.referenceSystem();
  for (const LasHeader& header : inputs.headers())
  {
    const bool isThatOfAll = understandCrs(header.Crs).Text == system.Text;
    written = !header.Crs.isEmpty() && (written.isEmpty() || isThatOfAll) ? header.Crs : written;
    if (isThatOfAll && !written.isEmpty())
    {
      break;
    }
  }
  if (!written.Text.empty())
  {
    return { written.Text, "", "", "" };
  }
  const CrsRecords wkt = {
    system.Text.empty() || !system.Problem.empty() ? "" : wkt1Of(system.Text), "", "", ""
  };
  if (!wkt.isEmpty() && areSameCrs(understandCrs(wkt).Text, system.Text))
  {
    return wkt;
  }
  if (!written.isEmpty())
  {
    warnings.emplace_back("The reference system is written as the keys of GeoTIFF that the input "
                          "has: it cannot be expressed as WKT, which points of formats 6 to 8 "
                          "should have.");
  }
  else if (!system.Text.empty())
  {
    warnings.push_back("The reference system " + shownText(system.Text) +
      " is not written: without GDAL it cannot be expressed as WKT.");
  }
  return written;
}

/// Makes records of points.
class RecordMaker
{
public:
  RecordMaker(const std::string& output, const RecordPlan& plan, std::size_t recordLength)
    : Output(output)
    , Plan(plan)
    , RecordLength(recordLength)
  {
  }

  /// Adds the indices of the points of a block that can be stored.
  void findFinite(const PointBlock& block, std::vector<std::size_t>& finite) const
  {
    finite.clear();
    for (std::size_t i = 0; i < block.size(); ++i)
    {
      if (std::isfinite(block.XY[2 * i]) && std::isfinite(block.XY[2 * i + 1]) &&
        std::isfinite(this->heightOf(block, i)))
      {
        finite.push_back(i);
      }
    }
  }

  void make(const PointBlock& block, std::size_t i, std::uint8_t* record) const
  {
    std::memset(record, 0, this->RecordLength);
    this->storeCoordinate(0, block.XY[2 * i], record);
    this->storeCoordinate(1, block.XY[2 * i + 1], record);
    this->storeCoordinate(2, this->heightOf(block, i), record);
    if (!this->Plan.AreReturnsGiven)
    {
      record[14] = 0x11; // the only return
    }
    for (const RecordField& field : this->Plan.Fields)
    {
      double value = block.Columns[field.Column][i];
      if (std::isnan(value) && this->Plan.NoData)
      {
        value = *this->Plan.NoData; // as it was stored
      }
      if (field.Size == sizeof value)
      {
        setValue(record + field.Offset, value);
        continue;
      }
      const auto number = std::int64_t(std::isnan(value) ? 0 : value);
      std::memcpy(record + field.Offset, &number, field.Size);
    }
  }

private:
  double heightOf(const PointBlock& block, std::size_t i) const
  {
    return this->Plan.Height < block.Columns.size() ? block.Columns[this->Plan.Height][i] : 0;
  }

  void storeCoordinate(std::size_t axis, double coordinate, std::uint8_t* record) const
  {
    const LasLayout& layout = this->Plan.Layout;
    const double stored = std::nearbyint((coordinate - layout.Offset[axis]) / layout.Scale[axis]);
    if (!(stored >= std::numeric_limits<std::int32_t>::min() &&
          stored <= std::numeric_limits<std::int32_t>::max()))
    {
      AxisSurvey survey;
      survey.add(coordinate);
      refuseScale(this->Output, axis, layout.Scale[axis], survey);
    }
    setValue(record + 4 * axis, std::int32_t(stored));
  }

  const std::string Output;
  const RecordPlan& Plan;
  const std::size_t RecordLength;
};

/// Makes a pass over the points and writes them.
void writePlanned(PointStream& points, const std::string& output, const RecordPlan& plan,
  const LasOptions& options, LasReport& report)
{
  LasWriter writer(output, plan.Layout, options.Threads, options.Before);
  const RecordMaker maker(output, plan, writer.recordLength());
  const int threads = threadCount(options.Threads);
  std::vector<std::size_t> finite;
  forEachBlock(points, blockPointsOf(points),
    [&](const PointBlock& block)
    {
      poll();
      maker.findFinite(block, finite);
      report.NotFinite += std::int64_t(block.size() - finite.size());
      report.Points += std::int64_t(finite.size());
      for (std::size_t done = 0; done < finite.size();)
      {
        std::uint8_t* records = nullptr;
        const std::size_t count = writer.makeRoom(finite.size() - done, records);
        constexpr std::int64_t atOnce = 1 << 12;
        forChunks(std::int64_t(count), atOnce, threads, {},
          [&](std::int64_t begin, std::int64_t end, int)
          {
            for (auto i = std::size_t(begin); i < std::size_t(end); ++i)
            {
              maker.make(block, finite[done + i], records + i * writer.recordLength());
            }
          });
        writer.add(count);
        done += count;
      }
    });
  if (report.Points == 0)
  {
    throw IOError(output,
      "is not written, since there are no points to write; compare the options that choose points "
      "with what 'tipp info' prints.");
  }
  writer.close();
}

LasReport writeAll(PointStream& points, const LasInputs& inputs, const PointOptions& reading,
  const std::string& output, const LasOptions& options)
{
  LasReport report;
  const std::vector<std::string> columns = points.columns();
  RecordPlan plan;
  LasLayout& layout = plan.Layout;
  plan.Height = findElevation(columns);
  layout.Software = options.Software;
  layout.Crs = crsToWrite(points, inputs, reading.Crs, report.Warnings);
  // Without a survey, it is found out while writing whether coordinates fit.
  const bool isKnown =
    !inputs.isEmpty() && inputs.haveSameTransform() && options.Scale.empty() && reading.Wrap == 0;
  std::optional<RecordSurvey> survey;
  if (!isKnown)
  {
    survey.emplace(points, plan.Height);
  }
  report.Transform = isKnown
    ? inputs.transformOf(0)
    : chooseTransform(output, *survey, inputs, options.Scale, report.Warnings);
  layout.Scale = report.Transform.Scale;
  layout.Offset = report.Transform.Offset;
  if (inputs.isEmpty())
  {
    planColumns(output, columns, *survey, plan, report.Warnings);
  }
  else
  {
    planFields(inputs, columns, plan);
    plan.NoData = reading.NoData;
  }
  const std::vector<std::string> warnings = inputs.warnings();
  report.Warnings.insert(report.Warnings.end(), warnings.begin(), warnings.end());
  report.Format = layout.Format;
  writePlanned(points, output, plan, options, report);
  report.LeftOut = points.leftOut();
  report.ThinnedOut = points.thinnedOut();
  report.Read = points.readFigures();
  report.Tables = points.reports();
  return report;
}

} // namespace

LasReport writeLas(PointStream& points, const std::string& output, const LasOptions& options)
{
  return writeAll(points, LasInputs({}, {}), {}, output, options);
}

LasReport copyToLas(const std::vector<std::string>& inputs, const PointOptions& reading,
  const std::string& output, const LasOptions& options)
{
  const LasInputs las(inputs, reading.Las);
  PointOptions all = reading;
  all.Threads = options.Threads;
  if (!las.isEmpty())
  {
    all.Fields = las.fields();
  }
  return writeAll(*openPointStream(inputs, all), las, all, output, options);
}

} // namespace tipp
