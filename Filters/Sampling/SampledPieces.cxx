// SPDX-License-Identifier: BSD-3-Clause
#include "Sampling/SampledPieces.h"

#include "Files/RawArray.h"
#include "Overlap/AddOverlaps.h"
#include "Parallel/Stopwatch.h"
#include "Sampling/HiddenSamples.h"
#include "Sampling/SampleValues.h"
#include "Sampling/SamplingLattice.h"
#include "Sampling/SurfaceOfPiece.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <utility>

namespace tipp
{
namespace
{

std::size_t bytesOfTuple(Scalar type, int components)
{
  return scalarSize(type) * std::size_t(components);
}

const Piece::Attribute* find(const Piece& piece, const StoredArray& wanted)
{
  const auto found = std::find_if(piece.Attributes.begin(), piece.Attributes.end(),
    [&wanted](const Piece::Attribute& attribute)
    {
      const StoredArray& array = attribute.Description;
      return array.Name == wanted.Name && array.OfPoints == wanted.OfPoints &&
        array.Type == wanted.Type && array.Components == wanted.Components;
    });
  return found != piece.Attributes.end() ? &*found : nullptr;
}

} // namespace

SampledPieces::SampledPieces(const Lattice& lattice, PieceSampling settings)
  : Grid(lattice)
  , Settings(std::move(settings))
  , Valid(std::size_t(lattice.samples()))
{
  std::memset(this->Valid.data(), 0, this->Valid.size());
  if (!this->Settings.IsWhole && !this->Settings.Conservative)
  {
    this->Keys.reset(new CellKey[this->Valid.size()]);
    std::fill_n(this->Keys.get(), this->Valid.size(), noCellKey);
  }
}

bool SampledPieces::isSelected(const StoredArray& array) const
{
  const std::vector<std::string>& names = this->Settings.Names;
  return array.Name != ghostArrayName &&
    (names.empty() || std::find(names.begin(), names.end(), array.Name) != names.end());
}

void SampledPieces::addArrays(const Piece& piece, bool ofPoints)
{
  for (const Piece::Attribute& attribute : piece.Attributes)
  {
    const StoredArray& source = attribute.Description;
    if (source.OfPoints != ofPoints || !this->isSelected(source))
    {
      continue;
    }
    const auto known = std::find_if(this->Arrays.begin(), this->Arrays.end(),
      [&source](const Array& array) { return array.Source.Name == source.Name; });
    if (known != this->Arrays.end())
    {
      if (this->Settings.Names.empty()) // a name that is given means the array of the points
      {
        this->Warnings.push_back("There are a point array and a cell array '" + source.Name +
          "'; only the one of the points is sampled.");
      }
      continue;
    }
    const Scalar type = this->Settings.Conservative ? Scalar::Float64 : source.Type;
    Buffer<char> samples(this->Valid.size() * bytesOfTuple(type, source.Components));
    if (this->Keys)
    {
      fillNull(
        type, this->Settings.NullValue, samples.data(), 0, samples.size() / scalarSize(type));
    }
    this->Arrays.push_back({ source, type, std::move(samples) });
  }
}

std::vector<unsigned char> SampledPieces::hiddenCellsOf(const Piece& piece)
{
  std::vector<unsigned char> hidden = hiddenCells(piece);
  std::vector<bool> marked(std::size_t(piece.Points), false);
  if (markNotFinite(
        piece, piece.CellSize == 3 ? this->Settings.Axes : std::vector<int>{ 0, 1, 2 }, marked))
  {
    this->NotFinite += hideAt(piece, marked, hidden);
  }
  if (this->Settings.NoData)
  {
    marked.assign(marked.size(), false);
    for (const Piece::Attribute& attribute : piece.Attributes)
    {
      if (attribute.Description.OfPoints && this->isSelected(attribute.Description))
      {
        markEqual(attribute.Description.Type, attribute.Values.data(),
          std::size_t(attribute.Description.Components), *this->Settings.NoData, marked);
      }
    }
    hideAt(piece, marked, hidden);
  }
  return hidden;
}

bool SampledPieces::add(const Piece& piece, const Report& progress)
{
  if (piece.OwnedCells > std::numeric_limits<std::int32_t>::max())
  {
    throw std::runtime_error("a mesh has " + std::to_string(piece.OwnedCells) +
      " cells, and 2147483647 are the most for one piece: split it into pieces.");
  }
  const Stopwatch watch;
  if (!this->HasSamples)
  {
    this->addArrays(piece, true);
    this->addArrays(piece, false);
  }
  this->HasSamples = true;
  this->IsSurface = piece.CellSize == 3;
  this->Cells += piece.OwnedCells;
  SimplexMesh mesh = meshOf(piece, this->Settings.Axes);
  const std::vector<unsigned char> hidden = this->hiddenCellsOf(piece);
  mesh.Hidden = hidden.data();
  const bool isDone = this->Settings.Conservative ? this->average(piece, mesh, progress)
                                                  : this->sample(piece, mesh, progress);
  this->Seconds += watch.seconds();
  return isDone;
}

bool SampledPieces::sample(const Piece& piece, const SimplexMesh& mesh, const Report& progress)
{
  std::vector<Attribute> attributes;
  for (Array& array : this->Arrays)
  {
    const Piece::Attribute* const found = find(piece, array.Source);
    attributes.push_back({ found ? found->Values.data() : nullptr, array.Samples.data(), array.Type,
      array.Source.Components, !array.Source.OfPoints, this->Settings.NullValue });
  }
  ResampleOptions options;
  options.Device = this->Settings.Device;
  options.Threads = this->Settings.Threads;
  options.Keys = this->Keys.get();
  options.Valid = this->Valid.as<unsigned char>();
  options.Progress = progress;
  const ResampleResult result = resample(mesh, this->Grid, attributes, options);
  if (!result.Warning.empty() && this->Warnings.empty())
  {
    this->Warnings.push_back(result.Warning);
  }
  return !result.Aborted;
}

bool SampledPieces::average(const Piece& piece, const SimplexMesh& mesh, const Report& progress)
{
  if (mesh.Dimension != 2)
  {
    throw std::runtime_error(
      "the mesh has cells with a volume, and conservative means are over areas: give a surface.");
  }
  requirePixels(this->Grid, this->Settings.Axes);
  OverlapSource source;
  source.Mesh = mesh;
  std::vector<std::vector<double>> copies(this->Arrays.size());
  for (std::size_t i = 0; i < this->Arrays.size(); ++i)
  {
    const StoredArray& array = this->Arrays[i].Source;
    const Piece::Attribute* const found = find(piece, array);
    if (!found)
    {
      throw std::runtime_error("a part of the mesh has no array '" + array.Name +
        "' with as many components, so it has no means: leave it out.");
    }
    source.Fields.push_back({ doublesOf(*found, copies[i]), array.Components, !array.OfPoints });
  }
  if (!this->Sums)
  {
    this->Sums = std::make_unique<OverlapSums>(this->Grid.samples(), componentsOf(source.Fields));
  }
  return addPixels(this->Grid, source, *this->Sums, this->Settings.Threads, progress);
}

/// Sets all samples to null.
void SampledPieces::clear()
{
  for (Array& array : this->Arrays)
  {
    fillNull(array.Type, this->Settings.NullValue, array.Samples.data(), 0,
      array.Samples.size() / scalarSize(array.Type));
  }
}

void SampledPieces::finish()
{
  if (!this->HasSamples)
  {
    this->clear();
  }
  else if (this->Sums)
  {
    this->finishMeans();
  }
  else
  {
    this->repeatLayers();
  }
}

/// Sets the samples to the means, or to NullValue where nothing is covered.
void SampledPieces::finishMeans()
{
  const std::vector<double> shares = sharesOfPixels(this->Grid,
    { this->Settings.Axes[0], this->Settings.Axes[1] }, *this->Sums, this->Settings.Threads);
  int first = 0;
  for (Array& array : this->Arrays)
  {
    const int components = array.Source.Components;
    this->Sums->copyMeans(first, components, shares, this->Settings.NullValue,
      array.Samples.as<double>(), this->Settings.Threads);
    first += components;
  }
  const std::string warning = markCovered(shares, this->Valid.as<unsigned char>());
  if (this->Settings.CoveredShare)
  {
    Buffer<char> samples(shares.size() * sizeof(double));
    std::copy(shares.begin(), shares.end(), samples.as<double>());
    this->Arrays.push_back(
      { { coveredShareName, false, Scalar::Float64, 1, -1 }, Scalar::Float64, std::move(samples) });
  }
  if (!warning.empty())
  {
    this->Warnings.push_back(warning);
  }
}

/// Triangles are sampled in one layer, which is copied along the axis of the projection.
void SampledPieces::repeatLayers()
{
  const int projected = 3 - this->Settings.Axes[0] - this->Settings.Axes[1];
  const auto layers = std::size_t(this->IsSurface ? this->Grid.size(projected) : 1);
  for (Array& array : this->Arrays)
  {
    repeatLayer(array.Samples.data(), array.Samples.size(), layers);
  }
  repeatLayer(this->Valid.data(), this->Valid.size(), layers);
}

void SampledPieces::remove(const std::string& name)
{
  this->Arrays.erase(std::remove_if(this->Arrays.begin(), this->Arrays.end(),
                       [&name](const Array& array) { return array.Source.Name == name; }),
    this->Arrays.end());
}

ImageArrays SampledPieces::image()
{
  ImageArrays image;
  image.Grid = this->Grid;
  for (const Array& array : this->Arrays)
  {
    image.OfPoints.push_back(
      { array.Source.Name, array.Type, array.Source.Components, array.Samples.data() });
  }
  const unsigned char* const valid = this->Valid.as<unsigned char>();
  this->PointGhosts = Buffer<char>(this->Valid.size());
  this->CellGhosts = Buffer<char>(std::size_t(cellsBetween(this->Grid)));
  const int threads = this->Settings.Threads;
  markHiddenCells(this->Grid, valid, threads, this->CellGhosts.as<unsigned char>());
  this->Hits =
    markHiddenSamples(valid, this->Grid.samples(), threads, this->PointGhosts.as<unsigned char>());
  image.OfPoints.push_back({ validMaskName, Scalar::Int8, 1, valid });
  image.OfPoints.push_back({ ghostArrayName, Scalar::UInt8, 1, this->PointGhosts.data() });
  image.OfCells.push_back({ ghostArrayName, Scalar::UInt8, 1, this->CellGhosts.data() });
  return image;
}

std::vector<std::string> SampledPieces::warnings() const
{
  std::vector<std::string> all = this->Warnings;
  if (this->NotFinite > 0)
  {
    all.push_back(std::to_string(this->NotFinite) +
      (this->NotFinite == 1
          ? " cell has a corner with a NaN or infinite coordinate and yields no value."
          : " cells have a corner with a NaN or infinite coordinate and yield no value."));
  }
  if (this->Cells > 0 && this->Hits == 0 && this->Grid.samples() > 0)
  {
    all.emplace_back(
      "No sample lies in a cell of the mesh: check the range and the number of samples.");
  }
  return all;
}

void requireMemoryFor(
  const std::vector<StoredArray>& arrays, const Lattice& lattice, const PieceSampling& settings)
{
  // Bytes per sample: the claims; the mask with its two ghost arrays.
  constexpr double claims = 4;
  constexpr double mask = 3;
  double values = 0;
  for (const StoredArray& array : arrays)
  {
    values += double(bytesOfTuple(array.Type, array.Components));
  }
  const double keys = settings.IsWhole ? 0 : sizeof(CellKey);
  // Conservative means need two doubles for the area and for each component.
  const double sums = settings.Conservative ? 2 * sizeof(double) + 2 * values : 0;
  const double samples =
    double(lattice.size(0)) * double(lattice.size(1)) * double(lattice.size(2));
  requireMemory(samples, samples * (values + claims + mask + keys + sums));
}

} // namespace tipp
