// SPDX-License-Identifier: BSD-3-Clause
#include "Sampling/SampledImage.h"

#include "Arrays/Scalar.h"
#include "Overlap/AddOverlaps.h"
#include "Parallel/Stopwatch.h"
#include "Resample/NearBorder.h"
#include "Sampling/PlainValues.h"
#include "Sampling/SampleValues.h"
#include "Sampling/SamplingLattice.h"
#include "Vtk/CellArrays.h"
#include "Vtk/Compatibility.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkDataSetAttributes.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace tipp
{
namespace
{

/// Writes the null value into tuples [begin, end).
void fillNull(vtkDataArray* array, double null, std::int64_t begin, std::int64_t end)
{
  const int components = array->GetNumberOfComponents();
  fillNull(*scalarOf(array->GetDataType()), null, array->GetVoidPointer(0),
    std::size_t(begin * components), std::size_t(end * components));
}

/// The number of bytes per sample of all selected arrays.
double bytesOfArrays(const std::vector<vtkPointSet*>& meshes, const SamplingSettings& settings)
{
  double bytes = 0;
  std::set<std::string> counted;
  const auto count = [&](vtkDataSetAttributes* data, bool ofCells)
  {
    for (int i = 0; i < data->GetNumberOfArrays(); ++i)
    {
      vtkDataArray* const array = data->GetArray(i);
      if (array && array->GetName() && settings.Selected(ofCells, array->GetName()) &&
        counted.insert(array->GetName()).second)
      {
        bytes += array->GetNumberOfComponents() * array->GetDataTypeSize();
      }
    }
  };
  for (vtkPointSet* mesh : meshes)
  {
    count(mesh->GetPointData(), false);
    count(mesh->GetCellData(), true);
  }
  return bytes;
}

void addTo(ClaimStatistics& sum, const ClaimStatistics& more)
{
  sum.VisitedCells += more.VisitedCells;
  sum.Tests += more.Tests;
  sum.ExactTests += more.ExactTests;
  sum.OverlappingClaims += more.OverlappingClaims;
}

} // namespace

SampledImage::SampledImage(const Lattice& lattice, SamplingSettings settings)
  : Grid(lattice)
  , Settings(std::move(settings))
{
  this->Mask->SetName("vtkValidPointMask");
  if (!reserveTuples(this->Mask, vtkIdType(lattice.samples())))
  {
    throw std::bad_alloc();
  }
  this->Mask->SetNumberOfValues(vtkIdType(lattice.samples()));
  if (this->Settings.Merging)
  {
    this->Keys.reset(new CellKey[std::size_t(this->samples())]);
    this->clear();
  }
}

unsigned char* SampledImage::valid() const
{
  return reinterpret_cast<unsigned char*>(this->Mask->GetPointer(0));
}

void SampledImage::clear()
{
  for (Array& array : this->Arrays)
  {
    fillNull(array.Samples, this->Settings.NullValue, 0, this->samples());
  }
  std::fill(this->valid(), this->valid() + this->samples(), 0);
  if (this->Keys)
  {
    std::fill(this->Keys.get(), this->Keys.get() + this->samples(), noCellKey);
  }
}

SampledImage::Array& SampledImage::addArray(
  const std::string& name, bool ofCells, int type, int components)
{
  Array array{ name, ofCells,
    vtkSmartPointer<vtkDataArray>::Take(
      vtkDataArray::CreateDataArray(this->Settings.Conservative ? VTK_DOUBLE : type)) };
  array.Samples->SetName(name.c_str());
  array.Samples->SetNumberOfComponents(components);
  if (!reserveTuples(array.Samples, vtkIdType(this->samples())))
  {
    throw std::bad_alloc();
  }
  array.Samples->SetNumberOfTuples(vtkIdType(this->samples()));
  this->Arrays.push_back(array);
  return this->Arrays.back();
}

SampledImage::Array& SampledImage::addNullArray(
  const std::string& name, bool ofCells, int type, int components)
{
  Array& array = this->addArray(name, ofCells, type, components);
  fillNull(array.Samples, this->Settings.NullValue, 0, this->samples());
  return array;
}

void SampledImage::setNull(const Array& array, std::int64_t sample) const
{
  fillNull(array.Samples, this->Settings.NullValue, sample, sample + 1);
}

SampledImage::Array* SampledImage::findArray(const std::string& name)
{
  for (Array& array : this->Arrays)
  {
    if (array.Name == name)
    {
      return &array;
    }
  }
  return nullptr;
}

void SampledImage::removeArray(const std::string& name)
{
  this->Arrays.erase(std::remove_if(this->Arrays.begin(), this->Arrays.end(),
                       [&name](const Array& array) { return array.Name == name; }),
    this->Arrays.end());
}

bool SampledImage::accepts(const Array& array, bool ofCells, int type, int components)
{
  if (array.OfCells != ofCells)
  {
    this->warnOnce("There are a point array and a cell array '" + array.Name +
      "'; only the one of the " + (array.OfCells ? "cells" : "points") + " is sampled.");
    return false;
  }
  const bool same =
    (this->Settings.Conservative || scalarOf(array.Samples->GetDataType()) == scalarOf(type)) &&
    array.Samples->GetNumberOfComponents() == components;
  if (!same)
  {
    this->warnOnce("The array '" + array.Name +
      "' differs in type or components between parts of the input; where it does, it is null.");
  }
  return same;
}

bool SampledImage::add(vtkPointSet* mesh, const Report& progress)
{
  const Stopwatch watch;
  SimplexParts parts = makeSimplices(mesh, this->Settings.Axes, this->Settings.Threads);
  this->Statistics.PreparationSeconds += watch.seconds();
  this->Statistics.Ignored += parts.Thin;
  this->Statistics.NotFinite += parts.NotFinite;
  const std::int64_t triangles = parts.Triangles.Mesh.Cells;
  if (parts.Tetrahedra.Mesh.Cells > 0 && this->Dimension != 3)
  {
    if (this->Dimension == 2)
    {
      this->warnOnce("Surface cells beside cells with a volume are not sampled.");
      this->Statistics.Ignored += this->Statistics.Cells;
      this->Statistics.Cells = 0;
    }
    this->clear();
    this->Dimension = 3;
  }
  else if (triangles > 0 && this->Dimension == 0)
  {
    this->Dimension = 2;
  }
  this->addArrays(mesh->GetPointData(), false);
  this->addArrays(mesh->GetCellData(), true);
  SimplexSet& simplices = this->Dimension == 3 ? parts.Tetrahedra : parts.Triangles;
  const bool completed = simplices.Mesh.Cells == 0 || this->sample(mesh, simplices, progress);
  if (this->Dimension == 3 && triangles > 0)
  {
    this->Statistics.Ignored += triangles;
    this->warnOnce("Surface cells beside cells with a volume are not sampled.");
  }
  return completed;
}

bool SampledImage::sample(vtkPointSet* mesh, SimplexSet& simplices, const Report& progress)
{
  this->Statistics.Cells += simplices.Mesh.Cells;
  if (this->samples() == 0)
  {
    return true;
  }
  simplices.Mesh.Axes[0] = this->Settings.Axes[0];
  simplices.Mesh.Axes[1] = this->Settings.Axes[1];
  if (simplices.Mesh.Cells > std::numeric_limits<std::int32_t>::max())
  {
    throw std::runtime_error("a mesh has " + std::to_string(simplices.Mesh.Cells) +
      " cells, and 2147483647 are the most for one piece: split it into pieces.");
  }
  const Stopwatch watch;
  if (this->Settings.NoData)
  {
    this->hideNoData(mesh, simplices);
  }
  if (this->Settings.Conservative)
  {
    this->HasSamples = true;
    const bool completed = this->average(mesh, simplices, progress);
    this->Statistics.InterpolationSeconds += watch.seconds();
    return completed;
  }
  ResampleOptions options;
  options.Device = this->Settings.Device;
  options.Threads = this->Settings.Threads;
  options.Keys = this->Keys.get();
  options.Valid = this->valid();
  options.Parents = simplices.Parents.empty() ? nullptr : simplices.Parents.data();
  options.Progress = progress;
  const std::vector<Attribute> attributes = this->attributesOf(mesh);
  this->Statistics.PreparationSeconds += watch.seconds();
  this->HasSamples = true;
  const ResampleResult result = this->Settings.Kept
    ? this->sampleKept(simplices.Mesh, attributes, options)
    : resample(simplices.Mesh, this->Grid, attributes, options);
  this->Values.clear();
  SamplingStatistics& statistics = this->Statistics;
  addTo(statistics.Claims, result.Statistics);
  statistics.ClaimSeconds += result.ClaimSeconds;
  statistics.InterpolationSeconds += result.InterpolationSeconds;
  statistics.TransferSeconds += result.TransferSeconds;
  if (!result.Device.empty() || statistics.Device.empty())
  {
    statistics.Device = result.Device.empty() ? "OpenMP" : result.Device;
  }
  if (!result.Warning.empty())
  {
    this->warnOnce(result.Warning);
  }
  return !result.Aborted;
}

/// What resample() does, with the claims of the time step before if the mesh is still the same.
ResampleResult SampledImage::sampleKept(const SimplexMesh& mesh,
  const std::vector<Attribute>& attributes, const ResampleOptions& options) const
{
  ResampleResult result;
  Stopwatch watch;
  const Claims* const claims =
    this->Settings.Kept->of(mesh, this->Grid, options.Threads, partOf(options.Progress, 0, 0.7));
  result.ClaimSeconds = watch.restart();
  result.Aborted = !claims;
  if (claims)
  {
    result.Statistics = claims->Statistics;
    ResampleOptions rest = options;
    rest.Progress = partOf(options.Progress, 0.7, 1);
    result.Aborted =
      !interpolate(mesh, SampleWindow(mesh, this->Grid), claims->Cells.get(), attributes, rest);
    fillNear(claims->Near, attributes, options.Parents);
    result.InterpolationSeconds = watch.seconds();
  }
  return result;
}

/// Throws std::runtime_error if the samples are not pixels of one layer.
void SampledImage::requirePixels() const
{
  if (this->Dimension != 2)
  {
    throw std::runtime_error(
      "the mesh has cells with a volume, and conservative means are over areas: give a surface.");
  }
  tipp::requirePixels(this->Grid, this->Settings.Axes);
}

/// Adds the areas and integrals of a mesh to the sums. Returns false if `progress` stopped it.
bool SampledImage::average(vtkPointSet* mesh, SimplexSet& simplices, const Report& progress)
{
  this->requirePixels();
  OverlapSource source;
  source.Mesh = simplices.Mesh;
  source.Parents = simplices.Parents.empty() ? nullptr : simplices.Parents.data();
  std::vector<PlainValues> owned;
  owned.reserve(this->Arrays.size()); // so that none moves, to which a field points
  for (const Array& array : this->Arrays)
  {
    vtkDataArray* const found = this->valuesOf(mesh, array);
    if (!found)
    {
      throw std::runtime_error("a part of the mesh has no array '" + array.Name +
        "' with as many components, so it has no means: leave it out.");
    }
    owned.emplace_back(found);
    source.Fields.push_back(
      { owned.back().data(), array.Samples->GetNumberOfComponents(), array.OfCells });
  }
  this->Values.clear();
  const int components = componentsOf(source.Fields);
  if (!this->Sums)
  {
    this->Sums = std::make_unique<OverlapSums>(this->samples(), components);
  }
  if (components != this->Sums->components())
  {
    throw std::runtime_error("the parts of the mesh have different arrays: name those of all.");
  }
  return addPixels(this->Grid, source, *this->Sums, this->Settings.Threads, progress);
}

/// Sets the samples to the means, or to NullValue where nothing is covered.
void SampledImage::finishMeans()
{
  const std::vector<double> shares = sharesOfPixels(this->Grid,
    { this->Settings.Axes[0], this->Settings.Axes[1] }, *this->Sums, this->Settings.Threads);
  int first = 0;
  for (const Array& array : this->Arrays)
  {
    const int components = array.Samples->GetNumberOfComponents();
    this->Sums->copyMeans(first, components, shares, this->Settings.NullValue,
      static_cast<double*>(array.Samples->GetVoidPointer(0)), this->Settings.Threads);
    first += components;
  }
  const std::string warning = markCovered(shares, this->valid());
  if (this->Settings.CoveredShare)
  {
    const Array& array = this->addArray(coveredShareName, true, VTK_DOUBLE, 1);
    std::copy(shares.begin(), shares.end(), static_cast<double*>(array.Samples->GetVoidPointer(0)));
  }
  if (!warning.empty())
  {
    this->warnOnce(warning);
  }
}

std::vector<Attribute> SampledImage::attributesOf(vtkPointSet* mesh)
{
  std::vector<Attribute> attributes;
  for (const Array& array : this->Arrays)
  {
    vtkDataArray* const values = this->valuesOf(mesh, array);
    attributes.push_back({ values ? values->GetVoidPointer(0) : nullptr,
      array.Samples->GetVoidPointer(0), *scalarOf(array.Samples->GetDataType()),
      array.Samples->GetNumberOfComponents(), array.OfCells, this->Settings.NullValue });
  }
  return attributes;
}

/// The mesh's array to sample into `array`, or null if it has none of a suitable type.
vtkDataArray* SampledImage::valuesOf(vtkPointSet* mesh, const Array& array)
{
  vtkDataSetAttributes* const data =
    mesh->GetAttributes(array.OfCells ? vtkDataObject::CELL : vtkDataObject::POINT);
  vtkDataArray* const values = data->GetArray(array.Name.c_str());
  if (!values ||
    !this->accepts(array, array.OfCells, values->GetDataType(), values->GetNumberOfComponents()))
  {
    return nullptr;
  }
  this->Values.push_back(contiguous(values));
  return this->Values.back();
}

void SampledImage::addArrays(vtkDataSetAttributes* data, bool ofCells)
{
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* const any = data->GetAbstractArray(i);
    const std::string name = any->GetName() ? any->GetName() : "";
    const bool special = name.empty() || name == vtkDataSetAttributes::GhostArrayName();
    if (!special)
    {
      this->Names[ofCells ? 1 : 0].insert(name);
    }
    if (special || !this->Settings.Selected(ofCells, name))
    {
      continue;
    }
    vtkDataArray* const array = vtkDataArray::SafeDownCast(any);
    if (!array || !scalarOf(array->GetDataType()))
    {
      this->warnOnce("The array '" + name + "' is left out: it is not made of numbers.");
      continue;
    }
    const int type = array->GetDataType();
    const int components = array->GetNumberOfComponents();
    if (Array* const known = this->findArray(name))
    {
      this->accepts(*known, ofCells, type, components);
    }
    else
    {
      Array& added = this->Keys ? this->addNullArray(name, ofCells, type, components)
                                : this->addArray(name, ofCells, type, components);
      added.Samples->CopyComponentNames(array);
    }
  }
}

