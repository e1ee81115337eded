// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippNpyFile_h
#define tippNpyFile_h

#include "Arrays/Scalar.h"
#include "Files/InputFile.h"
#include "Files/PendingOutput.h"
#include "vtkTIPPIOModule.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace tipp
{

/// Where an .npy file has its array, and the type and shape. Parts of it can be read alone.
struct NpyArray
{
  std::string Path;
  std::uint64_t Offset = 0; ///< of the data, in bytes
  Scalar Type = Scalar::Float64;
  std::vector<std::int64_t> Shape; ///< extent along each axis

  /// For messages, such as "3 x 4".
  std::string shapeText() const;
};

/// Reads the header of NumPy's .npy format, versions 1 to 3
/// (https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html), and checks it
/// completely, also against the file's size. The array must be little-endian and in C order.
/// Booleans are read as UInt8. Throws IOError.
NpyArray openNpyArray(const InputFile& file);

/// Returns the bytes before the data of a file of version 1; the data start at a multiple of 64
/// bytes.
std::string npyFileStart(const std::string& descr, const std::vector<std::int64_t>& shape);

/// Reads a table of float64, float32 or integers of 32 or 64 bits from an .npy file: rows x
/// columns.
class VTKTIPPIO_EXPORT NpyReader
{
public:
  /// Throws IOError unless the file is such a table; see openNpyArray().
  explicit NpyReader(const std::string& path);

  Scalar type() const { return this->Array.Type; }
  bool isFloat() const
  {
    return this->type() == Scalar::Float32 || this->type() == Scalar::Float64;
  }
  std::int64_t rows() const { return this->Array.Shape[0]; }
  std::int64_t columns() const { return this->Array.Shape[1]; }

  /// Continues reading at a row, counted from 0.
  void seekRow(std::int64_t row);

  /// Reads the next `bytes` bytes of the data; throws IOError.
  void read(void* to, std::size_t bytes);

private:
  InputFile File;
  NpyArray Array;
  std::uint64_t Offset; ///< of the next bytes to read
};

/// Writes an .npy array of any shape; close() publishes the file.
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
