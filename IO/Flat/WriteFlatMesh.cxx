// SPDX-License-Identifier: BSD-3-Clause
#include "Flat/WriteFlatMesh.h"

#include "Files/IOError.h"
#include "Files/PendingFolder.h"
#include "Flat/ArrayFileName.h"
#include "Npy/NpyFile.h"

#include <algorithm>
#include <filesystem>
#include <limits>

namespace tipp
{
namespace
{

void writeArray(const std::string& path, const FlatArray& array, bool table)
{
  std::vector<std::int64_t> shape;
  if (array.Steps > 0)
  {
    shape.push_back(array.Steps);
  }
  shape.push_back(array.Tuples);
  if (array.Components > 1 || table)
  {
    shape.push_back(array.Components);
  }
  NpyWriter writer(path, scalarDescr(array.Type), shape);
  const std::size_t tuples =
    std::size_t(array.Tuples) * std::size_t(std::max<std::int64_t>(array.Steps, 1));
  writer.write(array.Values, tuples * std::size_t(array.Components) * scalarSize(array.Type));
  writer.close();
}

void writeCells(const std::string& path, const FlatContent& content)
{
  const std::int64_t count = std::int64_t(content.Cells.size()) / content.CellSize;
  FlatArray array{ "cells", Scalar::Int64, content.CellSize, count, 0, content.Cells.data(), {} };
  std::vector<std::int32_t> narrow;
  if (content.Points.Tuples <= std::numeric_limits<std::int32_t>::max())
  {
    narrow.assign(content.Cells.begin(), content.Cells.end());
    array.Type = Scalar::Int32;
    array.Values = narrow.data();
  }
  writeArray(path, array, true);
}

bool writeData(const std::string& folder, const std::vector<FlatArray>& arrays,
  const std::function<bool()>& aborted)
{
  std::filesystem::create_directory(folder);
  for (const FlatArray& array : arrays)
  {
    if (aborted && aborted())
    {
      return false;
    }
    const std::string path = folder + "/" + arrayFileName(array.Name) + ".npy";
    if (array.Name.empty() || std::filesystem::exists(path))
    {
      throw IOError(folder,
        "cannot hold the array '" + array.Name +
          "', which has no name or that of another; rename it.");
    }
    writeArray(path, array, false);
  }
  return true;
}

} // namespace

bool writeFlatMesh(
  const std::string& path, const FlatContent& content, const std::function<bool()>& aborted)
{
  PendingFolder folder(path);
  const std::string& in = folder.temporaryPath();
  writeCells(in + "/cells.npy", content);
  writeArray(in + "/points.npy", content.Points, true);
  if (!content.Times.empty())
  {
    const auto steps = std::int64_t(content.Times.size());
    writeArray(
      in + "/time.npy", { "time", Scalar::Float64, 1, steps, 0, content.Times.data(), {} }, false);
  }
  if (!writeData(in + "/point_data", content.PointData, aborted) ||
    !writeData(in + "/cell_data", content.CellData, aborted) || (aborted && aborted()))
  {
    return false;
  }
  folder.commit();
  return true;
}

} // namespace tipp
