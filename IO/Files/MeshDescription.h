// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippMeshDescription_h
#define tippMeshDescription_h

#include "vtkTIPPIOModule.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace tipp
{

/// What the values of an array are, in the manner of CF. Texts may be empty.
struct VTKTIPPIO_EXPORT ArrayDescription
{
  std::string LongName;
  std::string StandardName;
  std::string Units;
  std::optional<double> Missing;       ///< the value that stands for none, such as -99999
  std::vector<std::string> Components; ///< their names, such as u and v; empty: not named

  bool isEmpty() const
  {
    return this->LongName.empty() && this->StandardName.empty() && this->Units.empty() &&
      !this->Missing && this->Components.empty();
  }

  /// The name of a component as an array of its own: its own name, or else the array's and its
  /// number; the array's name if it has one component.
  std::string nameOf(const std::string& array, int component, int components) const;
};

/// What the numbers of a stored mesh mean, in the manner of CF: what the output of a model states
/// and arrays of numbers do not.
struct VTKTIPPIO_EXPORT MeshDescription
{
  std::string TimeUnits; ///< such as "seconds since 2008-09-01"; empty: unknown
  std::string Calendar;  ///< empty: the standard one
  std::string Crs;       ///< as MeshSeries::Crs
  ///@{ By the arrays' names, in UTF-8; names of arrays that the mesh does not have are ignored.
  std::map<std::string, ArrayDescription> PointData;
  std::map<std::string, ArrayDescription> CellData;
  ///@}

  bool isEmpty() const;

  /// The description of an array; an empty one if there is none.
  ArrayDescription arrayOf(const std::string& name, bool onCells) const;

  /// Adds the description of an array, unless it is empty.
  void add(const std::string& name, bool onCells, const ArrayDescription& array);
};

/// Returns the description as JSON, on one line or indented; Documentation/PartitionedMesh.md lists
/// the keys.
std::string descriptionText(const MeshDescription& description, bool isIndented);

/// Parses such a text, which is part of the file `path`. Keys of other names are ignored. Throws
/// IOError.
MeshDescription parseDescription(const std::string& text, const std::string& path);

/// Whether a text from a file may be handed to GDAL as a reference system: WKT, PROJJSON, a text
/// for PROJ, or a name or code such as "EPSG:4326". GDAL would open any other text as a file or as
/// an address in the network.
VTKTIPPIO_EXPORT bool isCrsText(const std::string& text);

} // namespace tipp

#endif
