// SPDX-License-Identifier: BSD-3-Clause
#include "Raster/RasterFile.h"

#include "Files/Formats.h"
#include "Files/IOError.h"
#include "Files/TextFile.h"
#include "Files/VtkXml.h"
#include "Npy/NpyFile.h"

#include <map>
#include <mutex>
#include <stdexcept>

namespace tipp
{
namespace
{

struct GridAxis
{
  double Origin;
  std::int64_t Count;
};

/// Returns the number of pixels that cover a range, at least one.
GridAxis coverRange(double low, double high, double size, bool aligned, const char* name)
{
  if (!(std::isfinite(low) && std::isfinite(high) && low <= high))
  {
    throw std::runtime_error(std::string("the bounds along ") + name +
      " are not a range: give finite bounds, the lower one first.");
  }
  // Rounding must not add a pixel to a range of whole pixels.
  const double slack = roundingOf(low, high);
  if (!(4 * slack < size))
  {
    throw std::runtime_error(std::string("the bounds along ") + name +
      " are too far from 0 for so small a resolution, because coordinates have 16 digits: give a "
      "larger one, or points from which a constant is subtracted.");
  }
  const double first = aligned ? stepsUpTo(0, size, low, slack) : 0;
  const double count =
    aligned ? stepsToReach(0, size, high, slack) - first : stepsToReach(low, size, high, slack);
  if (!(count < std::numeric_limits<std::int32_t>::max()))
  {
    throw std::runtime_error(
      std::string("the raster would have more than 2147483646 pixels along ") + name +
      ": give a larger resolution or smaller bounds.");
  }
  return { aligned ? gridPosition(0, size, 2 * std::int64_t(first)) : low,
    std::max<std::int64_t>(1, std::int64_t(count)) };
}

} // namespace

RasterGrid makeRasterGrid(const RasterRequest& request, const Box2& pointBounds)
{
  if (request.Like)
  {
    return *request.Like;
  }
  const Box2 bounds = request.Bounds.value_or(pointBounds);
  const double size = request.Resolution;
  const GridAxis x = coverRange(bounds.Min.x, bounds.Max.x, size, request.Aligned, "x");
  const GridAxis y = coverRange(bounds.Min.y, bounds.Max.y, size, request.Aligned, "y");
  return { x.Origin, y.Origin, { size, size }, x.Count, y.Count, std::nullopt };
}

void BandSums::add(double value)
{
  this->Least = std::min(this->Least, value);
  this->Most = std::max(this->Most, value);
  this->Count += 1;
  const double difference = value - this->Mean;
  this->Mean += difference / this->Count;
  this->Squares += difference * (value - this->Mean);
}

void BandSums::add(const BandSums& other)
{
  this->Hidden += other.Hidden;
  if (other.Count == 0)
  {
    return;
  }
  this->Least = std::min(this->Least, other.Least);
  this->Most = std::max(this->Most, other.Most);
  const double count = this->Count + other.Count;
  const double difference = other.Mean - this->Mean;
  this->Mean += difference * (other.Count / count);
  this->Squares += other.Squares + difference * difference * (this->Count * other.Count / count);
  this->Count = count;
}

RasterWriter::~RasterWriter() = default;

// NOLINTNEXTLINE(performance-unnecessary-value-param): overrides keep the tile
void RasterWriter::writeEncoded(std::int64_t, EncodedTile)
{
  throw std::logic_error("encoded tiles are those of GeoTIFFs");
}

namespace
{

/// Writes a header text, then the bands one after another, each row by row from the south.
class PlainWriter : public RasterWriter
{
public:
  PlainWriter(
    const std::string& path, const RasterDescription& description, const PathState& before)
    : Pending(path, before)
    , Grid(description.Grid)
    , Bands(description.Bands.size())
  {
  }

  /// `lengths` tells whether each band is preceded by its size in bytes.
  void start(const std::string& text, bool lengths)
  {
    this->put(0, text.data(), text.size());
    this->Begin = text.size();
    this->Gap = lengths ? sizeof(std::uint64_t) : 0;
    for (std::size_t band = 0; lengths && band < this->Bands; ++band)
    {
      const std::uint64_t size = this->bandBytes();
      this->put(this->offset(band) - sizeof(size), &size, sizeof(size));
    }
  }
  void end(const std::string& text)
  {
    this->put(this->offset(this->Bands) - this->Gap, text.data(), text.size());
  }

