// SPDX-License-Identifier: BSD-3-Clause
#include "Series/SmsDatasets.h"

#include "Files/IOError.h"
#include "Files/TextFile.h"

#include <cstddef>
#include <utility>

namespace tipp
{
namespace
{

/// Reads datasets in ASCII: lines that begin with a keyword, and a line per value. Files of old
/// versions have no DATASET line.
class TextReader
{
public:
  TextReader(const std::string& path, const SmsMeshShape& shape)
    : Path(path)
    , Shape(shape)
    , Rows(path, "a dataset of SMS in ASCII")
  {
  }

  std::vector<SmsDataset> read()
  {
    while (this->Rows.nextIfAny())
    {
      if (this->Rows.fields() > 0)
      {
        this->readLine(lowerCase(this->Rows.text(0)));
      }
    }
    if (this->IsOpen)
    {
      throw IOError(this->Path, "ends before a dataset does, by a line ENDDS; copy it again.");
    }
    if (this->Datasets.empty())
    {
      throw IOError(this->Path, "has no dataset; check that it is a dataset of SMS.");
    }
    return std::move(this->Datasets);
  }

private:
  void readLine(const std::string& keyword)
  {
    if (keyword == "begscl" || keyword == "begvec")
    {
      this->begin(keyword == "begvec" ? 2 : 1);
    }
    else if (keyword == "enddset" || keyword == "endds")
    {
      this->end();
    }
    else if (keyword == "nd" || keyword == "nc")
    {
      this->Rows.require(2, "a size");
      (keyword == "nd" ? this->Nodes : this->Cells) = this->Rows.integer(1);
    }
    else if (keyword == "name")
    {
      this->readName();
    }
    else if (keyword == "timeunits" || keyword == "rt_julian")
    {
      this->readTimeUnits(keyword);
    }
    else if (keyword == "ts")
    {
      this->readStep();
    }
    else if (keyword != "dataset" && keyword != "objtype" && keyword != "objid" &&
      keyword != "vectype" && keyword != "reftime" && keyword != "tunits")
    {
      this->Rows.fail("has '" + shownText(keyword) +
        "', which is no keyword of a dataset; check that the numbers of nodes and cells are "
        "right.");
    }
  }

  void begin(int components)
  {
    if (this->IsOpen)
    {
      this->Rows.fail("begins a dataset in another one; copy the file again.");
    }
    this->IsOpen = true;
    this->Datasets.emplace_back();
    this->Datasets.back().Components = components;
    this->Datasets.back().Name = "values";
    this->Nodes = 0;
    this->Cells = 0;
  }

  SmsDataset& open()
  {
    if (!this->IsOpen)
    {
      this->Rows.fail("comes before BEGSCL or BEGVEC; copy the file again.");
    }
    return this->Datasets.back();
  }

  void end()
  {
    SmsDataset& dataset = this->open();
    if (dataset.Times.empty())
    {
      this->Rows.fail("ends a dataset without a time step; copy the file again.");
    }
    dataset.TimeUnits = smsTimeUnits(this->Unit, this->JulianDay);
    this->IsOpen = false;
  }

  void readName()
  {
    std::string name;
    for (std::size_t i = 1; i < this->Rows.fields(); ++i)
    {
      name += (i > 1 ? " " : "") + std::string(this->Rows.text(i));
    }
    const std::size_t from = !name.empty() && name.front() == '"' ? 1 : 0;
    const std::size_t quote = name.find('"', from);
    this->open().Name = name.substr(from, quote == std::string::npos ? quote : quote - from);
  }

  void readTimeUnits(const std::string& keyword)
  {
    this->Rows.require(2, "a time");
    if (keyword == "timeunits")
    {
      this->Unit = lowerCase(this->Rows.text(1));
    }
    else
    {
      this->JulianDay = this->Rows.number(1);
    }
  }

  void readStep()
  {
    this->Rows.require(3, "a time step");
    SmsDataset& dataset = this->open();
    SmsStep step(this->Path, this->Shape, dataset);
    step.checkSize(this->Nodes, this->Cells);
    const std::int64_t status = this->Rows.integer(1);
    const double time = this->Rows.number(2);
    const std::int64_t flags = status != 0 ? this->Shape.Cells : 0;
    if (this->Nodes + flags > this->Rows.remainingLines())
    {
      this->Rows.fail("begins a step of " + std::to_string(this->Nodes + flags) + " lines, but " +
        std::to_string(this->Rows.remainingLines()) + " follow; copy the file again.");
    }
    std::vector<bool> active;
    for (std::int64_t i = 0; i < flags; ++i)
    {
      this->Rows.next(1, "the status of a cell");
      active.push_back(this->Rows.integer(0) != 0);
    }
    const auto components = std::size_t(dataset.Components);
    std::vector<double> values;
    for (std::int64_t i = 0; i < this->Nodes; ++i)
    {
      this->Rows.next(components, "a node's values");
      for (std::size_t c = 0; c < components; ++c)
      {
        values.push_back(this->Rows.number(c));
      }
    }
    step.add(time, values, active);
  }

  const std::string& Path;
  const SmsMeshShape& Shape;
  NumberRows Rows;
  std::vector<SmsDataset> Datasets;
  bool IsOpen = false;
  std::int64_t Nodes = 0;
  std::int64_t Cells = 0;
  std::string Unit;
  double JulianDay = 0;
};

} // namespace

std::vector<SmsDataset> readSmsText(const std::string& path, const SmsMeshShape& shape)
{
  return TextReader(path, shape).read();
}

} // namespace tipp
