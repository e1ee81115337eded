// SPDX-License-Identifier: BSD-3-Clause
#include "Resample/ResampleOnDevice.h"

#include "Resample/ClaimSamples.cl.h"
#include "Resample/InterpolateSamples.cl.h"
#include "Resample/SampleCells.cl.h"
#include "Resample/SimplexMesh.h"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <string>

namespace tipp
{
namespace
{

/// The number of arrays that SampleCells.cl supports.
constexpr std::size_t mostArrays = 4;
constexpr int mostComponents = 8;

class DeviceSampler
{
public:
  DeviceSampler(MeshPieces& mesh, const Lattice& lattice, const std::vector<Attribute>& attributes)
    : Pieces(mesh)
    , Device(mesh.device())
    , Mesh(mesh.mesh())
    , Axes(mesh.mesh(), lattice)
    , Attributes(attributes)
  {
  }

  SampledCells run(unsigned char* valid, const Report& report)
  {
    const std::size_t samples = std::size_t(this->Axes.samples());
    clearMask(this->Axes.samples(), this->Pieces.threads(), valid);
    this->Outputs.emplace_back(this->Device, valid, samples, true);
    std::size_t tuple = 0;
    for (const Attribute& attribute : this->Attributes)
    {
      const std::size_t bytes = tupleBytes(attribute);
      this->Outputs.emplace_back(this->Device, attribute.Samples, samples * bytes, false);
      tuple += bytes;
    }
    withAccess(this->Mesh,
      [&](const auto& access)
      {
        OutsidePoints<std::decay_t<decltype(access)>> outside(
          this->Mesh, { &this->Axes.U, &this->Axes.V, &this->Axes.W });
        outside.find(this->Pieces.threads());
        this->Result.Aborted = !this->Pieces.forEach(tuple, samples * (tuple + 1), report,
          [&](const MeshOnDevice& piece)
          { this->samplePiece(piece, piece.isWhole() ? outside.sides() : nullptr); });
      });
    for (const OutputArray& output : this->Outputs)
    {
      output.fetch();
    }
    return std::move(this->Result);
  }

private:
  /// An array argument of the kernels; unused ones have no components.
  struct Array
  {
    cl::Buffer Values;
    cl::Buffer Samples;
    cl_int Float = 0;
    cl_int Components = 0;
  };

  std::vector<Array> arraysOf(const MeshOnDevice& piece) const
  {
    const cl::Buffer none = this->Device.room(1);
    std::vector<Array> arrays(mostArrays, Array{ none, none });
    for (std::size_t i = 0; i < this->Attributes.size(); ++i)
    {
      const Attribute& attribute = this->Attributes[i];
      arrays[i].Values = piece.values(this->Mesh, attribute.Values, tupleBytes(attribute));
      arrays[i].Samples = this->Outputs[i + 1].buffer();
      arrays[i].Float = attribute.Type == Scalar::Float32;
      arrays[i].Components = attribute.Components;
    }
    return arrays;
  }

  template <typename... Arguments>
  void launch(const char* name, std::int64_t items, const MeshOnDevice& piece,
    const std::vector<Array>& a, const Arguments&... arguments) const
  {
    const std::string options =
      piece.compilerOptions() + " -DSHARE=" + std::to_string(shareOf(this->Device));
    cl::Kernel kernel = this->Device.kernel(SampleCellsKernels, name, options);
    this->Device.launch(kernel, std::size_t(items), piece.Points, piece.Ids, piece.U, piece.V,
      axisArgument(this->Axes.U), axisArgument(this->Axes.V), axisArgument(this->Axes.W),
      arguments..., cl_int(this->Attributes.size()), a[0].Values, a[0].Samples, a[0].Float,
      a[0].Components, a[1].Values, a[1].Samples, a[1].Float, a[1].Components, a[2].Values,
      a[2].Samples, a[2].Float, a[2].Components, a[3].Values, a[3].Samples, a[3].Float,
      a[3].Components);
  }

