// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippNpyFile_h
#define tippNpyFile_h

#include "Files/InputFile.h"
#include "Files/PendingOutput.h"
#include "vtkTIPPIOModule.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tipp
{

class InputFile;

/// The dictionary at the start of an .npy file.
struct NpyHeader
{
  std::string Descr;               ///< NumPy's name of the scalar type, such as "<f8"
  bool FortranOrder = false;       ///< whether the array is stored column by column
  std::vector<std::int64_t> Shape; ///< extent along each axis
};

/// Parses the dictionary; nullopt unless it has exactly the three keys with plain values, and no
/// negative extent.
std::optional<NpyHeader> parseNpyHeader(std::string_view text);

/// Reads the dictionary of a file of version 1 to 3 and the offset of its data in bytes; throws
/// IOError.
NpyHeader readNpyHeader(const InputFile& file, std::uint64_t& dataOffset);

/// Returns the bytes before the data of a file of version 1; the data start at a multiple of 64
/// bytes.
std::string npyFileStart(const std::string& descr, const std::vector<std::int64_t>& shape);

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

/// Writes x and y interleaved as an .npy file of n x 2 float64; `before` as for PendingFile. Throws
/// IOError.
VTKTIPPIO_EXPORT void writePoints(const std::string& path, const std::vector<double>& xy,
  const std::optional<PathState>& before = std::nullopt);

} // namespace tipp

#endif
