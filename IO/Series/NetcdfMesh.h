// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippNetcdfMesh_h
#define tippNetcdfMesh_h

#include "Netcdf/NetcdfFile.h"
#include "Series/CutCells.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <string>

namespace tipp
{

/// Which variables of a NetCDF file are its mesh, by the convention that the file follows.
struct NetcdfMesh
{
  std::string Kind; ///< the convention
  const NetcdfVariable* X = nullptr;
  const NetcdfVariable* Y = nullptr; ///< the same as X: one variable of two rows has both
  const NetcdfVariable* Corners = nullptr;
  const NetcdfVariable* Counts = nullptr; ///< the number of corners per cell, or null
  int NodeDimension = -1;
  int CellDimension = -1;
  /// The number of the first node if the file does not say; nullopt: decided by the numbers.
  std::optional<std::int64_t> FirstNode;
  /// Cells with a corner missing are left out: those at the border of a dual mesh.
  bool SkipsIncomplete = false;
  std::set<std::string> Parts; ///< names of the variables that describe the mesh
};

///@{
/// Find the mesh of one convention. nullopt if the file does not follow it; throw IOError if it
/// does, and lacks a part.
std::optional<NetcdfMesh> findUgridMesh(const std::string& path, const NetcdfContent& content);
std::optional<NetcdfMesh> findMpasMesh(const std::string& path, const NetcdfContent& content);
/// By the names of the variables that ADCIRC, FESOM, FVCOM and SCHISM use.
std::optional<NetcdfMesh> findNamedMesh(const std::string& path, const NetcdfContent& content);
///@}

/// Sets NodeDimension and CellDimension by the dimensions of Corners and X. `cellDimension` is the
/// name of the cells' dimension if the file says. Throws IOError if they do not fit.
void setMeshDimensions(const std::string& path, const NetcdfContent& content, NetcdfMesh& mesh,
  const std::string& cellDimension);

/// Reads the nodes and cells, which throws IOError, with the cell, for corners that are not nodes.
/// The file and the mesh must outlive the result.
std::unique_ptr<CellBlocks> openNetcdfCells(NetcdfFile& file, const NetcdfMesh& mesh);

/// Whether the coordinates are longitudes and latitudes.
bool isInDegrees(const NetcdfMesh& mesh);

} // namespace tipp

#endif
