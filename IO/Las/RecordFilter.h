// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRecordFilter_h
#define tippRecordFilter_h

#include "Files/RawValues.h"
#include "Las/LasHeader.h"
#include "Laz/LazChunk.h"
#include "Points/ReadPoints.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace tipp
{

/// Decides which records are selected.
class RecordFilter
{
public:
  RecordFilter(const LasHeader& header, const LasSelection& selection)
    : Extended(header.isExtended())
    , Kind(selection.Kind)
  {
    this->IsClassKept.fill(selection.Classes.empty());
    for (const int number : selection.Classes)
    {
      this->IsClassKept[std::size_t(number)] = true;
    }
    const bool asksForOverlap =
      std::count(selection.Classes.begin(), selection.Classes.end(), int(overlapClass)) > 0;
    if (!this->Extended && !selection.KeepOverlap && !asksForOverlap)
    {
      this->IsClassKept[overlapClass] = false;
    }
    // Version 1.0 has no flags: the whole byte is the class.
    this->ClassMask = this->Extended || header.Minor == 0 ? 255 : 31;
    const unsigned synthetic = this->Extended ? 1 : 32;
    const unsigned withheld = this->Extended ? 4 : 128;
    const unsigned overlap = this->Extended ? 8 : 0;
    this->LeftOut = header.Minor == 0 ? 0
                                      : (selection.KeepSynthetic ? 0 : synthetic) |
        (selection.KeepWithheld ? 0 : withheld) | (selection.KeepOverlap ? 0 : overlap);
  }

  /// The attributes of compressed points that decide.
  unsigned attributes() const
  {
    const bool isAnyClass =
      std::count(this->IsClassKept.begin(), this->IsClassKept.end(), false) == 0;
    return (isAnyClass ? 0 : laz::Class) | (this->LeftOut == 0 ? 0 : laz::Flags);
  }

  /// The class as formats 6 to 10 have it: overlap is a flag there, and the class is unknown.
  unsigned writtenClassOf(const char* record) const
  {
    constexpr unsigned unclassified = 1;
    return this->isOverlapClass(record) ? unclassified : this->classOf(record);
  }

  unsigned writtenFlagsOf(const char* record) const
  {
    const unsigned flags = valueAt<std::uint8_t>(record + 15);
    if (this->Extended)
    {
      return flags;
    }
    const unsigned ofClass = this->ClassMask == 31 ? flags >> 5 : 0;
    const unsigned ofScan = valueAt<std::uint8_t>(record + 14) & 0xC0U;
    return ofClass | (this->isOverlapClass(record) ? 8U : 0U) | ofScan;
  }

  unsigned returnsOf(const char* record) const
  {
    const unsigned returns = valueAt<std::uint8_t>(record + 14);
    return this->Extended ? returns : (returns & 7U) | (((returns >> 3) & 7U) << 4);
  }

  unsigned classOf(const char* record) const
  {
    return valueAt<std::uint8_t>(record + (this->Extended ? 16 : 15)) & this->ClassMask;
  }

  bool keeps(const char* record) const
  {
    return this->IsClassKept[this->classOf(record)] &&
      (valueAt<std::uint8_t>(record + 15) & this->LeftOut) == 0 && this->keepsReturn(record);
  }

private:
  static constexpr unsigned overlapClass = 12; ///< of formats 0 to 5

  bool isOverlapClass(const char* record) const
  {
    return !this->Extended && this->classOf(record) == overlapClass;
  }

  bool keepsReturn(const char* record) const
  {
    const unsigned returns = this->returnsOf(record);
    const unsigned number = returns & 15U;
    const unsigned count = returns >> 4;
    return this->Kind == LasSelection::Returns::All ||
      (this->Kind == LasSelection::Returns::First ? number <= 1 : number >= count);
  }

  bool Extended;
  LasSelection::Returns Kind;
  std::array<bool, 256> IsClassKept{};
  unsigned ClassMask;
  unsigned LeftOut;
};

} // namespace tipp

#endif
