// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippNpyFile_h
#define tippNpyFile_h

#include "Files/InputFile.h"
#include "Files/PendingFile.h"
#include "Npy/NpyHeader.h"
#include "vtkTIPPIOModule.h"

#include <cstdint>
#include <string>
#include <vector>

namespace tipp
{

/// Reads a table of numbers from NumPy's .npy format, versions 1 to 3
/// (https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html): rows x columns,
/// little-endian, C order. The header is checked completely, also against the file's size, before
/// memory is allocated.
class VTKTIPPIO_EXPORT NpyReader
{
public:
  enum class Type
  {
    Float32,
    Float64,
    Int32,
    Int64,
    UInt32,
    UInt64
  };

  /// Throws IOError unless the file is such a table.
  explicit NpyReader(const std::string& path);

  Type type() const { return this->Scalar; }
  bool isFloat() const { return this->Scalar == Type::Float32 || this->Scalar == Type::Float64; }
  std::int64_t rows() const { return this->Rows; }
  std::int64_t columns() const { return this->Columns; }

  /// Skips the next rows; throws IOError.
  void skipRows(std::int64_t rows);

  /// Reads the next `bytes` bytes of the data; throws IOError.
  void read(void* to, std::size_t bytes);

private:
  InputFile File;
  std::uint64_t Offset = 0;
  Type Scalar = Type::Float64;
  std::int64_t Rows = 0;
  std::int64_t Columns = 0;
};

/// Writes such an array of any shape; close() publishes the file.
class VTKTIPPIO_EXPORT NpyWriter
{
public:
  /// `descr` is NumPy's name of the scalar type, such as "<f8"; `before` as for PendingFile. Throws
  /// IOError.
  NpyWriter(const std::string& path, const std::string& descr,
    const std::vector<std::int64_t>& shape, const std::optional<PathState>& before = std::nullopt);

  void write(const void* from, std::size_t bytes);
  void close();

private:
  PendingFile Pending;
  std::uint64_t End = 0;
};

} // namespace tipp

#endif
