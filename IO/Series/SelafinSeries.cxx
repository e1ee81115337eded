// SPDX-License-Identifier: BSD-3-Clause
#include "Files/IOError.h"
#include "Parallel/Poll.h"
#include "Series/CellSeries.h"
#include "Series/CheckTimes.h"
#include "Series/FortranRecords.h"
#include "Series/ModelSeries.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace tipp
{
namespace
{

std::string trimmed(const char* text, std::size_t length)
{
  const std::string all(text, length);
  const std::size_t end = all.find_last_not_of(std::string(" \0", 2));
  return all.substr(0, end == std::string::npos ? 0 : end + 1);
}

/// The output of TELEMAC and related models: a title; the numbers of variables; their names; ten
/// integers; a date; the sizes; corners; boundary nodes; x; y; and for each step its time and a
/// record per variable. See the User Manual of TELEMAC-2D, appendix 3.
class SelafinSeries : public CellSeries
{
public:
  SelafinSeries(const std::string& path, const SeriesOptions& options)
    : CellSeries(options.Wrap)
    , Records(path, titleBytes)
  {
    this->Path = path;
    this->Kind = "SELAFIN";
    this->Records.next(titleBytes, "the title");
    this->readNames();
    this->readDate();
    this->readSizes();
    this->skipMesh();
    this->findSteps();
    this->setSize(this->FileNodes, this->Elements);
  }

protected:
  std::unique_ptr<CellBlocks> openCells() override
  {
    CellMesh cells;
    const std::vector<char> corners =
      this->Records.at(this->CornersOffset, std::uint64_t(4) * this->cornerCount(), "the corners");
    cells.Corners.resize(std::size_t(this->cornerCount()));
    for (std::size_t i = 0; i < cells.Corners.size(); ++i)
    {
      const std::int64_t number = this->Records.valueFrom<std::int32_t>(corners.data() + 4 * i);
      if (number < 1 || number > this->FileNodes)
      {
        throw IOError(this->Path,
          "cell " + std::to_string(i / std::size_t(this->PerCell)) + " (from 0) names node " +
            std::to_string(number) + ", but there are " + std::to_string(this->FileNodes) +
            ", counted from 1; copy the file again.");
      }
      cells.Corners[i] = number - 1;
    }
    for (std::int64_t i = 0; this->PerCell != 3 && i <= this->Elements; ++i)
    {
      cells.Offsets.push_back(i * this->PerCell);
    }
    std::vector<double> x = this->valuesAt(this->XOffset, "x");
    std::vector<double> y = this->valuesAt(this->XOffset + this->recordBytes(), "y");
    for (std::size_t i = 0; i < x.size(); ++i)
    {
      cells.XY.push_back(x[i] + this->Origin[0]);
      cells.XY.push_back(y[i] + this->Origin[1]);
    }
    return sourceOf(std::move(cells));
  }

  void readStored(std::size_t variable, std::size_t step, std::vector<double>& values) override
  {
    const std::uint64_t record = this->FirstStep + std::uint64_t(step) * this->stepBytes() +
      this->timeBytes() + std::uint64_t(variable) * this->recordBytes();
    values = this->valuesAt(record, "'" + this->Variables.at(variable).Name + "'");
  }

private:
  static constexpr std::uint32_t titleBytes = 80;
  static constexpr std::uint64_t marks = 8; ///< the lengths around a record

  std::int64_t cornerCount() const { return this->Elements * this->PerCell; }
  std::uint64_t recordBytes() const
  {
    return std::uint64_t(this->FileNodes) * this->ValueBytes + marks;
  }
  std::uint64_t timeBytes() const { return this->ValueBytes + marks; }
  std::uint64_t stepBytes() const
  {
    return this->timeBytes() + this->Variables.size() * this->recordBytes();
  }

  double valueFrom(const char* bytes) const
  {
    return this->ValueBytes == sizeof(double) ? this->Records.valueFrom<double>(bytes)
                                              : double(this->Records.valueFrom<float>(bytes));
  }

  std::vector<double> valuesAt(std::uint64_t offset, const std::string& what) const
  {
    const std::vector<char> bytes =
      this->Records.at(offset, std::uint64_t(this->FileNodes) * this->ValueBytes, what);
    std::vector<double> values(static_cast<std::size_t>(this->FileNodes));
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      values[i] = this->valueFrom(bytes.data() + i * this->ValueBytes);
    }
    return values;
  }

  std::int32_t integerFrom(const std::vector<char>& record, std::size_t index) const
  {
    return this->Records.valueFrom<std::int32_t>(record.data() + 4 * index);
  }

  void readNames()
  {
    const std::vector<char> counts = this->Records.next(8, "the numbers of variables");
    const std::int64_t linear = this->integerFrom(counts, 0);
    const std::int64_t quadratic = this->integerFrom(counts, 1);
    constexpr std::int64_t most = 10000;
    if (linear < 0 || linear > most || quadratic != 0)
    {
      throw IOError(this->Path,
        "announces " + std::to_string(linear) + " variables and " + std::to_string(quadratic) +
          " on other points; copy it again.");
    }
    constexpr std::size_t half = 16;
    for (std::int64_t i = 0; i < linear; ++i)
    {
      const std::vector<char> name = this->Records.next(2 * half, "the name of a variable");
      SeriesVariable variable;
      variable.Name = trimmed(name.data(), half);
      variable.Units = trimmed(name.data() + half, half);
      variable.Varies = true;
      const bool isTaken = std::any_of(this->Variables.begin(), this->Variables.end(),
        [&](const SeriesVariable& other) { return other.Name == variable.Name; });
      variable.Name += isTaken || variable.Name.empty() ? " " + std::to_string(i + 1) : "";
      this->Variables.push_back(std::move(variable));
    }
  }

  void readDate()
  {
    const std::vector<char> flags = this->Records.next(40, "the parameters");
    this->Origin = { double(this->integerFrom(flags, 2)), double(this->integerFrom(flags, 3)) };
    const std::int32_t planes = this->integerFrom(flags, 6);
    if (planes > 1)
    {
      throw IOError(this->Path,
        "has a mesh of " + std::to_string(planes) +
          " planes in space; extract a plane or the two-dimensional output.");
    }
    this->TimeUnits = "seconds";
    if (this->integerFrom(flags, 9) == 1)
    {
      const std::vector<char> date = this->Records.next(24, "the date");
      std::string text = "seconds since ";
      constexpr std::array<const char*, 6> before = { "", "-", "-", " ", ":", ":" };
      for (std::size_t i = 0; i < before.size(); ++i)
      {
        const std::int32_t number = this->integerFrom(date, i);
        if (number < 0 || number > 9999)
        {
          return; // no date
        }
        text += before[i] + std::string(number < 10 ? "0" : "") + std::to_string(number);
      }
      this->TimeUnits = text;
    }
  }

  void readSizes()
  {
    const std::vector<char> sizes = this->Records.next(16, "the sizes of the mesh");
    this->Elements = this->integerFrom(sizes, 0);
    this->FileNodes = this->integerFrom(sizes, 1);
    this->PerCell = this->integerFrom(sizes, 2);
    const std::uint64_t limit = this->Records.size() / 4;
    if (this->Elements < 1 || this->FileNodes < 1 || this->PerCell < 3 || this->PerCell > 4 ||
      std::uint64_t(this->Elements) > limit || std::uint64_t(this->FileNodes) > limit)
    {
      throw IOError(this->Path,
        "announces " + std::to_string(this->Elements) + " cells of " +
          std::to_string(this->PerCell) + " corners and " + std::to_string(this->FileNodes) +
          " nodes, which is no mesh of triangles or quadrilaterals or more than the file holds; "
          "copy it again.");
    }
  }

  void skipMesh()
  {
    this->CornersOffset = this->Records.offset();
    this->Records.next(std::uint64_t(4) * std::uint64_t(this->cornerCount()), "the corners");
    this->Records.next(std::uint64_t(4) * std::uint64_t(this->FileNodes), "the boundary nodes");
    this->XOffset = this->Records.offset();
    const std::size_t bytes = this->Records.next("x").size();
    this->ValueBytes = bytes / std::size_t(this->FileNodes);
    if ((this->ValueBytes != sizeof(float) && this->ValueBytes != sizeof(double)) ||
      bytes % std::size_t(this->FileNodes) != 0)
    {
      throw IOError(this->Path,
        "is damaged: x has " + std::to_string(bytes) + " bytes for " +
          std::to_string(this->FileNodes) + " nodes; copy it again.");
    }
    this->Records.next(bytes, "y");
    this->FirstStep = this->Records.offset();
    for (SeriesVariable& variable : this->Variables)
    {
      variable.Type = this->ValueBytes == sizeof(double) ? Scalar::Float64 : Scalar::Float32;
    }
  }

  /// Counts the steps, which the file does not announce.
  void findSteps()
  {
    const std::uint64_t left = this->Records.size() - this->FirstStep;
    const std::uint64_t steps = this->Variables.empty() ? 0 : left / this->stepBytes();
    for (std::uint64_t step = 0; step < steps; ++step)
    {
      pollAt(std::int64_t(step));
      const std::vector<char> time = this->Records.at(
        this->FirstStep + step * this->stepBytes(), this->ValueBytes, "the time of a step");
      this->Times.push_back(this->valueFrom(time.data()));
    }
    checkTimes(this->Path, this->Times);
    if (!this->Variables.empty() && left % this->stepBytes() != 0)
    {
      this->LeftOut.push_back({ "step " + std::to_string(steps),
        "is not complete: the file ends in it, as after an interrupted run" });
    }
    if (steps == 0)
    {
      for (const SeriesVariable& variable : this->Variables)
      {
        this->LeftOut.push_back({ variable.Name, "has no time steps" });
      }
      this->Variables.clear();
    }
  }

  FortranRecords Records;
  std::array<double, 2> Origin{}; ///< to be added to coordinates
  std::int64_t Elements = 0;
  std::int64_t FileNodes = 0;
  std::int64_t PerCell = 0;
  std::uint64_t ValueBytes = 0;
  std::uint64_t CornersOffset = 0;
  std::uint64_t XOffset = 0;
  std::uint64_t FirstStep = 0;
};

} // namespace

std::unique_ptr<MeshSeries> openSelafinSeries(const std::string& path, const SeriesOptions& options)
{
  refuseValues(path, options);
  return std::make_unique<SelafinSeries>(path, options);
}

} // namespace tipp
