// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippLasSelection_h
#define tippLasSelection_h

#include <cstdint>
#include <string>
#include <vector>

namespace tipp
{

/// Which points of a LAS file are read.
struct LasSelection
{
  enum class Returns
  {
    All,
    First,
    Last
  };

  std::vector<int> Classes; ///< empty: all
  Returns Kind = Returns::All;
  bool KeepWithheld = false;
  bool KeepSynthetic = false;
  /// Points of a swath that another one overlaps: a flag in formats 6 to 10, class 12 in others.
  bool KeepOverlap = false;

  /// Whether it is asked for what only LAS files have.
  bool isGiven() const { return !this->Classes.empty() || this->Kind != Returns::All; }

  /// The same for equal selections.
  std::string text() const
  {
    std::string text = std::to_string(int(this->Kind)) + (this->KeepWithheld ? "w" : "") +
      (this->KeepSynthetic ? "s" : "") + (this->KeepOverlap ? "o" : "");
    for (const int number : this->Classes)
    {
      text += "," + std::to_string(number);
    }
    return text;
  }
};

} // namespace tipp

#endif