  void samplePiece(const MeshOnDevice& piece, const unsigned char* outside)
  {
    const std::int64_t first = piece.first();
    const std::int64_t count = piece.count();
    const std::vector<Array> arrays = this->arraysOf(piece);
    const CellLists lists(this->Device, piece);
    const cl::Buffer hidden =
      this->Device.input(this->Mesh.Hidden ? this->Mesh.Hidden + first : nullptr,
        this->Mesh.Hidden ? std::size_t(count) : 0);
    const cl::Buffer sides =
      this->Device.input(outside, outside ? std::size_t(this->Mesh.PointCount) : 0);
    this->launch("sampleCells", lists.items(), piece, arrays, cl_long(count),
      largestCellOf(this->Device), hidden, cl_int(this->Mesh.Hidden != nullptr), sides,
      cl_int(outside != nullptr), this->Outputs[0].buffer(), lists.counts(), lists.large(),
      lists.doubtful(), lists.lengths());
    this->Result.Claimed += lists.fetch();
    const std::vector<std::int32_t> open = lists.doubtfulCells();
    this->Result.Open.insert(this->Result.Open.end(), open.begin(), open.end());
    for (const std::int32_t cell : lists.largeCells())
    {
      this->sampleLarge(piece, arrays, cell);
    }
  }

  void sampleLarge(const MeshOnDevice& piece, const std::vector<Array>& arrays, std::int32_t cell)
  {
    const std::int64_t number = piece.first() + cell;
    const std::int64_t rows = rowsOfCell(this->Mesh, this->Axes, number);
    const cl::Buffer counts = this->Device.room(std::size_t(rows) * sizeof(cl_int));
    this->launch("sampleLarge", rows, piece, arrays, cl_long(cell), cl_int(rows),
      this->Outputs[0].buffer(), counts);
    std::vector<cl_int> counted(static_cast<std::size_t>(rows));
    this->Device.read(counts, counted.data(), counted.size() * sizeof(cl_int));
    if (std::find(counted.begin(), counted.end(), -1) != counted.end())
    {
      this->Result.Open.push_back(std::int32_t(number));
      return;
    }
    this->Result.Claimed += std::accumulate(counted.begin(), counted.end(), std::int64_t(0));
  }

  MeshPieces& Pieces;
  ComputeDevice& Device;
  const SimplexMesh& Mesh;
  LatticeAxes Axes;
  const std::vector<Attribute>& Attributes;
  std::vector<OutputArray> Outputs; ///< for the mask, and then for each attribute
  SampledCells Result;
};

} // namespace

bool canSampleOnDevice(const std::vector<Attribute>& attributes)
{
  int components = 0;
  for (const Attribute& attribute : attributes)
  {
    components += attribute.Components;
  }
  return std::all_of(attributes.begin(), attributes.end(), isForDevice) &&
    attributes.size() <= mostArrays && components <= mostComponents;
}

SampledCells sampleOnDevice(MeshPieces& mesh, const Lattice& lattice,
  const std::vector<Attribute>& attributes, unsigned char* valid, const Report& report)
{
  return DeviceSampler(mesh, lattice, attributes).run(valid, report);
}

namespace
{

class DeviceClaimer
{
public:
  DeviceClaimer(MeshPieces& mesh, const Lattice& lattice)
    : Pieces(mesh)
    , Device(mesh.device())
    , Mesh(mesh.mesh())
    , Grid(lattice)
    , Axes(mesh.mesh(), lattice)
  {
  }

  Claims run(const Report& report)
  {
    const std::size_t bytes = std::size_t(this->Axes.samples()) * sizeof(std::int32_t);
    Claims result;
    result.Cells.reset(new std::int32_t[std::size_t(this->Axes.samples())]);
    {
      const OutputArray output(this->Device, result.Cells.get(), bytes, false);
      this->clear(result.Cells.get(), output.buffer(), bytes);
      result.Aborted = !this->Pieces.forEach(0, bytes, partOf(report, 0, 0.9),
        [&](const MeshOnDevice& piece) { this->claimPiece(piece, output.buffer()); });
      output.fetch();
    }
    return result.Aborted
      ? std::move(result)
      : finishClaims(this->Mesh, this->Grid, this->Pieces.threads(), std::move(result.Cells),
          this->Claimed, this->Doubtful, partOf(report, 0.9, 1));
  }

private:
  /// Marks all samples as unclaimed.
  void clear(std::int32_t* claims, const cl::Buffer& buffer, std::size_t bytes) const
  {
    if (!this->Device.sharesHostMemory())
    {
      this->Device.run(
        [&] { this->Device.queue().enqueueFillBuffer(buffer, cl_int(-1), 0, bytes); });
      return;
    }
    forChunks(this->Axes.samples(), 1 << 16, this->Pieces.threads(), {},
      [&](std::int64_t begin, std::int64_t end, int)
      { std::fill(claims + begin, claims + end, -1); });
  }

