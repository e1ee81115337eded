// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPiecesHdf_h
#define tippPiecesHdf_h

#include "Hdf/HdfObjects.h"
#include "Partitioned/PieceFormat.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace tipp
{

/// An array of a VTKHDF file of pieces: the pieces' arrays of one step after those of another.
struct HdfColumn
{
  std::string Name;
  PieceArray Array;               ///< its type is the one in the VTKHDF file
  std::vector<std::size_t> Steps; ///< indices in pieceArrays(); one if the array does not vary
};

/// Encodes a partitioned mesh as a VTKHDF file of an unstructured grid with a partition for each
/// piece
/// (https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html, "VTKHDF File Format").
/// Where the values are is up to the derived class.
class PiecesHdf
{
public:
  explicit PiecesHdf(const PartitionedMesh& mesh);
  virtual ~PiecesHdf() = default;
  PiecesHdf(const PiecesHdf&) = delete;
  PiecesHdf& operator=(const PiecesHdf&) = delete;

protected:
  /// Adds the array of a column and returns its address. Called once for each column.
  virtual HdfAddress addColumn(const HdfColumn& column) = 0;

  /// Adds all objects and returns the root's address.
  HdfAddress addAll();

  /// Each piece's offsets begin with a 0 that is not in its file.
  static std::uint64_t leadOf(const HdfColumn& column);
  /// The number of a piece's tuples at a step, without the lead.
  std::uint64_t tuplesOf(const PieceSummary& piece, const HdfColumn& column) const;
  /// The number of tuples of all pieces at a step, with the leads.
  std::uint64_t stepTuples(const HdfColumn& column) const;
  /// Of all steps.
  HdfShape shapeOf(const HdfColumn& column) const;

  const PartitionedMesh& Mesh;
  HdfObjects Objects;
  std::vector<HdfLink> Root; ///< further members of the root group

private:
  void takeColumns();
  Scalar typeOfIds() const;
  std::vector<const HdfColumn*> find(PieceRole first, PieceRole last) const;
  std::vector<const HdfColumn*> findData(bool ofPoints) const;
  std::vector<HdfLink> addColumns(const std::vector<const HdfColumn*>& columns);
  HdfAddress addData(bool ofPoints);
  HdfAddress addCounts(bool ofPoints, std::int64_t times);
  HdfAddress addDataOffsets(bool ofPoints);
  HdfAddress addSteps();

  std::vector<HdfColumn> Columns;
};

} // namespace tipp

#endif
