// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippAttribute_h
#define tippAttribute_h

#include <cstdint>
#include <type_traits>

namespace tipp
{

/// The numbers that an array is made of.
enum class Scalar
{
  Float32,
  Float64,
  Int8,
  Int16,
  Int32,
  Int64,
  UInt8,
  UInt16,
  UInt32,
  UInt64
};

/// An array of a mesh and the array of samples to fill from it.
struct Attribute
{
  /// Of the points, or the cells; Components a tuple. Null: all are NullValue.
  const void* Values = nullptr;
  void* Samples = nullptr; ///< as many Components for each sample
  Scalar Type = Scalar::Float64;
  int Components = 1;
  bool OfCells = false;
  double NullValue = 0; ///< what samples in no cell get
};

/// Calls work(value) with a value of the C++ type.
template <typename Work>
void withScalar(Scalar type, const Work& work)
{
  switch (type) // NOLINT(bugprone-branch-clone): the types differ.
  {
    case Scalar::Float32:
      return work(float());
    case Scalar::Float64:
      return work(double());
    case Scalar::Int8:
      return work(std::int8_t());
    case Scalar::Int16:
      return work(std::int16_t());
    case Scalar::Int32:
      return work(std::int32_t());
    case Scalar::Int64:
      return work(std::int64_t());
    case Scalar::UInt8:
      return work(std::uint8_t());
    case Scalar::UInt16:
      return work(std::uint16_t());
    case Scalar::UInt32:
      return work(std::uint32_t());
    case Scalar::UInt64:
      return work(std::uint64_t());
  }
}

} // namespace tipp

#endif
