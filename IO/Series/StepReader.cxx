// SPDX-License-Identifier: BSD-3-Clause
#include "Series/StepReader.h"

#include "Files/IOError.h"
#include "Files/RawArray.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace tipp
{

Scalar storedType(Scalar type)
{
  const bool fitsFloat = type == Scalar::Float32 || type == Scalar::Int8 || type == Scalar::UInt8 ||
    type == Scalar::Int16 || type == Scalar::UInt16;
  return fitsFloat ? Scalar::Float32 : Scalar::Float64;
}

StepReader::StepReader(MeshSeries& series, std::size_t first, int components, bool marksMissing)
  : Series(series)
  , First(first)
  , Components(std::size_t(components))
  , MarksMissing(marksMissing)
  , Type(storedType(series.Variables[first].Type))
{
}

const void* StepReader::read(std::size_t step)
{
  for (std::size_t c = 0; c < this->Components; ++c)
  {
    const SeriesVariable& variable = this->Series.Variables[this->First + c];
    this->Series.read(this->First + c, step, this->Values);
    this->requireExact(variable);
    if (this->MarksMissing && !std::isnan(variable.Mark))
    {
      this->mark(variable.Mark);
    }
    if (this->Components == 1 && this->Type == Scalar::Float64)
    {
      return this->Values.data();
    }
    this->Bytes.resize(this->Values.size() * this->Components * scalarSize(this->Type));
    this->Type == Scalar::Float32 ? this->put<float>(c) : this->put<double>(c);
  }
  return this->Bytes.data();
}

void StepReader::mark(double mark)
{
  std::replace_if(
    this->Values.begin(), this->Values.end(), [](double value) { return std::isnan(value); }, mark);
}

void StepReader::requireExact(const SeriesVariable& variable) const
{
  constexpr double most = 9007199254740992; // 2^53: larger whole numbers are rounded as doubles
  const bool isWide = variable.Type == Scalar::Int64 || variable.Type == Scalar::UInt64;
  if (isWide &&
    std::any_of(this->Values.begin(), this->Values.end(),
      [](double value) { return std::fabs(value) >= most; }))
  {
    throw IOError(this->Series.Path,
      "has whole numbers of 2^53 and more in '" + variable.Name +
        "', which time steps cannot keep exactly; remove the array.");
  }
}

template <typename T>
void StepReader::put(std::size_t component)
{
  char* to = this->Bytes.data() + component * sizeof(T);
  for (const double value : this->Values)
  {
    const auto stored = T(value);
    std::memcpy(to, &stored, sizeof stored);
    to += this->Components * sizeof(T);
  }
}

} // namespace tipp
