// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippMeshEditor_h
#define tippMeshEditor_h

#include "Kernel/DelaunayKernel.h"
#include "Predicates/InCircle.h"
#include "Predicates/Orientation.h"

#include <array>
#include <cstddef>
#include <vector>

namespace tipp
{

/// Changes the triangles of a DelaunayKernel; the mesh of a SegmentInserter. Half-edges and
/// triangles are named by indices that only this class interprets.
class MeshEditor
{
public:
  using Index = DelaunayKernel::Index;

  /// Begins to edit a kernel's mesh, which must outlive the edits. After a change only the kernel's
  /// clear() may follow.
  void begin(DelaunayKernel& kernel)
  {
    this->Kernel = &kernel;
    this->Mesh = &kernel.Mesh;
    const Index end = this->Mesh->end();
    this->Fixed.assign(std::size_t(end / 8), 0);
    this->Out.assign(std::size_t(kernel.vertexEnd()), NoHalf);
    const Index* const slots = this->Mesh->slots();
    for (Index t = 0; t < end; t += 8)
    {
      this->Out[std::size_t(slots[t])] = t + 2;
      this->Out[std::size_t(slots[t + 1])] = t;
      this->Out[std::size_t(slots[t + 2])] = t + 1;
    }
  }

  static Index half(Index triangle, Index corner)
  {
    return corner == 0 ? triangle + 2 : triangle + corner - 1;
  }
  static Index triangleOf(Index h) { return HalfEdgeMesh::triangleOf(h); }
  static Index next(Index h) { return (h & 7) == 2 ? h - 2 : h + 1; }
  static Index previous(Index h) { return (h & 7) == 0 ? h + 2 : h - 1; }
  Index from(Index h) const { return this->Mesh->vertex(next(h)); }
  Index to(Index h) const { return this->Mesh->vertex(previous(h)); }
  Index apex(Index h) const { return this->Mesh->vertex(h); }
  Index twin(Index h) const { return this->Mesh->twin(h); }
  Point2 at(Index v) const { return this->Kernel->point(v); }

  /// Whether a vertex has triangles. One with the coordinates of another has none.
  bool isUsed(Index v) const { return this->out(v) != NoHalf; }
  /// A half-edge from the vertex.
  Index out(Index v) const { return this->Out[std::size_t(v)]; }

  void join(Index h, Index g) { this->Mesh->link(h, g); }
  bool isFixed(Index h) const { return (this->Fixed[std::size_t(h / 8)] >> (h & 7) & 1) != 0; }
  void setFixed(Index h, bool isFixed)
  {
    unsigned char& bits = this->Fixed[std::size_t(h / 8)];
    const unsigned bit = 1U << (h & 7);
    bits = static_cast<unsigned char>(isFixed ? bits | bit : bits & ~bit);
  }
  void markRemoved(Index triangle) { this->Fixed[std::size_t(triangle / 8)] |= RemovedBit; }
  bool isRemoved(Index triangle) const
  {
    return (this->Fixed[std::size_t(triangle / 8)] & RemovedBit) != 0;
  }
  void setCorners(Index triangle, const std::array<Index, 3>& corners)
  {
    Index* const slots = this->Mesh->slots() + triangle;
    this->Fixed[std::size_t(triangle / 8)] = 0;
    for (Index i = 0; i < 3; ++i)
    {
      slots[i] = corners[std::size_t(i)];
      this->Out[std::size_t(slots[i])] = half(triangle, i);
    }
  }

  int turn(Index a, Index b, Index c) const
  {
    return orientation(this->at(a), this->at(b), this->at(c));
  }
  bool mustFlip(Index h) const
  {
    const Index beyond = this->apex(this->twin(h));
    return beyond != DelaunayKernel::Infinite && !this->isFixed(h) &&
      inCirclePerturbed(
        this->at(this->from(h)), this->at(this->to(h)), this->at(this->apex(h)), this->at(beyond));
  }

private:
  static constexpr Index NoHalf = -1;
  static constexpr unsigned char RemovedBit = 1U << 7;

  DelaunayKernel* Kernel = nullptr;
  HalfEdgeMesh* Mesh = nullptr;
  std::vector<unsigned char> Fixed; ///< by triangle: a bit for each half-edge
  std::vector<Index> Out;           ///< by vertex: a half-edge from it
};

} // namespace tipp

#endif
