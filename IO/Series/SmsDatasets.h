// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSmsDatasets_h
#define tippSmsDatasets_h

#include "Arrays/Scalar.h"
#include "Models/ModelMesh.h"

#include <cstdint>
#include <string>
#include <vector>

namespace tipp
{

/// What a file of values must know of the mesh that it belongs to.
struct SmsMeshShape
{
  explicit SmsMeshShape(const ModelMesh& mesh);

  std::int64_t Nodes = 0;
  std::vector<std::int64_t> Numbers;   ///< the number of each node in the file; empty: from 1 on
  std::int64_t Cells = 0;              ///< triangles and quadrilaterals
  std::vector<std::int64_t> Triangles; ///< see ModelMesh
  std::vector<std::int64_t> OriginalCells;
};

/// Values at the nodes of a mesh of SMS.
struct SmsDataset
{
  std::string Name;
  int Components = 1; ///< 2 for vectors
  Scalar Type = Scalar::Float64;
  std::vector<double> Times;
  std::string TimeUnits;      ///< such as "hours since 1950-01-01 00:00:00"; empty: not given
  std::vector<double> Values; ///< step by step; NaN at nodes without an active cell
};

/// Adds steps to a dataset of a mesh.
class SmsStep
{
public:
  SmsStep(const std::string& path, const SmsMeshShape& shape, SmsDataset& dataset);

  /// Throws IOError unless the mesh has this number of nodes and cells; `cells` may be 0, if the
  /// file does not say.
  void checkSize(std::int64_t nodes, std::int64_t cells) const;

  /// Adds the values of a step, as many as checkSize() has accepted times the components.
  /// `activeCells`: which cells have values; empty: all.
  void add(double time, const std::vector<double>& values, const std::vector<bool>& activeCells);

private:
  std::vector<bool> activeNodes(const std::vector<bool>& activeCells) const;

  const std::string& Path;
  const SmsMeshShape& Shape;
  SmsDataset& Dataset;
};

///@{
/// Read a .dat file of datasets, in ASCII or binary
/// (https://www.xmswiki.com/wiki/ASCII_Dataset_Files_*.dat, .../Binary_Dataset_Files_*.dat). Throw
/// IOError if it is damaged or belongs to another mesh.
std::vector<SmsDataset> readSmsText(const std::string& path, const SmsMeshShape& shape);
std::vector<SmsDataset> readBinarySmsDatasets(const std::string& path, const SmsMeshShape& shape);
///@}

/// Returns "hours since 1950-01-01 00:00:00" and its like for a unit and the Julian day of the
/// origin; the unit alone for day 0.
std::string smsTimeUnits(const std::string& unit, double julianDay);

} // namespace tipp

#endif
