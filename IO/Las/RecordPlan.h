// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRecordPlan_h
#define tippRecordPlan_h

#include "Las/LasInputs.h"
#include "Las/LasTransform.h"
#include "Las/LasWriter.h"
#include "Points/ReadPoints.h"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace tipp
{

/// The number of points to read at once: fewer if they have many columns.
std::size_t blockPointsOf(const PointStream& points);

/// What the points of a stream are like, found in a pass over them.
class RecordSurvey
{
public:
  /// `height`: the column of z; the number of columns: none.
  RecordSurvey(PointStream& points, std::size_t height);

  const AxisSurvey& axis(std::size_t number) const { return this->Axes[number]; }

  /// Whether all values of a column fit into the LAS field of its name.
  bool fits(const std::string& column) const;

private:
  void add(const PointBlock& block, std::size_t height);

  const std::vector<std::string> Columns;
  std::array<AxisSurvey, 3> Axes;
  std::vector<bool> Fits;
};

/// A column, and where the records have it.
struct RecordField
{
  std::size_t Column;
  std::size_t Offset;
  std::size_t Size; ///< bytes of a whole number; 8: of a double
};

/// The layout of a file, and which columns its records have.
struct RecordPlan
{
  LasLayout Layout;
  std::vector<RecordField> Fields;
  std::size_t Height = 0; ///< the column of z; the number of columns: none
  bool AreReturnsGiven = false;
  std::optional<double> NoData = {}; ///< for fields of LAS files that are missing
};

/// Adds the columns of other files than LAS, all but plan.Height. Extra bytes that would have the
/// name of a field get another one, and a warning. Throws IOError, about the output.
void planColumns(const std::string& output, const std::vector<std::string>& columns,
  const RecordSurvey& survey, RecordPlan& plan, std::vector<std::string>& warnings);

/// Adds the columns of LAS files (LasFields).
void planFields(const LasInputs& inputs, const std::vector<std::string>& columns, RecordPlan& plan);

} // namespace tipp

#endif
