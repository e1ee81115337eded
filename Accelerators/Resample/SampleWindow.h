// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSampleWindow_h
#define tippSampleWindow_h

#include "Resample/Lattice.h"
#include "Resample/SimplexMesh.h"
#include "vtkTIPPAcceleratorsModule.h"

#include <algorithm>
#include <cstdint>

namespace tipp
{

/// A box of a lattice's samples, and its position in the lattice. It makes the cost of a part of a
/// mesh depend on the part's own box instead of the whole image.
///
/// Triangles are sampled in the plane of the two axes `mesh.Axes` of the lattice.
class VTKTIPPACCELERATORS_EXPORT SampleWindow
{
public:
  /// The window of all samples.
  SampleWindow(const SimplexMesh& mesh, const Lattice& lattice);
  /// The window of the samples in the mesh's bounding box, decided exactly.
  static SampleWindow around(const SimplexMesh& mesh, const Lattice& lattice, int threads);

  /// The lattice of the window. Its coordinates are bitwise equal to the whole lattice's.
  const Lattice& lattice() const { return this->Part; }
  std::int64_t samples() const { return this->Width * this->Height * this->Layers; }

  /// The index, among all samples, of the first sample of row `row` of the window.
  std::int64_t indexOf(std::int64_t row) const
  {
    return this->First +
      ((row / this->Height) * this->AllHeight + row % this->Height) * this->AllWidth;
  }

  /// Calls work(first, last, shift) for runs [first, last) of the window's samples [begin, end),
  /// such that sample i of the window is sample i + shift of the whole lattice.
  template <typename Work>
  void forRuns(std::int64_t begin, std::int64_t end, const Work& work) const
  {
    if (this->Whole)
    {
      work(begin, end, std::int64_t(0));
      return;
    }
    while (begin < end)
    {
      const std::int64_t row = begin / this->Width;
      const std::int64_t last = std::min(end, (row + 1) * this->Width);
      work(begin, last, this->indexOf(row) - row * this->Width);
      begin = last;
    }
  }

private:
  void measure(const SimplexMesh& mesh);

  Lattice Part;
  std::int64_t Width = 0;
  std::int64_t Height = 0;
  std::int64_t Layers = 0;
  std::int64_t AllWidth;
  std::int64_t AllHeight;
  std::int64_t First = 0; ///< index, among all samples, of the window's first sample
  bool Whole = true;
};

} // namespace tipp

#endif
