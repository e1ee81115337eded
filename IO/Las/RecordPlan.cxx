// SPDX-License-Identifier: BSD-3-Clause
#include "Las/RecordPlan.h"

#include "Files/IOError.h"
#include "Parallel/Poll.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>

namespace tipp
{
namespace
{

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

/// The same for files other than LAS, whose columns may have any name, also one of LasFields.
const NamedField& fieldOfOthers(const std::string& column)
{
  return LasFields::isName(column) ? namedFields.back() : fieldOf(column);
}

/// The names that programs give the fields of LAS files, which extra bytes must not have.
bool isNameOfField(const std::string& name)
{
  constexpr std::array<const char*, 30> names = { "X", "Y", "Z", "x", "y", "z", "intensity",
    "return_number", "number_of_returns", "synthetic", "key_point", "withheld", "overlap",
    "scanner_channel", "scan_direction_flag", "edge_of_flight_line", "classification",
    "raw_classification", "classification_flags", "bit_fields", "flag_byte", "user_data",
    "scan_angle", "scan_angle_rank", "point_source_id", "gps_time", "red", "green", "blue", "nir" };
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool fitsField(const std::string& column, const std::vector<double>& values)
{
  const std::size_t size = fieldOfOthers(column).Size;
  const double most = size == 1 ? 255 : 65535;
  const auto fitsOne = [most](double value)
  { return value >= 0 && value <= most && std::floor(value) == value; };
  return size == 8 || (size > 0 && std::all_of(values.begin(), values.end(), fitsOne));
}

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

} // namespace

std::size_t blockPointsOf(const PointStream& points)
{
  constexpr std::size_t most = std::size_t(1) << 16;
  constexpr std::size_t values = std::size_t(1) << 21;
  return std::min(most, values / (points.columns().size() + 2) + 1);
}

RecordSurvey::RecordSurvey(PointStream& points, std::size_t height)
  : Columns(points.columns())
  , Fits(this->Columns.size(), true)
{
  forEachBlock(points, blockPointsOf(points),
    [&](const PointBlock& block)
    {
      poll();
      this->add(block, height);
    });
}

void RecordSurvey::add(const PointBlock& block, std::size_t height)
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
    this->Fits[c] = this->Fits[c] && fitsField(this->Columns[c], block.Columns[c]);
  }
}

bool RecordSurvey::fits(const std::string& column) const
{
  const auto at = std::find(this->Columns.begin(), this->Columns.end(), column);
  return at != this->Columns.end() && fieldOfOthers(column).Size > 0 &&
    this->Fits[std::size_t(at - this->Columns.begin())];
}

void planColumns(const std::string& output, const std::vector<std::string>& columns,
  const RecordSurvey& survey, RecordPlan& plan, std::vector<std::string>& warnings)
{
  const bool hasColour = survey.fits("red") && survey.fits("green") && survey.fits("blue");
  const bool hasInfrared = hasColour && survey.fits("nir");
  plan.Layout.Format = hasInfrared ? 8 : hasColour ? 7 : 6;
  const std::size_t basics = lasRecordLength(plan.Layout.Format);
  std::set<std::string> descriptors;
  for (std::size_t c = 0; c < columns.size(); ++c)
  {
    if (c == plan.Height)
    {
      continue;
    }
    const NamedField& field = fieldOfOthers(columns[c]);
    if (survey.fits(columns[c]) && field.Offset + field.Size <= basics)
    {
      plan.Fields.push_back({ c, field.Offset, field.Size });
      continue;
    }
    std::string name = columns[c];
    if (isNameOfField(name))
    {
      name += "_column";
      warnings.push_back("The column " + columns[c] +
        " does not fit the field of this name; it is written as the extra bytes " + name + ".");
    }
    const std::string descriptor = describeColumn(name);
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

} // namespace tipp
