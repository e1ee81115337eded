// SPDX-License-Identifier: BSD-3-Clause
#include "Series/SmsDatasets.h"

#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Files/RawValues.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace tipp
{
namespace
{

/// Reads datasets in SMS's binary format: numbered cards, each with values of a fixed size.
class BinaryReader
{
public:
  BinaryReader(const std::string& path, const SmsMeshShape& shape)
    : Path(path)
    , Shape(shape)
    , File(path)
  {
    this->next<std::int32_t>(); // the version
  }

  std::vector<SmsDataset> read()
  {
    while (this->Offset + sizeof(std::int32_t) <= this->File.size())
    {
      this->readCard(this->next<std::int32_t>());
    }
    if (this->IsOpen || this->Datasets.empty())
    {
      throw IOError(this->Path, "ends before a dataset does; copy it again.");
    }
    return std::move(this->Datasets);
  }

private:
  enum Card : std::int32_t
  {
    ObjectType = 100,
    FloatBytes = 110,
    FlagBytes = 120,
    BeginScalar = 130,
    BeginVector = 140,
    VectorType = 150,
    ObjectId = 160,
    Nodes = 170,
    Cells = 180,
    Name = 190,
    Step = 200,
    End = 210,
    ReferenceTime = 240,
    TimeUnit = 250
  };

  template <typename T>
  T next()
  {
    std::array<char, sizeof(T)> bytes{};
    this->File.read(this->Offset, bytes.data(), bytes.size());
    this->Offset += bytes.size();
    return valueAt<T>(bytes.data());
  }

  [[noreturn]] void fail(const std::string& problem) const
  {
    throw IOError(this->Path,
      "is damaged: at byte " + std::to_string(this->Offset) + " it " + problem +
        "; copy it again.");
  }

  void readCard(std::int32_t card)
  {
    switch (card)
    {
      case ObjectType:
      case VectorType:
      case ObjectId:
        this->next<std::int32_t>();
        break;
      case FloatBytes:
        this->checkBytes(this->next<std::int32_t>(), { 4, 8 }, this->BytesOfFloat);
        break;
      case FlagBytes:
        this->checkBytes(this->next<std::int32_t>(), { 1, 4 }, this->BytesOfFlag);
        break;
      case BeginScalar:
      case BeginVector:
        this->begin(card == BeginVector ? 2 : 1);
        break;
      case Nodes:
        this->NodeCount = this->next<std::int32_t>();
        break;
      case Cells:
        this->CellCount = this->next<std::int32_t>();
        break;
      case ReferenceTime:
        this->JulianDay = this->next<double>();
        break;
      case TimeUnit:
        this->readTimeUnit();
        break;
      case Name:
        this->readName();
        break;
      case Step:
        this->readStep();
        break;
      case End:
        this->end();
        break;
      default:
        fail("has the card " + std::to_string(card) + ", which is unknown");
    }
  }

  void checkBytes(std::int32_t bytes, std::array<std::int32_t, 2> allowed, std::size_t& result)
  {
    if (bytes != allowed[0] && bytes != allowed[1])
    {
      fail("announces numbers of " + std::to_string(bytes) + " bytes");
    }
    result = std::size_t(bytes);
  }

  SmsDataset& open()
  {
    if (!this->IsOpen)
    {
      fail("has a card before the beginning of a dataset");
    }
    return this->Datasets.back();
  }

  void begin(int components)
  {
    if (this->IsOpen)
    {
      fail("begins a dataset in another one");
    }
    this->IsOpen = true;
    this->Datasets.emplace_back();
    this->Datasets.back().Name = "values";
    this->Datasets.back().Components = components;
  }

  void end()
  {
    if (this->open().Times.empty())
    {
      fail("ends a dataset without a time step");
    }
    this->open().TimeUnits = smsTimeUnits(this->Unit, this->JulianDay);
    this->open().Type = this->BytesOfFloat == 4 ? Scalar::Float32 : Scalar::Float64;
    this->IsOpen = false;
  }

  void readTimeUnit()
  {
    const std::int32_t unit = this->next<std::int32_t>();
    constexpr std::array<const char*, 5> units = { "hours", "minutes", "seconds", "", "days" };
    this->Unit = unit >= 0 && unit < std::int32_t(units.size()) ? units[std::size_t(unit)] : "";
  }

  void readName()
  {
    std::array<char, 40> bytes{};
    this->File.read(this->Offset, bytes.data(), bytes.size());
    this->Offset += bytes.size();
    const std::string name(bytes.begin(), std::find(bytes.begin(), bytes.end(), '\0'));
    this->open().Name = name.substr(0, name.find_last_not_of(' ') + 1);
  }

  double floatAt(const char* bytes) const
  {
    return this->BytesOfFloat == 4 ? double(valueAt<float>(bytes)) : valueAt<double>(bytes);
  }

  /// Reads a number of bytes, which the file must have.
  std::vector<char> nextBytes(std::uint64_t count)
  {
    if (count > this->File.size() - std::min(this->File.size(), this->Offset))
    {
      fail("has a step that ends after the file");
    }
    std::vector<char> bytes(static_cast<std::size_t>(count));
    this->File.read(this->Offset, bytes.data(), bytes.size());
    this->Offset += count;
    return bytes;
  }

  void readStep()
  {
    SmsDataset& dataset = this->open();
    SmsStep step(this->Path, this->Shape, dataset);
    step.checkSize(this->NodeCount, this->CellCount);
    const bool hasStatus = this->nextBytes(this->BytesOfFlag)[0] != 0;
    const double time = this->floatAt(this->nextBytes(this->BytesOfFloat).data());
    std::vector<bool> active;
    if (hasStatus)
    {
      const auto cells = std::uint64_t(this->Shape.Cells);
      const std::vector<char> flags = this->nextBytes(cells * this->BytesOfFlag);
      for (std::size_t i = 0; i < flags.size(); i += this->BytesOfFlag)
      {
        active.push_back(flags[i] != 0);
      }
    }
    const std::uint64_t count = std::uint64_t(this->NodeCount) * unsigned(dataset.Components);
    const std::vector<char> bytes = this->nextBytes(count * this->BytesOfFloat);
    std::vector<double> values(static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      values[i] = this->floatAt(bytes.data() + i * this->BytesOfFloat);
    }
    step.add(time, values, active);
  }

  const std::string& Path;
  const SmsMeshShape& Shape;
  InputFile File;
  std::uint64_t Offset = 0;
  std::vector<SmsDataset> Datasets;
  bool IsOpen = false;
  std::size_t BytesOfFloat = 4;
  std::size_t BytesOfFlag = 4;
  std::int64_t NodeCount = 0;
  std::int64_t CellCount = 0;
  std::string Unit;
  double JulianDay = 0;
};

} // namespace

std::vector<SmsDataset> readBinarySmsDatasets(const std::string& path, const SmsMeshShape& shape)
{
  return BinaryReader(path, shape).read();
}

} // namespace tipp