  void write(const RasterWindow& window, const std::vector<const double*>& bands) override
  {
    const std::size_t bytes = sizeof(double) * std::size_t(window.Columns);
    for (std::size_t band = 0; band < bands.size(); ++band)
    {
      for (std::int64_t row = 0; row < window.Rows; ++row)
      {
        const auto pixel = std::uint64_t((window.Row + row) * this->Grid.Columns + window.Column);
        this->put(
          this->offset(band) + sizeof(double) * pixel, bands[band] + row * window.Columns, bytes);
      }
    }
  }

  void close() override { this->Pending.commit(); }

  std::uint64_t bandBytes() const { return sizeof(double) * std::uint64_t(this->Grid.pixels()); }

private:
  void put(std::uint64_t offset, const void* data, std::size_t bytes) const
  {
    this->Pending.file().write(offset, data, bytes);
  }
  std::uint64_t offset(std::size_t band) const
  {
    return this->Begin + this->Gap + band * (this->bandBytes() + this->Gap);
  }

  PendingFile Pending;
  const RasterGrid Grid;
  const std::size_t Bands;
  std::uint64_t Begin = 0;
  std::uint64_t Gap = 0;
};

std::unique_ptr<RasterWriter> createNpy(
  const std::string& path, const RasterDescription& description, const PathState& before)
{
  auto writer = std::make_unique<PlainWriter>(path, description, before);
  std::vector<std::int64_t> shape;
  if (description.Bands.size() > 1)
  {
    shape.push_back(std::int64_t(description.Bands.size()));
  }
  shape.push_back(description.Grid.Rows);
  shape.push_back(description.Grid.Columns);
  writer->start(npyFileStart("<f8", shape), false);
  return writer;
}

std::string numbers(std::initializer_list<double> values)
{
  std::string text;
  for (const double value : values)
  {
    text += (text.empty() ? "" : " ") + exactText(value);
  }
  return text;
}

std::unique_ptr<RasterWriter> createVti(
  const std::string& path, const RasterDescription& description, const PathState& before)
{
  const RasterGrid& grid = description.Grid;
  auto writer = std::make_unique<PlainWriter>(path, description, before);
  const std::string extent =
    "0 " + std::to_string(grid.Columns - 1) + " 0 " + std::to_string(grid.Rows - 1) + " 0 0";
  std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"ImageData\" version=\"1.0\" "
                     "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n  <ImageData "
                     "WholeExtent=\"" +
    extent + "\" Origin=\"" + numbers({ grid.firstCentre().x, grid.firstCentre().y, 0 }) +
    "\" Spacing=\"" + numbers({ grid.Pixel[0], grid.Pixel[1], 1 }) + "\">\n    <Piece Extent=\"" +
    extent + "\">\n      <PointData Scalars=\"" + escapedXml(description.Bands.front()) + "\">\n";
  for (std::size_t band = 0; band < description.Bands.size(); ++band)
  {
    text += "        <DataArray type=\"Float64\" Name=\"" + escapedXml(description.Bands[band]) +
      "\" format=\"appended\" offset=\"" +
      std::to_string(band * (writer->bandBytes() + sizeof(std::uint64_t))) + "\"/>\n";
  }
  text += "      </PointData>\n      <CellData/>\n    </Piece>\n  </ImageData>\n  <AppendedData "
          "encoding=\"raw\">\n_";
  writer->start(text, true);
  writer->end("\n  </AppendedData>\n</VTKFile>\n");
  return writer;
}

} // namespace

std::unique_ptr<RasterWriter> createRaster(
  const std::string& path, const RasterDescription& description, const PathState& before)
{
  switch (openerOf(path, Use::WritesRasters))
  {
    case Opener::GeoTiff:
      return createGeoTiff(path, description, before);
    case Opener::Npy:
      return createNpy(path, description, before);
    case Opener::Vtk:
      return createVti(path, description, before);
    default:
      throw IOError(path,
        "has no extension that tells a kind of raster; use " + listFormats(Use::WritesRasters) +
          ".");
  }
}

const std::vector<TiffField>& geoKeysOf(const std::string& crs)
{
  static std::mutex mutex;
  static std::map<std::string, std::vector<TiffField>> known;
  const std::lock_guard<std::mutex> lock(mutex);
  const auto found = known.find(crs);
  return found != known.end() ? found->second : known.emplace(crs, makeGeoKeys(crs)).first->second;
}

} // namespace tipp
