// SPDX-License-Identifier: BSD-3-Clause
#include "Netcdf/NetcdfContent.h"

#include "Files/TextFile.h"

#include <algorithm>

namespace tipp
{

const NetcdfAttribute* NetcdfVariable::find(const std::string& name) const
{
  const auto found = std::find_if(this->Attributes.begin(), this->Attributes.end(),
    [&](const NetcdfAttribute& attribute) { return attribute.Name == name; });
  return found == this->Attributes.end() ? nullptr : &*found;
}

std::string NetcdfVariable::text(const std::string& name) const
{
  const NetcdfAttribute* const attribute = this->find(name);
  return attribute ? attribute->Text : "";
}

std::optional<double> NetcdfVariable::number(const std::string& name) const
{
  const NetcdfAttribute* const attribute = this->find(name);
  if (!attribute)
  {
    return std::nullopt;
  }
  if (!attribute->Numbers.empty())
  {
    return attribute->Numbers.front();
  }
  double value = 0;
  return parseNumber(attribute->Text, value) ? std::make_optional(value) : std::nullopt;
}

Scalar NetcdfVariable::unpackedType() const
{
  const NetcdfAttribute* const scale = this->find("scale_factor");
  const NetcdfAttribute* const packing = scale ? scale : this->find("add_offset");
  if (packing)
  {
    return packing->IsFloat ? Scalar::Float32 : Scalar::Float64;
  }
  return this->Type.value_or(Scalar::Float64);
}

const NetcdfVariable* NetcdfContent::find(const std::string& name) const
{
  const auto found = std::find_if(this->Variables.begin(), this->Variables.end(),
    [&](const NetcdfVariable& variable) { return variable.Name == name; });
  return found == this->Variables.end() ? nullptr : &*found;
}

const NetcdfVariable* NetcdfContent::findAny(const std::vector<std::string>& names) const
{
  for (const std::string& name : names)
  {
    if (const NetcdfVariable* const variable = this->find(name))
    {
      return variable;
    }
  }
  return nullptr;
}

int NetcdfContent::findDimension(const std::string& name) const
{
  const auto found = std::find_if(this->Dimensions.begin(), this->Dimensions.end(),
    [&](const NetcdfDimension& dimension) { return dimension.Name == name; });
  return name.empty() || found == this->Dimensions.end() ? -1
                                                         : int(found - this->Dimensions.begin());
}

std::vector<std::int64_t> NetcdfContent::shape(const NetcdfVariable& variable) const
{
  std::vector<std::int64_t> shape;
  for (const int dimension : variable.Dimensions)
  {
    shape.push_back(this->size(dimension));
  }
  return shape;
}

} // namespace tipp
