// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSampledPieces_h
#define tippSampledPieces_h

#include "Arrays/Buffer.h"
#include "OpenCL/Devices.h"
#include "Overlap/OverlapSums.h"
#include "Parallel/ParallelFor.h"
#include "Partitioned/ReadPiece.h"
#include "Resample/CellKey.h"
#include "Resample/Lattice.h"
#include "Resample/Resample.h"
#include "Sampling/ImageFile.h"
#include "Sampling/SampleNames.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tipp
{

/// How the pieces of a mesh are sampled.
struct PieceSampling
{
  std::vector<std::string> Names;   ///< the arrays to sample; empty: all
  std::vector<int> Axes = { 0, 1 }; ///< of the plane that triangles are sampled in
  double NullValue = 0;             ///< value of samples outside of all cells
  std::optional<double> NoData;     ///< cells with such a corner yield no value
  DeviceChoice Device;
  int Threads = 1;
  bool IsWhole = true;       ///< the mesh is a single piece
  bool Conservative = false; ///< samples are means over the covered part of their pixels
  bool CoveredShare = false; ///< with Conservative: adds the array coveredShareName
};

/// Samples of a mesh without VTK's data sets, which is added piece by piece; for those,
/// see SampledImage. The result does not depend on how the mesh is cut into pieces.
class SampledPieces
{
public:
  SampledPieces(const Lattice& lattice, PieceSampling settings);

  /// Samples the piece's own cells. Pieces are of one dimension and have the same arrays. Returns
  /// false if `progress` stopped it. Throws std::runtime_error.
  bool add(const Piece& piece, const Report& progress);

  /// Completes the samples when all pieces are added.
  void finish();

  /// Removes an array, if there is one of that name.
  void remove(const std::string& name);

  /// Returns all arrays, the mask and vtkGhostType; they stay in this object's memory.
  ImageArrays image();

  std::int64_t cells() const { return this->Cells; }
  std::int64_t hits() const { return this->Hits; } ///< samples in cells, after image()
  double seconds() const { return this->Seconds; }
  /// Sentences for the user.
  std::vector<std::string> warnings() const;

private:
  struct Array
  {
    StoredArray Source; ///< the array of the mesh
    Scalar Type;
    Buffer<char> Samples;
  };

  void addArrays(const Piece& piece, bool ofPoints);
  bool isSelected(const StoredArray& array) const;
  std::vector<unsigned char> hiddenCellsOf(const Piece& piece);
  bool sample(const Piece& piece, const SimplexMesh& mesh, const Report& progress);
  bool average(const Piece& piece, const SimplexMesh& mesh, const Report& progress);
  void finishMeans();
  void repeatLayers();
  void clear();

  Lattice Grid;
  PieceSampling Settings;
  std::vector<Array> Arrays;
  Buffer<char> Valid; ///< one byte per sample
  Buffer<char> PointGhosts;
  Buffer<char> CellGhosts;
  std::unique_ptr<CellKey[]> Keys; ///< null for a mesh in one piece
  std::unique_ptr<OverlapSums> Sums;
  std::vector<std::string> Warnings;
  std::int64_t Cells = 0;
  std::int64_t NotFinite = 0; ///< cells with a corner that is not finite
  std::int64_t Hits = 0;
  double Seconds = 0;
  bool IsSurface = true;
  bool HasSamples = false;
};

/// Throws std::runtime_error if this machine lacks the memory for the samples of a mesh with these
/// arrays.
void requireMemoryFor(
  const std::vector<StoredArray>& arrays, const Lattice& lattice, const PieceSampling& settings);

} // namespace tipp

#endif
