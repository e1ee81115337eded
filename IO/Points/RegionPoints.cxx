// SPDX-License-Identifier: BSD-3-Clause
#include "Points/Longitudes.h"
#include "Points/ReadPoints.h"

#include <algorithm>
#include <memory>
#include <utility>

namespace tipp
{
namespace
{

/// Reads all points of a file, and drops those outside of a box.
class RegionPoints : public FilePoints
{
public:
  RegionPoints(
    std::unique_ptr<FilePoints> points, const std::string& path, const Box2& region, int wrap)
    : All(std::move(points))
    , Path(path)
    , Region(region)
    , Wrap(wrap)
  {
  }

  bool next(PointBlock& block, std::size_t most) override
  {
    while (this->All->next(block, most))
    {
      wrapLongitudes(this->Path, this->Wrap, block.XY);
      this->dropOutside(block);
      if (block.size() > 0)
      {
        return true;
      }
    }
    return false;
  }

  void rewind() override { this->All->rewind(); }
  std::vector<std::string> columns() const override { return this->All->columns(); }
  std::int64_t leftOut() const override { return this->All->leftOut(); }
  std::int64_t most() const override { return this->All->most(); }
  ReferenceSystem referenceSystem() const override { return this->All->referenceSystem(); }
  std::vector<TableReport> reports() const override { return this->All->reports(); }
  ReadFigures readFigures() const override
  {
    ReadFigures figures = this->All->readFigures();
    figures.Bounds = this->Seen; // longitudes may be moved
    return figures;
  }

private:
  void dropOutside(PointBlock& block)
  {
    block.keepIf(
      [&](std::size_t i)
      {
        const Point2 p{ block.XY[2 * i], block.XY[2 * i + 1] };
        this->Seen.extend(p);
        return this->Region.contains(p);
      });
  }

  const std::unique_ptr<FilePoints> All;
  const std::string Path;
  const Box2 Region;
  const int Wrap;
  Box2 Seen = Box2::empty(); ///< the bounds of all points that were read
};

} // namespace

std::unique_ptr<FilePoints> keepRegion(
  std::unique_ptr<FilePoints> points, const std::string& path, const PointOptions& options)
{
  return std::make_unique<RegionPoints>(std::move(points), path, *options.Region, options.Wrap);
}

} // namespace tipp
