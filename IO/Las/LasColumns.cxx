// SPDX-License-Identifier: BSD-3-Clause
#include "Las/LasColumns.h"

#include "Files/IOError.h"
#include "Laz/LazChunk.h"

#include <algorithm>
#include <initializer_list>

namespace tipp
{
namespace
{

/// The columns for writing: see LasFields.
std::vector<LasColumn> columnsToWrite(const LasHeader& header, const LasFields& fields)
{
  using Kind = LasColumn::Kind;
  const bool isExtended = header.isExtended();
  const auto named = [](const char* name) { return std::string(LasFields::Prefix) + name; };
  std::vector<LasColumn> columns = { { "z", Kind::Height, 8, laz::Z },
    { "intensity", Kind::Short, 12, laz::Intensity },
    { "classification", Kind::WrittenClass, 0, laz::Class },
    { named("returns"), Kind::Returns, 14, 0 },
    { named("flags"), Kind::Flags, 15, laz::Flags | laz::Class },
    { named("user data"), Kind::Bytes, 17, laz::UserData },
    { named("angle"), Kind::Angle, isExtended ? 18U : 16U, laz::Angle },
    { named("source"), Kind::Bytes, isExtended ? 20U : 18U, laz::Source, 2 } };
  const std::size_t time = isExtended ? 22 : 20;
  const std::size_t colour = time + (header.hasTime() ? 8 : 0);
  columns.push_back({ "gps_time", header.hasTime() ? Kind::Time : Kind::Zero, time, laz::Time });
  const auto addShorts =
    [&](bool isThere, std::size_t at, unsigned attribute, std::initializer_list<const char*> names)
  {
    for (const char* const name : names)
    {
      columns.push_back({ name, isThere ? Kind::Short : Kind::Zero, at, attribute });
      at += 2;
    }
  };
  if (fields.HasColour)
  {
    addShorts(header.hasColour(), colour, laz::Colour, { "red", "green", "blue" });
  }
  if (fields.HasInfrared)
  {
    addShorts(header.hasInfrared(), colour + 6, laz::Infrared, { "nir" });
  }
  std::vector<LasExtra> extras = header.Extras;
  for (std::size_t i = 0; i < fields.Extras.size(); ++i)
  {
    const auto extra = std::find_if(extras.begin(), extras.end(),
      [&](const LasExtra& own) { return own.Size > 0 && own.key() == fields.Extras[i]; });
    if (extra == extras.end())
    {
      throw IOError("The extra bytes of a LAS file have been changed meanwhile; start again.");
    }
    for (std::size_t done = 0; done < extra->Size; done += 4)
    {
      columns.push_back(
        { named(("extra " + std::to_string(i) + "." + std::to_string(done)).c_str()), Kind::Bytes,
          extra->Offset + done, laz::Extra, std::min<std::size_t>(4, extra->Size - done) });
    }
    extra->Size = 0; // another one may have the same name
  }
  return columns;
}

} // namespace

std::vector<LasColumn> columnsOf(const LasHeader& header, const PointOptions& options)
{
  using Kind = LasColumn::Kind;
  if (options.Fields)
  {
    return columnsToWrite(header, *options.Fields);
  }
  std::vector<LasColumn> columns = { { "z", Kind::Height, 8, laz::Z },
    { "intensity", Kind::Short, 12, laz::Intensity },
    { "classification", Kind::Class, 0, laz::Class } };
  const std::size_t afterBasics = header.isExtended() ? 22 : 20;
  if (header.hasTime())
  {
    columns.push_back({ "gps_time", Kind::Time, afterBasics, laz::Time });
  }
  const std::size_t colour = afterBasics + (header.hasTime() ? 8 : 0);
  if (header.hasColour())
  {
    columns.push_back({ "red", Kind::Short, colour, laz::Colour });
    columns.push_back({ "green", Kind::Short, colour + 2, laz::Colour });
    columns.push_back({ "blue", Kind::Short, colour + 4, laz::Colour });
  }
  if (header.hasInfrared())
  {
    columns.push_back({ "nir", Kind::Short, colour + 6, laz::Infrared });
  }
  return columns;
}

} // namespace tipp