void SampledImage::hideNoData(vtkPointSet* mesh, SimplexSet& simplices)
{
  std::vector<bool> marked(std::size_t(mesh->GetNumberOfPoints()), false);
  vtkPointData* const data = mesh->GetPointData();
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* const array = data->GetArray(i);
    if (array && array->GetName() && scalarOf(array->GetDataType()) &&
      this->Settings.Selected(false, array->GetName()))
    {
      markEqual(*scalarOf(array->GetDataType()), contiguous(array)->GetVoidPointer(0),
        std::size_t(array->GetNumberOfComponents()), *this->Settings.NoData, marked);
    }
  }
  hideMarked(simplices, marked);
}

void SampledImage::warnOnce(const std::string& text)
{
  if (std::find(this->Warnings.begin(), this->Warnings.end(), text) == this->Warnings.end())
  {
    this->Warnings.push_back(text);
  }
}

void SampledImage::finish()
{
  if (!this->HasSamples)
  {
    this->clear();
  }
  if (this->Sums)
  {
    this->finishMeans();
    return;
  }
  // Triangles are sampled in one layer; copy it along the axis of the projection.
  const int projected = 3 - this->Settings.Axes[0] - this->Settings.Axes[1];
  const bool repeats = this->Dimension == 2 && this->samples() > 0;
  const std::size_t layers = repeats ? std::size_t(this->Grid.size(projected)) : 1;
  const auto samples = std::size_t(this->samples());
  for (const Array& array : this->Arrays)
  {
    vtkDataArray* const values = array.Samples;
    const auto tuple = std::size_t(values->GetNumberOfComponents() * values->GetDataTypeSize());
    repeatLayer(values->GetVoidPointer(0), samples * tuple, layers);
  }
  repeatLayer(this->valid(), samples, layers);
  if (this->Keys)
  {
    repeatLayer(this->Keys.get(), samples * sizeof(CellKey), layers);
  }
}

void refuseTooLarge(const Lattice& local, const Lattice& wanted, bool exchanging,
  const std::vector<vtkPointSet*>& meshes, const SamplingSettings& settings)
{
  // Bytes per sample: the claims; the mask with its two ghost arrays.
  constexpr double claims = 4;
  constexpr double mask = 3;
  const double arrays = bytesOfArrays(meshes, settings) + mask;
  const double keys = settings.Merging ? sizeof(CellKey) : 0;
  // Conservative means need two doubles for the area and for each component.
  const double sums =
    settings.Conservative ? 2 * sizeof(double) + 2 * bytesOfArrays(meshes, settings) : 0;
  const auto count = [](const Lattice& lattice)
  {
    return lattice.empty()
      ? 0.0
      : double(lattice.size(0)) * double(lattice.size(1)) * double(lattice.size(2));
  };
  const double needed = count(local) * (arrays + claims + keys + sums) +
    (exchanging ? count(wanted) * (arrays + keys) : 0);
  requireMemory(std::max(count(local), count(wanted)), needed);
}

} // namespace tipp