  void claimPiece(const MeshOnDevice& piece, const cl::Buffer& claims)
  {
    const std::int64_t first = piece.first();
    const std::int64_t count = piece.count();
    const CellLists lists(this->Device, piece);
    const cl::Buffer hidden =
      this->Device.input(this->Mesh.Hidden ? this->Mesh.Hidden + first : nullptr,
        this->Mesh.Hidden ? std::size_t(count) : 0);
    cl::Kernel kernel =
      this->Device.kernel(ClaimSamplesKernels, "claimCells", piece.compilerOptions());
    this->Device.launch(kernel, std::size_t(lists.items()), piece.Points, piece.Ids, piece.U,
      piece.V, axisArgument(this->Axes.U), axisArgument(this->Axes.V), axisArgument(this->Axes.W),
      cl_long(count), cl_long(first), lists.share(), largestCellOf(this->Device), hidden,
      cl_int(this->Mesh.Hidden != nullptr), claims, lists.counts(), lists.large(), lists.doubtful(),
      lists.lengths());
    this->Claimed += lists.fetch();
    const std::vector<std::int32_t> open = lists.doubtfulCells();
    this->Doubtful.insert(this->Doubtful.end(), open.begin(), open.end());
    for (const std::int32_t cell : lists.largeCells())
    {
      this->claimLarge(piece, cell, claims);
    }
  }

  void claimLarge(const MeshOnDevice& piece, cl_int cell, const cl::Buffer& claims)
  {
    const std::int64_t first = piece.first();
    const std::int64_t rows = rowsOfCell(this->Mesh, this->Axes, first + cell);
    const cl::Buffer counts = this->Device.room(std::size_t(rows) * sizeof(cl_int));
    cl::Kernel kernel =
      this->Device.kernel(ClaimSamplesKernels, "claimLarge", piece.compilerOptions());
    this->Device.launch(kernel, std::size_t(rows), piece.Points, piece.Ids, piece.U, piece.V,
      axisArgument(this->Axes.U), axisArgument(this->Axes.V), axisArgument(this->Axes.W),
      cl_long(cell), cl_long(first), cl_int(rows), claims, counts);
    std::vector<cl_int> counted(static_cast<std::size_t>(rows));
    this->Device.read(counts, counted.data(), counted.size() * sizeof(cl_int));
    if (std::find(counted.begin(), counted.end(), -1) != counted.end())
    {
      this->Doubtful.push_back(std::int32_t(first + cell));
      return;
    }
    for (const cl_int n : counted)
    {
      this->Claimed += n;
    }
  }

  MeshPieces& Pieces;
  ComputeDevice& Device;
  const SimplexMesh& Mesh;
  const Lattice& Grid;
  LatticeAxes Axes;
  std::int64_t Claimed = 0;
  std::vector<std::int32_t> Doubtful;
};

class DeviceInterpolation
{
public:
  DeviceInterpolation(
    MeshPieces& mesh, const Lattice& lattice, const std::vector<Attribute>& attributes)
    : Pieces(mesh)
    , Device(mesh.device())
    , Axes(mesh.mesh(), lattice)
    , Attributes(attributes)
  {
  }

  bool run(const std::int32_t* claims, bool keeps, const Report& report)
  {
    const std::size_t samples = std::size_t(this->Axes.samples());
    const std::size_t corners = std::size_t(this->Pieces.mesh().Dimension) + 1;
    this->Block = std::min<std::int64_t>(this->Axes.samples(), BlockSize);
    const std::size_t blockCorners = std::size_t(this->Block) * corners;
    this->CornerIds = this->Device.room(blockCorners * sizeof(cl_int));
    this->Weights = this->Device.room(blockCorners * sizeof(cl_double));
    const cl::Buffer claimed = this->Device.input(claims, samples * sizeof(std::int32_t));
    std::size_t bytes =
      samples * sizeof(std::int32_t) + blockCorners * (sizeof(cl_int) + sizeof(cl_double));
    std::size_t tuple = 0;
    for (const Attribute& attribute : this->Attributes)
    {
      this->Outputs.emplace_back(
        this->Device, attribute.Samples, samples * tupleBytes(attribute), keeps);
      bytes += samples * tupleBytes(attribute);
      tuple += tupleBytes(attribute);
    }
    const bool completed = this->Pieces.forEach(
      tuple, bytes, report, [&](const MeshOnDevice& piece) { this->samplePiece(piece, claimed); });
    for (const OutputArray& output : this->Outputs)
    {
      output.fetch();
    }
    return completed;
  }

private:
  static constexpr std::int64_t BlockSize = std::int64_t(1) << 18;

