// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippHdfObjects_h
#define tippHdfObjects_h

#include "Arrays/Scalar.h"
#include "vtkTIPPIOModule.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace tipp
{

/// The position of an object of an HDF5 file, in bytes from the superblock.
using HdfAddress = std::uint64_t;

/// The type of an array's elements, and the array's size in each dimension.
struct HdfShape
{
  Scalar Type = Scalar::Float64;
  std::vector<std::uint64_t> Sizes;
};

/// Some tuples of a virtual array: all tuples of another array. The names are those that HDF5
/// resolves: a path relative to the folder of the file, or "." for the same file, and the path of
/// the array in that file.
struct HdfSource
{
  std::string File;
  std::string Array;
  std::uint64_t First = 0; ///< the first tuple in the virtual array
  std::uint64_t Count = 0;
};

/// An object of a group, and its name there.
struct HdfLink
{
  std::string Name;
  HdfAddress Object = 0;
};

/// Encodes objects of an HDF5 file one after the other, without the HDF5 library: arrays, groups
/// and virtual arrays, which HDF5 1.10 and later read. The format is specified by "HDF5 File Format
/// Specification Version 3.0"
/// (https://support.hdfgroup.org/documentation/hdf5/latest/_f_m_t3.html).
class VTKTIPPIO_EXPORT HdfObjects
{
public:
  static constexpr std::size_t superblockBytes = 48;
  /// The largest number of bytes of a name in a group.
  static constexpr std::size_t mostNameBytes = 1000;
  /// The address of an array without elements.
  static constexpr HdfAddress nowhere = ~HdfAddress(0);

  HdfObjects();

  /// The address of the next object.
  HdfAddress end() const { return this->Taken + this->Pending.size(); }
  /// Returns the bytes since the last call; the first ones are the superblock's, which are zeros.
  std::string take();

  HdfAddress addBytes(const void* data, std::size_t bytes);
  /// An array whose elements are at `data`, little-endian and in one run.
  HdfAddress addArray(const HdfShape& shape, HdfAddress data);
  /// A one-dimensional array, with its elements.
  HdfAddress addNumbers(const std::vector<std::int64_t>& numbers);
  HdfAddress addNumbers(const std::vector<double>& numbers);
  /// An array of zeros except for the tuples of the sources, which must ascend.
  HdfAddress addVirtualArray(const HdfShape& shape, const std::vector<HdfSource>& sources);
  /// `attributes`: the results of textAttribute() and numberAttribute().
  HdfAddress addGroup(
    const std::vector<HdfLink>& links, const std::vector<std::string>& attributes = {});

  static std::string textAttribute(const std::string& name, const std::string& text);
  /// One number is a scalar; several are an array.
  static std::string numberAttribute(
    const std::string& name, const std::vector<std::int64_t>& numbers);

  /// `base`: the position of the superblock in the file, 0 or 512 times a power of two;
  /// `fileBytes`: the end of the last object or array in the file.
  static std::string superblock(std::uint64_t base, std::uint64_t fileBytes, HdfAddress root);

private:
  HdfAddress addHeader(const std::string& messages);

  std::string Pending;
  std::uint64_t Taken = 0;
};

/// Names that a group may have: each once, without slashes. The others are changed.
VTKTIPPIO_EXPORT std::vector<std::string> hdfNamesOf(const std::vector<std::string>& names);

} // namespace tipp

#endif
