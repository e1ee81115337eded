// SPDX-License-Identifier: BSD-3-Clause
#include "Netcdf/NetcdfValues.h"

#include "Files/RawValues.h"

#include <algorithm>

namespace tipp
{
namespace
{

/// NetCDF's own fill values, for variables without _FillValue. Bytes have none: all values occur.
std::vector<double> usualFill(Scalar type)
{
  switch (type)
  {
    case Scalar::Int16:
      return { -32767 };
    case Scalar::UInt16:
      return { 65535 };
    case Scalar::Int32:
      return { -2147483647 };
    case Scalar::UInt32:
      return { 4294967295.0 };
    case Scalar::Int64:
      return { -9223372036854775806.0 };
    case Scalar::UInt64:
      return { 18446744073709551614.0 };
    case Scalar::Float32:
    case Scalar::Float64:
      return { 0x1.ep+122 };
    default:
      return {};
  }
}

/// The unsigned type of bytes that a classic file can only store as signed ones.
Scalar storedType(const NetcdfVariable& variable)
{
  const Scalar type = variable.Type.value_or(Scalar::Float64);
  if (variable.text("_Unsigned") != "true")
  {
    return type;
  }
  return type == Scalar::Int8 ? Scalar::UInt8
    : type == Scalar::Int16   ? Scalar::UInt16
    : type == Scalar::Int32   ? Scalar::UInt32
                              : type;
}

template <typename T>
void unpack(const NetcdfPacking& packing, const char* stored, std::size_t count, double* values)
{
  const bool isPlain = packing.Scale == 1 && packing.Offset == 0;
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const double fill = packing.Missing.empty() ? none : packing.Missing.front();
  for (std::size_t i = 0; i < count; ++i)
  {
    const auto value = double(valueAt<T>(stored + i * sizeof(T)));
    // A comparison with NaN is false, so that NaN remains.
    const bool isValid = value >= packing.Low && value <= packing.High && value != fill;
    values[i] = isValid ? value : none;
  }
  for (std::size_t m = 1; m < packing.Missing.size(); ++m)
  {
    std::replace(values, values + count, packing.Missing[m], none);
  }
  for (std::size_t i = 0; i < count && !isPlain; ++i)
  {
    values[i] = values[i] * packing.Scale + packing.Offset;
  }
}

} // namespace

NetcdfPacking packingOf(const NetcdfVariable& variable)
{
  NetcdfPacking packing;
  packing.Stored = storedType(variable);
  const double range = packing.Stored == Scalar::UInt8 ? 256
    : packing.Stored == Scalar::UInt16                 ? 65536
    : packing.Stored == Scalar::UInt32                 ? 4294967296.0
                                                       : 0;
  // Attributes of bytes that are unsigned by _Unsigned are signed.
  const auto asStored = [range](double value)
  { return value < 0 && range > 0 ? value + range : value; };
  packing.Missing = usualFill(packing.Stored);
  for (const char* name : { "_FillValue", "missing_value" })
  {
    const NetcdfAttribute* const attribute = variable.find(name);
    std::vector<double> numbers = attribute ? attribute->Numbers : std::vector<double>();
    if (const auto written = variable.number(name); numbers.empty() && written)
    {
      numbers.push_back(*written); // as text
    }
    if (!numbers.empty())
    {
      packing.Missing = name[0] == '_' ? std::vector<double>() : packing.Missing;
      std::transform(numbers.begin(), numbers.end(), std::back_inserter(packing.Missing), asStored);
    }
  }
  packing.Low = asStored(variable.number("valid_min").value_or(packing.Low));
  packing.High = asStored(variable.number("valid_max").value_or(packing.High));
  const NetcdfAttribute* const valid = variable.find("valid_range");
  if (valid && valid->Numbers.size() == 2)
  {
    packing.Low = asStored(valid->Numbers[0]);
    packing.High = asStored(valid->Numbers[1]);
  }
  packing.Scale = variable.number("scale_factor").value_or(1);
  packing.Offset = variable.number("add_offset").value_or(0);
  return packing;
}

void unpackValues(
  const NetcdfPacking& packing, const char* stored, std::size_t count, double* values)
{
  withScalar(
    packing.Stored, [&](auto type) { unpack<decltype(type)>(packing, stored, count, values); });
}

} // namespace tipp