  void samplePiece(const MeshOnDevice& piece, const cl::Buffer& claims)
  {
    std::vector<cl::Buffer> values;
    for (const Attribute& attribute : this->Attributes)
    {
      values.push_back(piece.values(this->Pieces.mesh(), attribute.Values, tupleBytes(attribute)));
    }
    const std::string options = piece.compilerOptions();
    cl::Kernel weigh = this->Device.kernel(InterpolateSamplesKernels, "weighSamples", options);
    cl::Kernel array = this->Device.kernel(InterpolateSamplesKernels, "interpolateArray", options);
    const cl_int share = shareOf(this->Device);
    const std::int64_t samples = this->Axes.samples();
    for (std::int64_t begin = 0; begin < samples; begin += this->Block)
    {
      const std::int64_t size = std::min(this->Block, samples - begin);
      this->Device.launch(weigh, std::size_t((size + share - 1) / share), piece.Points, piece.Ids,
        piece.U, piece.V, axisArgument(this->Axes.U), axisArgument(this->Axes.V),
        axisArgument(this->Axes.W), cl_long(piece.count()), cl_long(piece.first()), share,
        cl_long(begin), cl_long(size), claims, this->CornerIds, this->Weights);
      for (std::size_t i = 0; i < values.size(); ++i)
      {
        const Attribute& attribute = this->Attributes[i];
        this->Device.launch(array, std::size_t(size), values[i],
          cl_int(attribute.Type == Scalar::Float32), cl_int(attribute.Components), cl_long(begin),
          cl_long(size), this->CornerIds, this->Weights, this->Outputs[i].buffer());
      }
    }
    this->Device.run([&] { this->Device.queue().finish(); });
  }

  MeshPieces& Pieces;
  ComputeDevice& Device;
  LatticeAxes Axes;
  const std::vector<Attribute>& Attributes;
  std::vector<OutputArray> Outputs;
  cl::Buffer CornerIds;
  cl::Buffer Weights;
  std::int64_t Block = 0;
};

/// The attributes' samples in a window, stored separately.
class WindowSamples
{
public:
  WindowSamples(const SampleWindow& window, const std::vector<Attribute>& attributes)
    : Window(window)
    , All(attributes)
    , Windows(attributes)
  {
    for (std::size_t i = 0; i < this->All.size(); ++i)
    {
      this->Copies.emplace_back(std::size_t(window.samples()) * tupleBytes(this->All[i]));
      this->Windows[i].Samples = this->Copies.back().data();
    }
    this->forRows([](char* all, char* copy, std::size_t bytes) { std::memcpy(copy, all, bytes); });
  }

  const std::vector<Attribute>& attributes() const { return this->Windows; }

  void writeBack()
  {
    this->forRows([](char* all, char* copy, std::size_t bytes) { std::memcpy(all, copy, bytes); });
  }

private:
  template <typename Work>
  void forRows(const Work& work)
  {
    for (std::size_t i = 0; i < this->All.size(); ++i)
    {
      const auto bytes = std::int64_t(tupleBytes(this->All[i]));
      char* const all = static_cast<char*>(this->All[i].Samples);
      char* const copy = this->Copies[i].data();
      this->Window.forRuns(0, this->Window.samples(),
        [&](std::int64_t first, std::int64_t last, std::int64_t shift)
        {
          work(all + (first + shift) * bytes, copy + first * bytes,
            std::size_t((last - first) * bytes));
        });
    }
  }

  const SampleWindow& Window;
  const std::vector<Attribute>& All;
  std::vector<Attribute> Windows;
  std::vector<std::vector<char>> Copies;
};

} // namespace

Claims claimOnDevice(MeshPieces& mesh, const Lattice& lattice, const Report& report)
{
  return DeviceClaimer(mesh, lattice).run(report);
}

bool interpolateOnDevice(MeshPieces& mesh, const SampleWindow& window, const std::int32_t* claims,
  const std::vector<Attribute>& attributes, bool keeps, const Report& report)
{
  std::vector<Attribute> chosen;
  std::copy_if(attributes.begin(), attributes.end(), std::back_inserter(chosen), isForDevice);
  if (chosen.empty())
  {
    return true;
  }
  if (window.isWhole())
  {
    return DeviceInterpolation(mesh, window.lattice(), chosen).run(claims, keeps, report);
  }
  WindowSamples samples(window, chosen);
  const bool completed =
    DeviceInterpolation(mesh, window.lattice(), samples.attributes()).run(claims, true, report);
  samples.writeBack();
  return completed;
}

} // namespace tipp
