// SPDX-License-Identifier: BSD-3-Clause
#include "Las/LasInputs.h"

#include "Files/Formats.h"
#include "Files/IOError.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

namespace tipp
{
namespace
{

/// Bits of the global encoding.
constexpr unsigned standardTime = 1;
constexpr unsigned syntheticReturns = 8;
constexpr unsigned timeOffset = 64;

/// The extra bytes of `mine` that `others` have, too.
std::vector<LasExtra> commonExtras(
  const std::vector<LasExtra>& mine, const std::vector<LasExtra>& others)
{
  std::multiset<std::string> keys;
  for (const LasExtra& extra : others)
  {
    keys.insert(extra.key());
  }
  std::vector<LasExtra> common;
  for (const LasExtra& extra : mine)
  {
    const auto found = keys.find(extra.key());
    if (found != keys.end())
    {
      keys.erase(found); // since another one may have the same name
      common.push_back(extra);
    }
  }
  return common;
}

} // namespace

LasInputs::LasInputs(const std::vector<std::string>& paths, const LasSelection& selection)
{
  std::copy_if(paths.begin(), paths.end(), std::back_inserter(this->Paths),
    [](const std::string& path) { return openerOf(path, Use::Points) == Opener::Las; });
  this->IsMixed = !this->Paths.empty() && this->Paths.size() < paths.size();
  if (!this->Paths.empty() && !this->IsMixed)
  {
    for (const std::string& path : this->Paths)
    {
      this->Headers.push_back(readLasHeader(path, selection));
    }
    this->findExtras();
  }
}

void LasInputs::findExtras()
{
  this->Extras = this->Headers.front().Extras;
  for (const LasHeader& header : this->Headers)
  {
    this->Extras = commonExtras(this->Extras, header.Extras);
  }
}

LasFields LasInputs::fields() const
{
  LasFields fields;
  for (const LasHeader& header : this->Headers)
  {
    fields.HasInfrared = fields.HasInfrared || header.hasInfrared();
    fields.HasColour = fields.HasColour || header.hasColour();
  }
  for (const LasExtra& extra : this->Extras)
  {
    fields.Extras.push_back(extra.key());
  }
  return fields;
}

std::string LasInputs::descriptors() const
{
  std::string all;
  for (const LasExtra& extra : this->Extras)
  {
    all += extra.descriptorWithoutRange();
  }
  return all;
}

LasTransform LasInputs::transformOf(std::size_t file) const
{
  return { this->Headers[file].Scale, this->Headers[file].Offset };
}

bool LasInputs::haveSameTransform() const
{
  for (std::size_t i = 1; i < this->Headers.size(); ++i)
  {
    if (!(this->transformOf(i) == this->transformOf(0)))
    {
      return false;
    }
  }
  return true;
}

double LasInputs::finestScale(std::size_t axis) const
{
  double finest = std::fabs(this->Headers.front().Scale[axis]);
  for (const LasHeader& header : this->Headers)
  {
    finest = std::min(finest, std::fabs(header.Scale[axis]));
  }
  return finest;
}

bool LasInputs::haveStandardTime() const
{
  const LasHeader* first = nullptr;
  for (std::size_t i = 0; i < this->Headers.size(); ++i)
  {
    const LasHeader& header = this->Headers[i];
    if (!header.hasTime())
    {
      continue;
    }
    first = first ? first : &header;
    if (((header.Encoding ^ first->Encoding) & standardTime) != 0)
    {
      throw IOError(this->Paths[i],
        "has GPS times of another kind (of the week, or standard) than the files before it; give "
        "files of one kind.");
    }
  }
  return first && (first->Encoding & standardTime) != 0;
}

bool LasInputs::haveSyntheticReturns() const
{
  return std::any_of(this->Headers.begin(), this->Headers.end(),
    [](const LasHeader& header) { return (header.Encoding & syntheticReturns) != 0; });
}

std::string LasInputs::system() const
{
  return this->Headers.size() > 1          ? "MERGE" // the word of the specification
    : this->Headers.front().System.empty() ? "OTHER"
                                           : this->Headers.front().System;
}

std::string LasInputs::warningOfMixture() const
{
  const IOError sentence(this->Paths.front(),
    "is copied together with files of other kinds: returns, flags, source ids, user data, scan "
    "angles and extra bytes of LAS files are lost; copy the LAS files apart to keep them.");
  return sentence.what();
}

void LasInputs::warnOfExtras(std::vector<std::string>& warnings) const
{
  std::set<std::string> named;
  for (std::size_t i = 0; i < this->Headers.size(); ++i)
  {
    std::multiset<std::string> kept;
    for (const LasExtra& extra : this->Extras)
    {
      kept.insert(extra.key());
    }
    for (const LasExtra& extra : this->Headers[i].Extras)
    {
      const auto found = kept.find(extra.key());
      if (found != kept.end())
      {
        kept.erase(found);
      }
      else if (named.insert(extra.name()).second)
      {
        const std::string name =
          extra.name().empty() ? "without a name" : "'" + shownText(extra.name()) + "'";
        const IOError sentence(this->Paths[i],
          "has extra bytes " + name + ", which are left out, since not all inputs have them.");
        warnings.emplace_back(sentence.what());
      }
    }
  }
}

std::vector<std::string> LasInputs::warnings() const
{
  if (this->IsMixed)
  {
    return { this->warningOfMixture() };
  }
  std::vector<std::string> warnings;
  // One sentence for all files of a kind, of which there may be many.
  const auto warnIf = [&](bool (*isSo)(const LasHeader&), const std::string& what)
  {
    const auto first = std::find_if(this->Headers.begin(), this->Headers.end(), isSo);
    const auto count = std::count_if(this->Headers.begin(), this->Headers.end(), isSo);
    if (count > 0)
    {
      const std::string others =
        count > 1 ? " (and so have " + std::to_string(count - 1) + " other inputs)" : "";
      const std::string& path = this->Paths[std::size_t(first - this->Headers.begin())];
      warnings.emplace_back(IOError(path, "has " + what + others + ".").what());
    }
  };
  warnIf([](const LasHeader& header) { return header.hasWaves(); },
    "wave packets, which are left out, since formats 6 to 8 have none");
  warnIf([](const LasHeader& header) { return !header.isExtended(); },
    "points of the formats 0 to 5: scan angles are rounded to 0.006 degrees, and class 12 becomes "
    "the flag overlap and class 1");
  warnIf([](const LasHeader& header) { return header.OtherRecords > 0; },
    "other variable length records, which are left out");
  warnIf([](const LasHeader& header) { return (header.Encoding & timeOffset) != 0; },
    "an offset of its GPS times, which is left out, since version 1.4 has none");
  this->warnOfExtras(warnings);
  return warnings;
}

} // namespace tipp
