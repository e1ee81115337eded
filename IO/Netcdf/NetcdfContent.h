// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippNetcdfContent_h
#define tippNetcdfContent_h

#include "Arrays/Scalar.h"
#include "vtkTIPPIOModule.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace tipp
{

/// An attribute of a NetCDF file or of a variable in it: text or numbers.
struct NetcdfAttribute
{
  std::string Name;
  std::string Text;
  std::vector<double> Numbers;
  bool IsFloat = false; ///< the numbers are stored as 32-bit floats
};

struct NetcdfDimension
{
  std::string Name;
  std::int64_t Size = 0;
};

/// A variable of a NetCDF file, without its values.
struct VTKTIPPIO_EXPORT NetcdfVariable
{
  std::string Name;
  int Id = 0;
  std::optional<Scalar> Type; ///< nullopt for text and user-defined types
  bool IsText = false;        ///< an array of characters
  std::vector<int> Dimensions;
  std::vector<NetcdfAttribute> Attributes;

  /// Returns an attribute, or null.
  const NetcdfAttribute* find(const std::string& name) const;
  /// Returns the text of an attribute; empty if there is none.
  std::string text(const std::string& name) const;
  /// Returns the first number of an attribute, also one written as text, if there is one.
  std::optional<double> number(const std::string& name) const;
  /// The type of the values after scale_factor and add_offset.
  Scalar unpackedType() const;
};

/// What a NetCDF file has: all but the values.
struct VTKTIPPIO_EXPORT NetcdfContent
{
  std::vector<NetcdfDimension> Dimensions;
  std::vector<NetcdfVariable> Variables;
  std::vector<NetcdfAttribute> Attributes;

  /// Returns a variable, or null.
  const NetcdfVariable* find(const std::string& name) const;
  /// Returns the first variable of these names, or null.
  const NetcdfVariable* findAny(const std::vector<std::string>& names) const;
  /// Returns the index of a dimension, or -1.
  int findDimension(const std::string& name) const;
  std::int64_t size(int dimension) const { return this->Dimensions[std::size_t(dimension)].Size; }
  /// The extents along the variable's dimensions.
  std::vector<std::int64_t> shape(const NetcdfVariable& variable) const;
};

///@{
/// For SaveArchive and LoadArchive.
template <typename Archive>
void serialize(Archive& archive, NetcdfAttribute& attribute)
{
  archive(attribute.Name, attribute.Text, attribute.Numbers, attribute.IsFloat);
}
template <typename Archive>
void serialize(Archive& archive, NetcdfDimension& dimension)
{
  archive(dimension.Name, dimension.Size);
}
template <typename Archive>
void serialize(Archive& archive, NetcdfVariable& variable)
{
  archive(variable.Name, variable.Id, variable.Type, variable.IsText, variable.Dimensions,
    variable.Attributes);
}
template <typename Archive>
void serialize(Archive& archive, NetcdfContent& content)
{
  archive(content.Dimensions, content.Variables, content.Attributes);
}
///@}

} // namespace tipp

#endif
