// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSmsText_h
#define tippSmsText_h

#include "Series/SmsDatasets.h"

#include <cstdint>
#include <string>
#include <vector>

namespace tipp
{

/// Adds steps to a dataset of a mesh.
class SmsStep
{
public:
  SmsStep(const std::string& path, const SmsMeshShape& shape, SmsDataset& dataset);

  /// Throws IOError unless a file with values at so many nodes belongs to the mesh; `cells` may be
  /// 0, if the file does not say.
  void checkSize(std::int64_t nodes, std::int64_t cells) const;

  /// Adds the values of a step, as many as checkSize() has accepted times the components.
  /// `activeCells`: which cells have values; empty: all.
  void add(double time, const std::vector<double>& values, const std::vector<bool>& activeCells);

private:
  std::vector<bool> activeNodes(const std::vector<bool>& activeCells) const;

  const std::string& Path;
  const SmsMeshShape& Shape;
  SmsDataset& Dataset;
};

///@{
/// readSmsDatasets() for one of the two kinds of files.
std::vector<SmsDataset> readSmsText(const std::string& path, const SmsMeshShape& shape);
std::vector<SmsDataset> readBinarySmsDatasets(const std::string& path, const SmsMeshShape& shape);
///@}

/// Returns "hours since 1950-01-01 00:00:00" and its like for a unit and the Julian day of the
/// origin; the unit alone for day 0.
std::string smsTimeUnits(const std::string& unit, double julianDay);

} // namespace tipp

#endif
