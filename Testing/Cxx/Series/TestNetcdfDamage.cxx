// SPDX-License-Identifier: BSD-3-Clause
#include "Files/IOError.h"
#include "NetcdfWriter.h"
#include "Series/MeshSeries.h"
#include "TemporaryFolder.h"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

namespace
{

using namespace tipp;
using namespace tipp::test;

/// The bytes of a file with a mesh of triangles, two steps of values, and compression if it is of
/// NetCDF-4.
std::string meshFile(const TemporaryFolder& folder, int format)
{
  NetcdfWriter w(folder.path("whole.nc"), format);
  constexpr std::size_t side = 12;
  const int time = w.dimension("time", NC_UNLIMITED);
  const int nodes = w.dimension("node", side * side);
  const int elements = w.dimension("nele", 2 * (side - 1) * (side - 1));
  const int three = w.dimension("nvertex", 3);
  const int t = w.variable("time", NC_DOUBLE, { time });
  const int x = w.variable("x", NC_DOUBLE, { nodes });
  const int y = w.variable("y", NC_DOUBLE, { nodes });
  const int element = w.variable("element", NC_INT, { elements, three });
  const int zeta = w.variable("zeta", NC_FLOAT, { time, nodes });
  if (format == NC_NETCDF4)
  {
    for (const int variable : { x, y, element, zeta })
    {
      NetcdfWriter::check(nc_def_var_deflate(w.file(), variable, 1, 1, 4));
    }
  }
  std::vector<double> xs;
  std::vector<double> ys;
  std::vector<double> corners;
  for (std::size_t i = 0; i < side * side; ++i)
  {
    xs.push_back(double(i % side));
    ys.push_back(double(i / side));
    if (i % side + 1 < side && i / side + 1 < side)
    {
      const auto a = double(i + 1);
      corners.insert(corners.end(), { a, a + 1, a + side, a + 1, a + side + 1, a + side });
    }
  }
  w.put(x, xs);
  w.put(y, ys);
  w.put(element, corners);
  w.putAt(t, { 0 }, { 2 }, { 1, 2 });
  w.putAt(zeta, { 0, 0 }, { 1, side * side }, xs);
  w.putAt(zeta, { 1, 0 }, { 1, side * side }, ys);
  return contentOf(w.close());
}

/// Reads all of a file. Returns the message, or an empty text if there is no error.
std::string readAll(const std::string& path)
{
  try
  {
    const auto series = openMeshSeries(path);
    const SeriesMesh mesh = series->readMesh();
    for (const std::int64_t corner : mesh.Triangles)
    {
      EXPECT_TRUE(corner >= 0 && corner < series->Nodes);
    }
    std::vector<double> values;
    for (std::size_t i = 0; i < series->Variables.size(); ++i)
    {
      const bool isOnCells = series->Variables[i].OnCells;
      series->read(i, 0, values);
      EXPECT_EQ(isOnCells ? mesh.Triangles.size() / 3 : mesh.XY.size() / 2, values.size());
    }
  }
  catch (const IOError& error)
  {
    const std::string text = error.what();
    EXPECT_EQ(0U, text.find(path)) << text;
    EXPECT_EQ('.', text.back()) << text;
    return text;
  }
  return "";
}

class DamagedNetcdf : public testing::TestWithParam<int>
{
protected:
  TemporaryFolder Folder;
};

TEST_P(DamagedNetcdf, FilesThatAreCutOffAreReported)
{
  const std::string whole = meshFile(this->Folder, GetParam());
  EXPECT_EQ("", readAll(this->Folder.path("whole.nc")));
  constexpr std::size_t places = 50;
  for (std::size_t i = 0; i < places; ++i)
  {
    const std::string path =
      this->Folder.file("cut.nc", whole.substr(0, whole.size() * i / places));
    EXPECT_NE("", readAll(path)) << "cut off at byte " << whole.size() * i / places;
  }
}

TEST_P(DamagedNetcdf, FilesWithOtherBytesEndInASentence)
{
  const std::string whole = meshFile(this->Folder, GetParam());
  std::mt19937 random(20261129);
  int reported = 0;
  constexpr int mutants = 200;
  for (int i = 0; i < mutants; ++i)
  {
    std::string mutant = whole;
    for (unsigned changes = 1 + random() % 12; changes > 0; --changes)
    {
      // Half of the changes are in the beginning, where the structure is.
      const std::size_t most = random() % 2 == 0 ? mutant.size() : mutant.size() / 8;
      mutant[random() % most] = char(random());
    }
    reported += readAll(this->Folder.file("mutant.nc", mutant)).empty() ? 0 : 1;
  }
  EXPECT_GT(reported, mutants / 4);
}

INSTANTIATE_TEST_SUITE_P(Formats, DamagedNetcdf, testing::Values(0, NC_NETCDF4));

} // namespace
