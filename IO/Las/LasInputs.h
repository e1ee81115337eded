// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippLasInputs_h
#define tippLasInputs_h

#include "Las/LasHeader.h"
#include "Las/LasTransform.h"
#include "Points/ReadPoints.h"

#include <string>
#include <vector>

namespace tipp
{

/// LAS files whose points are to be written to one file.
class LasInputs
{
public:
  /// Empty if one of the files is of another kind. Throws IOError.
  LasInputs(const std::vector<std::string>& paths, const LasSelection& selection);

  bool isEmpty() const { return this->Headers.empty(); }
  const std::vector<LasHeader>& headers() const { return this->Headers; }

  /// The fields that the output has.
  LasFields fields() const;
  /// The extra bytes that all files have, as in the first one.
  const std::vector<LasExtra>& extras() const { return this->Extras; }
  /// The descriptions of these, of which bytes without one are the last.
  std::string descriptors() const;

  /// Whether all files have the same scales and offsets.
  bool haveSameTransform() const;
  LasTransform transformOf(std::size_t file) const;
  /// The finest scale of an axis.
  double finestScale(std::size_t axis) const;

  /// Whether the GPS times are standard times. Throws IOError if files differ.
  bool haveStandardTime() const;
  /// Whether a file says that its return numbers were made by software.
  bool haveSyntheticReturns() const;
  /// The system identifier of the output.
  std::string system() const;

  /// Sentences about what is not written as it is.
  std::vector<std::string> warnings() const;

private:
  void findExtras();
  std::string warningOfMixture() const;
  void warnOfExtras(std::vector<std::string>& warnings) const;

  std::vector<std::string> Paths; ///< of the LAS files
  bool IsMixed = false;           ///< whether there are files of other kinds, too
  std::vector<LasHeader> Headers; ///< empty if so
  std::vector<LasExtra> Extras;
};

} // namespace tipp

#endif
