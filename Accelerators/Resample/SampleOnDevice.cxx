// SPDX-License-Identifier: BSD-3-Clause
#include "Resample/SampleOnDevice.h"

#include "Resample/CellLists.h"
#include "Resample/DeviceArrays.h"
#include "Resample/OutsidePoints.h"
#include "Resample/SampleCells.cl.h"

#include <algorithm>
#include <numeric>
#include <string>

namespace tipp
{
namespace
{

/// What SampleCells.cl has room for.
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
  /// An array for the kernels; those that there are not have no components.
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
  std::vector<OutputArray> Outputs; ///< the mask, and each attribute's
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

} // namespace tipp
