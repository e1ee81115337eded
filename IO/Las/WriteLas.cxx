// SPDX-License-Identifier: BSD-3-Clause
#include "Las/WriteLas.h"

#include "Files/IOError.h"
#include "Files/RawValues.h"
#include "Files/TextFile.h"
#include "Las/LasInputs.h"
#include "Las/LasWriter.h"
#include "Parallel/ParallelFor.h"
#include "Parallel/Poll.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <set>

namespace tipp
{
namespace
{

/// The points of a block of a stream: fewer if they have many columns.
std::size_t blockPointsOf(const PointStream& points)
{
  constexpr std::size_t most = std::size_t(1) << 16;
  constexpr std::size_t values = std::size_t(1) << 21;
  return std::min(most, values / (points.columns().size() + 2) + 1);
}

/// A field of formats 6 to 8 that a column has.
struct NamedField
{
  const char* Column;
  std::size_t Offset; ///< in the record
  std::size_t Size;   ///< bytes of a whole number; 8: of a double
};

constexpr std::array<NamedField, 13> namedFields = { {
  { "intensity", 12, 2 },
  { "las:returns", 14, 1 },
  { "las:flags", 15, 1 },
  { "classification", 16, 1 },
  { "las:user data", 17, 1 },
  { "las:angle", 18, 2 },
  { "las:source", 20, 2 },
  { "gps_time", 22, 8 },
  { "red", 30, 2 },
  { "green", 32, 2 },
  { "blue", 34, 2 },
  { "nir", 36, 2 },
  { "", 0, 0 },
} };

const NamedField& fieldOf(const std::string& column)
{
  return *std::find_if(namedFields.begin(), namedFields.end() - 1,
    [&column](const NamedField& field) { return field.Column == column; });
}

/// A column, and where the records have it.
struct RecordField
{
  std::size_t Column;
  std::size_t Offset;
  std::size_t Size; ///< bytes of a whole number; 8: of a double
};

/// What the points of a stream are like, found in a pass over them.
class PointSurvey
{
public:
  PointSurvey(PointStream& points, std::size_t height)
    : Columns(points.columns())
    , Fits(this->Columns.size(), true)
    , IsHeight(this->Columns.size(), height < this->Columns.size())
  {
    forEachBlock(points, blockPointsOf(points),
      [&](const PointBlock& block)
      {
        poll();
        this->add(block, height);
      });
  }

  const AxisSurvey& axis(std::size_t number) const { return this->Axes[number]; }

  /// Whether all values of a column fit into the LAS field of its name.
  bool fits(const std::string& column) const
  {
    const auto at = std::find(this->Columns.begin(), this->Columns.end(), column);
    return at != this->Columns.end() && fieldOf(column).Size > 0 &&
      this->Fits[std::size_t(at - this->Columns.begin())];
  }

  /// Whether a column is that of the heights, under whatever name.
  bool isHeight(std::size_t column) const { return this->IsHeight[column]; }

private:
  void add(const PointBlock& block, std::size_t height)
  {
    const bool hasHeight = height < this->Columns.size();
    for (std::size_t i = 0; i < block.size(); ++i)
    {
      const double z = hasHeight ? block.Columns[height][i] : 0;
      if (std::isfinite(block.XY[2 * i]) && std::isfinite(block.XY[2 * i + 1]) && std::isfinite(z))
      {
        this->Axes[0].add(block.XY[2 * i]);
        this->Axes[1].add(block.XY[2 * i + 1]);
        this->Axes[2].add(z);
      }
    }
    for (std::size_t c = 0; c < this->Columns.size(); ++c)
    {
      const std::vector<double>& values = block.Columns[c];
      this->IsHeight[c] =
        c == height || (this->IsHeight[c] && areEqual(values, block.Columns[height]));
      this->Fits[c] = this->Fits[c] && fitsField(this->Columns[c], values);
    }
  }

  static bool areEqual(const std::vector<double>& a, const std::vector<double>& b)
  {
    return std::equal(a.begin(), a.end(), b.begin(),
      [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); });
  }

  static bool fitsField(const std::string& column, const std::vector<double>& values)
  {
    const std::size_t size = fieldOf(column).Size;
    const double most = size == 1 ? 255 : 65535;
    const auto fitsOne = [most](double value)
    { return value >= 0 && value <= most && std::floor(value) == value; };
    return size == 8 || (size > 0 && std::all_of(values.begin(), values.end(), fitsOne));
  }

