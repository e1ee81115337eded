// SPDX-License-Identifier: BSD-3-Clause
#include "Netcdf/ClassicHeader.h"

#include "Files/IOError.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace tipp
{
namespace
{

/// Sizes are compared as doubles, which cannot overflow.
constexpr double largest = 9e18;

class HeaderReader
{
public:
  explicit HeaderReader(const InputFile& file)
    : File(file)
  {
    const std::uint64_t magic = this->next(4);
    this->Version = magic & 0xff;
    if (this->Version != 1 && this->Version != 2 && this->Version != 5)
    {
      this->fail("its version is " + std::to_string(this->Version));
    }
  }

  void check()
  {
    const std::uint64_t streaming = this->countBytes() == 4 ? 0xffffffffU : ~std::uint64_t(0);
    this->Records = this->count();
    this->Records = this->Records == streaming ? 0 : this->Records;
    this->readDimensions();
    this->skipAttributes();
    const std::uint64_t variables = this->listOf(11);
    for (std::uint64_t i = 0; i < variables; ++i)
    {
      this->readVariable();
    }
    this->checkSize();
  }

private:
  struct Variable
  {
    double Begin;
    double Bytes; ///< of a record, if it varies by record
    bool HasRecords;
  };

  [[noreturn]] void fail(const std::string& problem) const
  {
    throw IOError(this->File.path(),
      "is damaged: in the header at byte " + std::to_string(this->Offset) + " " + problem +
        "; copy it again.");
  }

  std::uint64_t countBytes() const { return this->Version == 5 ? 8 : 4; }

  /// Reads a big-endian integer.
  std::uint64_t next(std::uint64_t bytes)
  {
    std::array<unsigned char, 8> raw{};
    this->File.read(this->Offset, raw.data(), std::size_t(bytes));
    this->Offset += bytes;
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < bytes; ++i)
    {
      value = value << 8 | raw[i];
    }
    return value;
  }

  std::uint64_t count() { return this->next(this->countBytes()); }

  void skip(std::uint64_t bytes)
  {
    const std::uint64_t left = this->File.size() - this->Offset;
    const std::uint64_t padding = (4 - bytes % 4) % 4;
    if (bytes > left || padding > left - bytes)
    {
      this->fail("there are " + std::to_string(bytes) + " bytes more than the file has");
    }
    this->Offset += bytes + padding;
  }

  void skipName() { this->skip(this->count()); }

  /// Reads the beginning of a list: its kind and length. The kind of an empty one may be 0.
  std::uint64_t listOf(std::uint64_t kind)
  {
    const std::uint64_t found = this->next(4);
    const std::uint64_t items = this->count();
    constexpr std::uint64_t leastBytes = 8; // of an item
    if ((found != kind && (found != 0 || items != 0)) || items > this->File.size() / leastBytes)
    {
      this->fail("there is no list that fits");
    }
    return items;
  }

  std::uint64_t typeBytes()
  {
    constexpr std::array<std::uint64_t, 12> bytes = { 0, 1, 1, 2, 4, 4, 8, 1, 2, 4, 8, 8 };
    const std::uint64_t type = this->next(4);
    if (type == 0 || type >= bytes.size())
    {
      this->fail("there is the unknown type " + std::to_string(type));
    }
    return bytes[std::size_t(type)];
  }

  void readDimensions()
  {
    for (std::uint64_t left = this->listOf(10); left > 0; --left)
    {
      this->skipName();
      this->Dimensions.push_back(this->count());
    }
  }

  void skipAttributes()
  {
    for (std::uint64_t left = this->listOf(12); left > 0; --left)
    {
      this->skipName();
      const std::uint64_t bytes = this->typeBytes();
      const std::uint64_t values = this->count();
      if (values > this->File.size())
      {
        this->fail("there is an attribute longer than the file");
      }
      this->skip(values * bytes);
    }
  }

  void readVariable()
  {
    this->skipName();
    const std::uint64_t dimensions = this->count();
    if (dimensions > this->File.size())
    {
      this->fail("there are more dimensions than the file has bytes");
    }
    Variable variable{ 0, 1, false };
    for (std::uint64_t i = 0; i < dimensions; ++i)
    {
      const std::uint64_t id = this->count();
      if (id >= this->Dimensions.size())
      {
        this->fail("there is the unknown dimension " + std::to_string(id));
      }
      const std::uint64_t size = this->Dimensions[std::size_t(id)];
      variable.HasRecords = variable.HasRecords || (i == 0 && size == 0);
      variable.Bytes *= i == 0 && size == 0 ? 1 : double(size);
    }
    this->skipAttributes();
    variable.Bytes *= double(this->typeBytes());
    this->count(); // the size, which does not hold those of large variables
    variable.Begin = double(this->next(this->Version == 1 ? 4 : 8));
    this->Variables.push_back(variable);
  }

  void checkSize() const
  {
    const auto padded = [](double bytes)
    { return bytes < largest ? double((std::uint64_t(bytes) + 3) / 4 * 4) : bytes; };
    const auto varying = std::count_if(this->Variables.begin(), this->Variables.end(),
      [](const Variable& variable) { return variable.HasRecords; });
    double record = 0;
    for (const Variable& variable : this->Variables)
    {
      // The records of a single variable are not padded.
      record += !variable.HasRecords ? 0 : varying == 1 ? variable.Bytes : padded(variable.Bytes);
    }
    double end = 0;
    for (const Variable& variable : this->Variables)
    {
      const double before = variable.HasRecords ? (double(this->Records) - 1) * record : 0;
      const bool isEmpty = variable.HasRecords && this->Records == 0;
      end = std::max(end, isEmpty ? 0 : variable.Begin + before + variable.Bytes);
    }
    if (end > double(this->File.size()))
    {
      throw IOError(this->File.path(),
        "ends at byte " + std::to_string(this->File.size()) +
          ", before its values do; copy or "
          "make it again.");
    }
  }

  const InputFile& File;
  std::uint64_t Offset = 0;
  std::uint64_t Version = 0;
  std::uint64_t Records = 0;
  std::vector<std::uint64_t> Dimensions; ///< their sizes; 0 for that of records
  std::vector<Variable> Variables;
};

} // namespace

void checkClassicFile(const InputFile& file)
{
  HeaderReader(file).check();
}

} // namespace tipp
