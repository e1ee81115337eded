// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTableColumns_h
#define tippTableColumns_h

#include "vtkTIPPIOModule.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace tipp
{

/// The indices of the columns that are x, y and z.
struct ColumnChoice
{
  std::size_t X = 0;
  std::size_t Y = 1;
  std::optional<std::size_t> Z = {}; ///< nullopt: there are no heights
  bool IsDepth = false;              ///< Z is a depth, whose values count downwards
};

/// What the name of a column says that it holds.
enum class ColumnRole
{
  None,
  X,
  Y,
  Z,
  Id ///< a number or name of the point, or a text about it: never a coordinate
};

/// Returns the role of a name such as "POINT_X", "Easting (m)" or "OBJECTID".
ColumnRole columnRole(const std::string& name);

/// Whether two words are one name, such as "Pt" and "No", or "X" and "Coord".
bool isOneName(const std::string& first, const std::string& second);

/// Whether the name is that of a text about the point, such as "remark" or "code".
bool isTextColumn(const std::string& name);

/// Finds x and y, and z if there is one, by the usual names in any case: x, y, z; easting,
/// northing, elevation; lon, lat, height; POINT_X, RD_Y and others. Exact names come before names
/// with a prefix or a unit, and projected coordinates before longitude and latitude. Returns
/// nullopt if x or y is not found. Throws std::invalid_argument if two columns fit equally well;
/// the caller adds how to choose them.
VTKTIPPIO_EXPORT std::optional<ColumnChoice> findCoordinates(const std::vector<std::string>& names);

/// Returns x, y and z of a table whose columns have these names, for which a caller has to choose.
/// Two columns of unknown names are x and y. Throws std::invalid_argument if the names do not tell,
/// with a list of them; the caller adds how to choose.
VTKTIPPIO_EXPORT ColumnChoice requireCoordinates(const std::vector<std::string>& names);

/// Finds the column of heights, or else of depths, among the names, and sets Z and IsDepth.
void findHeights(const std::vector<std::string>& names, ColumnChoice& choice);

/// The names, separated by commas; after twenty the number of the others.
std::string listOf(const std::vector<std::string>& names);

/// Makes all names different: of equal names, the later ones get _2, _3 and so on. Returns those
/// that were changed, as they were.
std::vector<std::string> makeDifferent(std::vector<std::string>& names);

} // namespace tipp

#endif