  const std::vector<std::string> Columns;
  std::array<AxisSurvey, 3> Axes;
  std::vector<bool> Fits;
  std::vector<bool> IsHeight;
};

/// The description of a column of doubles in record 4.
std::string describeColumn(const std::string& name)
{
  constexpr std::size_t longest = 32;
  constexpr char float64 = 10;
  std::string descriptor(LasExtra::DescriptorSize, '\0');
  std::size_t size = std::min(name.size(), longest);
  while (size < name.size() && size > 0 && (std::uint8_t(name[size]) & 0xC0) == 0x80)
  {
    --size; // not within a character of UTF-8
  }
  descriptor[2] = float64;
  descriptor.replace(4, size, name, 0, size);
  return descriptor;
}

/// The layout of a file, and which columns its records have.
struct RecordPlan
{
  LasLayout Layout;
  std::vector<RecordField> Fields;
  std::size_t Height = 0; ///< the column of z; the number of columns: none
  bool AreReturnsGiven = false;
  std::optional<double> NoData = {}; ///< for whole numbers that are missing
};

/// Adds the columns of other files than LAS.
void planColumns(const std::string& output, const std::vector<std::string>& columns,
  const PointSurvey& survey, RecordPlan& plan)
{
  const bool hasColour = survey.fits("red") && survey.fits("green") && survey.fits("blue");
  const bool hasInfrared = hasColour && survey.fits("nir");
  plan.Layout.Format = hasInfrared ? 8 : hasColour ? 7 : 6;
  const std::size_t basics = lasRecordLength(plan.Layout.Format);
  std::set<std::string> descriptors;
  for (std::size_t c = 0; c < columns.size(); ++c)
  {
    const NamedField& field = fieldOf(columns[c]);
    if (survey.isHeight(c))
    {
      continue;
    }
    if (survey.fits(columns[c]) && field.Offset + field.Size <= basics)
    {
      plan.Fields.push_back({ c, field.Offset, field.Size });
      continue;
    }
    const std::string descriptor = describeColumn(columns[c]);
    if (!descriptors.insert(descriptor).second)
    {
      throw IOError(output,
        "would have two columns whose names begin with the 32 bytes of '" + shownText(columns[c]) +
          "'; rename one.");
    }
    plan.Layout.Descriptors += descriptor;
    plan.Fields.push_back({ c, basics + plan.Layout.ExtraBytes, sizeof(double) });
    plan.Layout.ExtraBytes += sizeof(double);
  }
}

/// Adds the columns of LAS files (LasFields).
void planFields(const LasInputs& inputs, const std::vector<std::string>& columns, RecordPlan& plan)
{
  const LasFields fields = inputs.fields();
  LasLayout& layout = plan.Layout;
  layout.Format = fields.HasInfrared ? 8 : fields.HasColour ? 7 : 6;
  layout.Descriptors = inputs.descriptors();
  layout.HasStandardTime = inputs.haveStandardTime();
  layout.AreReturnsSynthetic = inputs.haveSyntheticReturns();
  layout.System = inputs.system();
  plan.AreReturnsGiven = true;
  std::size_t c = 0;
  for (; c < columns.size() && columns[c].compare(0, 10, "las:extra ") != 0; ++c)
  {
    const NamedField& field = fieldOf(columns[c]);
    if (field.Size > 0)
    {
      plan.Fields.push_back({ c, field.Offset, field.Size });
    }
  }
  // Words of four bytes, and what is left.
  for (const LasExtra& extra : inputs.extras())
  {
    for (std::size_t done = 0; done < extra.Size; done += 4, ++c)
    {
      const std::size_t size = std::min<std::size_t>(4, extra.Size - done);
      plan.Fields.push_back({ c, lasRecordLength(layout.Format) + layout.ExtraBytes, size });
      layout.ExtraBytes += size;
    }
  }
}

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
LasTransform chooseTransform(const std::string& output, const PointSurvey& survey,
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
    const double wanted = inputs.isEmpty() ? 0 : inputs.transformOf(0).Offset[axis];
    transform.Offset[axis] = range.offset(scale, wanted);
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
      const double value = block.Columns[field.Column][i];
      if (field.Size == sizeof value)
      {
        setValue(record + field.Offset, value);
        continue;
      }
      const auto number = std::int64_t(std::isnan(value) ? this->Plan.NoData.value_or(0) : value);
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
    throw IOError(output, "is not written, since there are no points to write.");
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
  plan.NoData = reading.NoData;
  layout.Software = options.Software;
  layout.Crs = crsToWrite(points, inputs, reading.Crs, report.Warnings);
  // Without a survey, it is found out while writing whether coordinates fit.
  const bool isKnown =
    !inputs.isEmpty() && inputs.haveSameTransform() && options.Scale.empty() && reading.Wrap == 0;
  std::optional<PointSurvey> survey;
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
    planColumns(output, columns, *survey, plan);
  }
  else
  {
    planFields(inputs, columns, plan);
    const std::vector<std::string> warnings = inputs.warnings();
    report.Warnings.insert(report.Warnings.end(), warnings.begin(), warnings.end());
  }
  report.Format = layout.Format;
  writePlanned(points, output, plan, options, report);
  report.LeftOut = points.leftOut();
  report.ThinnedOut = points.thinnedOut();
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
