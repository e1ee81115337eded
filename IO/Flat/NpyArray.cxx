// SPDX-License-Identifier: BSD-3-Clause
#include "Flat/NpyArray.h"

#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Npy/NpyFile.h"

namespace tipp
{
namespace
{

Scalar scalarOf(const std::string& descr, const std::string& path)
{
  if (descr == "|b1")
  {
    return Scalar::UInt8;
  }
  if (const std::optional<Scalar> type = scalarFromDescr(descr))
  {
    return *type;
  }
  throw IOError(path,
    "holds elements of type '" + descr +
      "'; save it as little-endian integers, float32 or float64.");
}

} // namespace

std::string NpyArray::shapeText() const
{
  std::string text;
  for (const std::int64_t extent : this->Shape)
  {
    text += (text.empty() ? "" : " x ") + std::to_string(extent);
  }
  return text.empty() ? "a single number" : text;
}

NpyArray openNpyArray(const std::string& path)
{
  const InputFile file(path);
  NpyArray array;
  array.Path = path;
  const NpyHeader header = readNpyHeader(file, array.Offset);
  array.Shape = header.Shape;
  array.Type = scalarOf(header.Descr, path);
  if (header.FortranOrder && header.Shape.size() > 1)
  {
    throw IOError(path, "is in Fortran order; save numpy.ascontiguousarray of it.");
  }
  std::int64_t expected = std::int64_t(scalarSize(array.Type));
  bool overflow = false;
  for (const std::int64_t extent : array.Shape)
  {
    overflow = __builtin_mul_overflow(expected, extent, &expected) || overflow;
  }
  const std::uint64_t present = file.size() - array.Offset;
  if (overflow || std::uint64_t(expected) != present)
  {
    throw IOError(path,
      "holds " + std::to_string(present) + " bytes of data where its header's " +
        array.shapeText() + " elements need " +
        (overflow ? "more than 2^63" : std::to_string(expected)) + "; copy or save it again.");
  }
  return array;
}

} // namespace tipp
