// SPDX-License-Identifier: BSD-3-Clause
#include "Points/TablePoints.h"

#include <algorithm>
#include <utility>

namespace tipp
{
namespace
{

class TablePoints : public PointStream
{
public:
  explicit TablePoints(PointTable table)
    : Table(std::move(table))
    , End(std::int64_t(this->Table.size()))
  {
  }

  bool next(PointBlock& block, std::size_t most) override
  {
    const std::int64_t count = std::min(std::int64_t(most), this->End - this->At);
    const auto copy =
      [&](const std::vector<double>& from, std::int64_t width, std::vector<double>& to)
    { to.assign(from.begin() + width * this->At, from.begin() + width * (this->At + count)); };
    block.First = this->At;
    copy(this->Table.XY, 2, block.XY);
    block.Columns.resize(this->Table.Columns.size());
    for (std::size_t i = 0; i < block.Columns.size(); ++i)
    {
      copy(this->Table.Columns[i].Values, 1, block.Columns[i]);
    }
    this->At += count;
    return count > 0;
  }

  void rewind() override { this->At = this->Begin; }

  std::int64_t divisible() const override { return std::int64_t(this->Table.size()); }

  void limitTo(std::int64_t first, std::int64_t end) override
  {
    this->Begin = std::clamp<std::int64_t>(first, 0, this->divisible());
    this->End = std::clamp(end, this->Begin, this->divisible());
  }

  std::vector<std::string> columns() const override
  {
    std::vector<std::string> names;
    for (const PointTable::Column& column : this->Table.Columns)
    {
      names.push_back(column.Name);
    }
    return names;
  }

  std::int64_t most() const override { return this->divisible(); }
  std::string identity() const override { return "table"; }

private:
  const PointTable Table;
  std::int64_t Begin = 0;
  std::int64_t End;
  std::int64_t At = 0;
};

} // namespace

std::unique_ptr<PointStream> streamTable(PointTable table, const Thinning& thinning)
{
  std::unique_ptr<PointStream> stream = std::make_unique<TablePoints>(std::move(table));
  return thinning.isGiven() ? thinPoints(std::move(stream), thinning) : std::move(stream);
}

} // namespace tipp
