// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSampledImage_h
#define tippSampledImage_h

#include "Overlap/OverlapSums.h"
#include "Resample/Resample.h"
#include "Sampling/KeptClaims.h"
#include "Sampling/SampleNames.h"
#include "Sampling/SimplexParts.h"

#include "vtkCharArray.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"

#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

class vtkDataArray;
class vtkDataSetAttributes;
class vtkPointSet;

namespace tipp
{

/// The settings of a sampling.
struct SamplingSettings
{
  std::function<bool(bool ofCells, const std::string& name)> Selected;
  std::vector<int> Axes = { 0, 1 }; ///< the two axes of the plane that triangles are sampled in
  double NullValue = 0;             ///< value of samples outside of all cells
  std::optional<double> NoData;     ///< cells with such a corner yield no value
  DeviceChoice Device;
  int Threads = 1;
  bool Merging = false; ///< several meshes are added, on this or other ranks
  /// Samples are means over the covered part of their pixels, as doubles, instead of values at
  /// their positions.
  bool Conservative = false;
  bool CoveredShare = false; ///< with Conservative: adds the array coveredShareName
  /// Keeps the claims of a complete mesh for the next time step; null: they are not kept. Not with
  /// Merging, Conservative, NoData, which hides other cells at each step, or a Device.
  KeptClaims* Kept = nullptr;
};

/// Counts and wall-clock times of sampling on this rank.
struct SamplingStatistics
{
  ClaimStatistics Claims;
  std::int64_t Cells = 0;     ///< triangles or tetrahedra sampled
  std::int64_t Ignored = 0;   ///< cells of lower dimension than those
  std::int64_t NotFinite = 0; ///< cells with a corner that is NaN or infinite
  double PreparationSeconds = 0;
  double ClaimSeconds = 0;
  double InterpolationSeconds = 0;
  double TransferSeconds = 0;
  double ExchangeSeconds = 0; ///< between ranks
  double OutputSeconds = 0;   ///< to fill the image
  std::string Device;
};

/// The samples of a lattice's extent, collected from any number of meshes.
class SampledImage
{
public:
  SampledImage(const Lattice& lattice, SamplingSettings settings);

  /// An array of the samples.
  struct Array
  {
    std::string Name;
    bool OfCells;
    vtkSmartPointer<vtkDataArray> Samples;
  };

  /// Samples a mesh. Returns false if `progress` stopped it. A mesh with three-dimensional cells
  /// discards all samples of triangles; triangles added after it are ignored.
  bool add(vtkPointSet* mesh, const Report& progress);

  const Lattice& lattice() const { return this->Grid; }
  int dimension() const { return this->Dimension; } ///< dimension of the cells; 0: no cells so far
  const std::vector<Array>& arrays() const { return this->Arrays; }
  const SamplingStatistics& statistics() const { return this->Statistics; }
  /// The names of the arrays of all meshes added, whether sampled or not.
  const std::set<std::string>& namesOf(bool ofCells) const { return this->Names[ofCells ? 1 : 0]; }
  const std::vector<std::string>& warnings() const { return this->Warnings; }

  std::int64_t samples() const { return this->Mask->GetNumberOfValues(); }
  /// By sample: 1 if it has a value, else 0.
  unsigned char* valid() const;
  /// The array that valid() points into, for the image.
  vtkCharArray* mask() const { return this->Mask; }
  /// By sample: the key of its cell; null unless Merging.
  CellKey* keys() { return this->Keys.get(); }

  /// Must be called after the last mesh. Sets samples to their null values if no mesh was sampled,
  /// and copies triangles' samples along the axis of their projection.
  void finish();

  /// Adds an array with NullValue for all samples.
  Array& addNullArray(const std::string& name, bool ofCells, int type, int components);
  void setNull(const Array& array, std::int64_t sample) const;
  Array* findArray(const std::string& name);
  void removeArray(const std::string& name);
  /// Whether an array of this type can be sampled into `array`; if not, adds a warning.
  bool accepts(const Array& array, bool ofCells, int type, int components);

private:
  Array& addArray(const std::string& name, bool ofCells, int type, int components);
  bool sample(vtkPointSet* mesh, SimplexSet& simplices, const Report& progress);
  ResampleResult sampleKept(const SimplexMesh& mesh, const std::vector<Attribute>& attributes,
    const ResampleOptions& options) const;
  bool average(vtkPointSet* mesh, SimplexSet& simplices, const Report& progress);
  void requirePixels() const;
  void finishMeans();
  void clear();
  std::vector<Attribute> attributesOf(vtkPointSet* mesh);
  vtkDataArray* valuesOf(vtkPointSet* mesh, const Array& array);
  void addArrays(vtkDataSetAttributes* data, bool ofCells);
  void hideNoData(vtkPointSet* mesh, SimplexSet& simplices);
  void warnOnce(const std::string& text);

  Lattice Grid;
  SamplingSettings Settings;
  int Dimension = 0;
  bool HasSamples = false;
  std::vector<Array> Arrays;
  std::vector<vtkSmartPointer<vtkDataArray>> Values; ///< owns arrays while a mesh is sampled
  vtkNew<vtkCharArray> Mask;
  std::unique_ptr<CellKey[]> Keys;
  std::unique_ptr<OverlapSums> Sums; ///< with Conservative: of all arrays, from the first mesh on
  SamplingStatistics Statistics;
  std::set<std::string> Names[2]; ///< names of point arrays and of cell arrays
  std::vector<std::string> Warnings;
};

/// Throws std::runtime_error, stating the bytes needed, if the samples do not fit into this
/// machine's memory. `local` is the lattice sampled on this rank, `wanted` the lattice of its
/// output; `exchanging` is true if they differ.
void refuseTooLarge(const Lattice& local, const Lattice& wanted, bool exchanging,
  const std::vector<vtkPointSet*>& meshes, const SamplingSettings& settings);

} // namespace tipp

#endif
