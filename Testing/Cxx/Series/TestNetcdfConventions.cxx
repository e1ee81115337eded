// SPDX-License-Identifier: BSD-3-Clause
#include "ExpectIOError.h"
#include "Models/ModelMesh.h"
#include "NetcdfWriter.h"
#include "Series/MeshSeries.h"
#include "Series/WriteUgrid.h"
#include "TemporaryFolder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace
{

using namespace tipp;
using namespace tipp::test;
using Ids = std::vector<std::int64_t>;
using Doubles = std::vector<double>;

/// A square with an apex: nodes (0, 0), (1, 0), (1, 1), (0, 1), (0.4, 2); a quadrilateral and a
/// triangle.
class NetcdfConventions : public testing::Test
{
protected:
  std::string path(const std::string& name) const { return this->Folder.path(name); }

  int addNodes(NetcdfWriter& writer, const std::string& name) const
  {
    return writer.dimension(name, 5);
  }

  static constexpr double fill = -999;
  const Doubles X{ 0, 1, 1, 0, 0.4 };
  const Doubles Y{ 0, 0, 1, 1, 2 };

  /// A UGRID file with faces numbered from `first`; transposed: corners first.
  void writeUgrid(const std::string& path, int first, bool isTransposed, bool statesFirst,
    int format = NC_NETCDF4) const
  {
    NetcdfWriter w(path, format);
    const int nodes = this->addNodes(w, "nodes");
    const int faces = w.dimension("faces", 2);
    const int four = w.dimension("four", 4);
    const int topology = w.variable("mesh", NC_INT, {});
    w.text(topology, "cf_role", "mesh_topology");
    w.number(topology, "topology_dimension", NC_INT, { 2 });
    w.text(topology, "node_coordinates", "nx ny");
    w.text(topology, "face_node_connectivity", "corners");
    if (isTransposed)
    {
      w.text(topology, "face_dimension", "faces");
    }
    const int x = w.variable("nx", NC_DOUBLE, { nodes });
    const int y = w.variable("ny", NC_DOUBLE, { nodes });
    const int corners = w.variable(
      "corners", NC_INT, isTransposed ? std::vector{ four, faces } : std::vector{ faces, four });
    w.number(corners, "_FillValue", NC_INT, { fill });
    if (statesFirst)
    {
      w.number(corners, "start_index", NC_INT, { double(first) });
    }
    w.put(x, this->X);
    w.put(y, this->Y);
    const double f = first;
    w.put(corners,
      isTransposed ? Doubles{ f, 3 + f, 1 + f, 2 + f, 2 + f, 4 + f, 3 + f, fill }
                   : Doubles{ f, 1 + f, 2 + f, 3 + f, 3 + f, 2 + f, 4 + f, fill });
  }

  /// Expects the mesh of the class comment.
  static void expectMesh(MeshSeries& series, const std::string& kind)
  {
    EXPECT_EQ(kind, series.Kind);
    EXPECT_EQ(5, series.Nodes);
    const SeriesMesh mesh = series.readMesh();
    EXPECT_EQ((Doubles{ 0, 0, 1, 0, 1, 1, 0, 1, 0.4, 2 }), mesh.XY);
    EXPECT_EQ((Ids{ 0, 0, 1 }), mesh.OriginalCells);
    ASSERT_EQ(9U, mesh.Triangles.size());
    EXPECT_EQ((Ids{ 3, 2, 4 }), Ids(mesh.Triangles.begin() + 6, mesh.Triangles.end()));
  }

  TemporaryFolder Folder;
};

TEST_F(NetcdfConventions, UgridIsReadInEveryVariant)
{
  for (const int format : { 0, NC_NETCDF4 })
  {
    for (const int first : { 0, 1 })
    {
      for (const bool isTransposed : { false, true })
      {
        for (const bool statesFirst : { false, true })
        {
          this->writeUgrid(this->path("u.nc"), first, isTransposed, statesFirst, format);
          expectMesh(*openMeshSeries(this->path("u.nc")), "UGRID");
        }
      }
    }
  }
}

TEST_F(NetcdfConventions, UgridWithoutRolesIsReadByItsAttributes)
{
  NetcdfWriter w(this->path("u.nc"));
  const int nodes = this->addNodes(w, "nodes");
  const int faces = w.dimension("faces", 2);
  const int four = w.dimension("four", 4);
  const int topology = w.variable("mesh", NC_INT, {});
  w.text(topology, "node_coordinates", "lat lon"); // the wrong way round, as units show
  w.text(topology, "face_node_connectivity", "corners");
  const int x = w.variable("lon", NC_DOUBLE, { nodes });
  const int y = w.variable("lat", NC_DOUBLE, { nodes });
  w.text(x, "units", "degrees_east");
  w.text(y, "units", "degrees_north");
  // A triangle repeats its last corner; numbers are reals.
  const int corners = w.variable("corners", NC_DOUBLE, { faces, four });
  w.put(x, this->X);
  w.put(y, this->Y);
  w.put(corners, { 1, 2, 3, 4, 4, 3, 5, 5 });
  const auto series = openMeshSeries(w.close());
  expectMesh(*series, "UGRID");
  EXPECT_EQ("EPSG:4326", series->Crs);
}

TEST_F(NetcdfConventions, ValuesAtNodesAndFacesVaryInTime)
{
  this->writeUgrid(this->path("u.nc"), 0, false, true);
  {
    NetcdfWriter w(this->path("v.nc"));
    const int time = w.dimension("time", NC_UNLIMITED);
    const int nodes = this->addNodes(w, "nodes");
    const int faces = w.dimension("faces", 2);
    const int layers = w.dimension("layers", 7);
    const int t = w.variable("time", NC_DOUBLE, { time });
    w.text(t, "units", "hours since 2001-02-03 04:05:06");
    w.text(t, "calendar", "noleap");
    const int atNodes = w.variable("zeta", NC_FLOAT, { time, nodes });
    w.text(atNodes, "units", "m");
    w.text(atNodes, "long_name", "water level");
    w.number(atNodes, "_FillValue", NC_FLOAT, { -99999 });
    const int onFaces = w.variable("speed", NC_DOUBLE, { faces, time }); // in the other order
    w.variable("temp", NC_FLOAT, { time, layers, nodes });
    const int depth = w.variable("depth", NC_SHORT, { nodes });
    w.putAt(t, { 0 }, { 2 }, { 6, 12 });
    w.putAt(atNodes, { 0, 0 }, { 2, 5 }, { 1, 2, 3, 4, 5, 6, 7, -99999, 9, 10 });
    w.putAt(onFaces, { 0, 0 }, { 2, 2 }, { 0.1, 0.2, 0.3, 0.4 });
    w.put(depth, { 9, 8, 7, 6, 5 });
  }
  const auto series = openMeshSeries(this->path("u.nc"), { { this->path("v.nc") }, false });
  EXPECT_EQ((Doubles{ 6, 12 }), series->Times);
  EXPECT_EQ("hours since 2001-02-03 04:05:06", series->TimeUnits);
  EXPECT_EQ("noleap", series->Calendar);
  ASSERT_EQ(3U, series->Variables.size());
  const SeriesVariable& zeta = series->Variables[findSeriesVariable(*series, "zeta")];
  EXPECT_EQ("m", zeta.Units);
  EXPECT_EQ("water level", zeta.LongName);
  EXPECT_EQ(Scalar::Float32, zeta.Type);
  EXPECT_TRUE(zeta.Varies);
  EXPECT_FALSE(zeta.OnCells);
  Doubles values;
  series->read(findSeriesVariable(*series, "zeta"), 1, values);
  EXPECT_TRUE(std::isnan(values.at(2)));
  values[2] = 0;
  EXPECT_EQ((Doubles{ 6, 7, 0, 9, 10 }), values);
  series->read(findSeriesVariable(*series, "speed"), 1, values);
  EXPECT_EQ((Doubles{ 0.2, 0.2, 0.4 }), values); // of the quadrilateral's two triangles, and one
  series->read(findSeriesVariable(*series, "depth"), 1, values);
  EXPECT_EQ((Doubles{ 9, 8, 7, 6, 5 }), values);
  expectIOError(this->path("u.nc"), "'temp' has the dimension 'layers' of 7",
    [&] { findSeriesVariable(*series, "temp"); });
  expectIOError(this->path("u.nc"), "there are 'depth', 'speed', 'zeta'",
    [&] { findSeriesVariable(*series, "none"); });
}

TEST_F(NetcdfConventions, StepsThatDoNotAscendAreRefused)
{
  this->writeUgrid(this->path("u.nc"), 0, false, true);
  for (const double second : { 6.0, double(NC_FILL_DOUBLE) })
  {
    NetcdfWriter w(this->path("v.nc"));
    const int time = w.dimension("time", 2);
    const int nodes = this->addNodes(w, "nodes");
    const int t = w.variable("time", NC_DOUBLE, { time });
    w.variable("zeta", NC_FLOAT, { time, nodes });
    w.put(t, { 6, second });
    w.close();
    expectIOError(this->path("v.nc"), second == 6 ? "do not ascend" : "no time",
      [&] {
        openMeshSeries(this->path("u.nc"), { { this->path("v.nc") }, false });
      });
  }
}

TEST_F(NetcdfConventions, ValuesOfAnotherMeshAreRefused)
{
  this->writeUgrid(this->path("u.nc"), 0, false, true);
  NetcdfWriter w(this->path("v.nc"));
  w.variable("zeta", NC_FLOAT, { w.dimension("nodes", 6) });
  w.close();
  expectIOError(this->path("v.nc"), "has 6 nodes by its dimension 'nodes', but the mesh has 5",
    [&] {
      openMeshSeries(this->path("u.nc"), { { this->path("v.nc") }, false });
    });
}

TEST_F(NetcdfConventions, AdcircIsReadWithItsDepthAndTime)
{
  NetcdfWriter w(this->path("fort.63.nc"));
  const int time = w.dimension("time", NC_UNLIMITED);
  const int nodes = this->addNodes(w, "node");
  const int elements = w.dimension("nele", 3);
  const int three = w.dimension("nvertex", 3);
  const int t = w.variable("time", NC_DOUBLE, { time });
  w.text(t, "units", "seconds since 2008-09-01 00:00:00   !NCDASE - BASE_DAT");
  const int x = w.variable("x", NC_DOUBLE, { nodes });
  const int y = w.variable("y", NC_DOUBLE, { nodes });
  const int element = w.variable("element", NC_INT, { elements, three });
  w.number(element, "start_index", NC_INT, { 1 });
  const int depth = w.variable("depth", NC_DOUBLE, { nodes });
  const int zeta = w.variable("zeta", NC_DOUBLE, { time, nodes });
  w.number(zeta, "_FillValue", NC_DOUBLE, { -99999 });
  w.put(x, this->X);
  w.put(y, this->Y);
  w.put(element, { 1, 2, 3, 1, 3, 4, 4, 3, 5 });
  w.put(depth, { 1, 2, 3, 4, 5 });
  w.putAt(t, { 0 }, { 1 }, { 3600 });
  w.putAt(zeta, { 0, 0 }, { 1, 5 }, { 0, 1, -99999, 3, 4 });
  const auto series = openMeshSeries(w.close());
  EXPECT_EQ("ADCIRC", series->Kind);
  EXPECT_EQ("seconds since 2008-09-01 00:00:00", series->TimeUnits);
  const SeriesMesh mesh = series->readMesh();
  EXPECT_EQ((Ids{ 0, 1, 2, 0, 2, 3, 3, 2, 4 }), mesh.Triangles);
  EXPECT_TRUE(mesh.OriginalCells.empty());
  Doubles values;
  series->read(findSeriesVariable(*series, "zeta"), 0, values);
  EXPECT_TRUE(std::isnan(values.at(2)));
  EXPECT_EQ(4, values.at(4));
  EXPECT_EQ(2U, series->Variables.size());
}

TEST_F(NetcdfConventions, SchismIsReadByTheNamesOfBothGenerations)
{
  const std::vector<std::vector<std::string>> generations = {
    { "SCHISM_hgrid_face_nodes", "SCHISM_hgrid_node_x", "SCHISM_hgrid_node_y" }, { "ele", "x", "y" }
  };
  for (const auto& names : generations)
  {
    NetcdfWriter w(this->path("schout.nc"));
    const int nodes = this->addNodes(w, "nSCHISM_hgrid_node");
    const int faces = w.dimension("nSCHISM_hgrid_face", 2);
    const int four = w.dimension("nMaxSCHISM_hgrid_face_nodes", 4);
    const int corners = w.variable(names[0], NC_INT, { faces, four });
    const int x = w.variable(names[1], NC_DOUBLE, { nodes });
    const int y = w.variable(names[2], NC_DOUBLE, { nodes });
    w.put(x, this->X);
    w.put(y, this->Y);
    w.put(corners, { 1, 2, 3, 4, 4, 3, 5, -1 });
    expectMesh(*openMeshSeries(w.close()), "SCHISM");
  }
}

TEST_F(NetcdfConventions, FvcomIsReadWithItsExactTimes)
{
  for (const bool isPlanar : { false, true })
  {
    NetcdfWriter w(this->path("fvcom.nc"));
    w.text(NC_GLOBAL, "CoordinateSystem", isPlanar ? "Cartesian" : "GeoReferenced");
    const int time = w.dimension("time", 2);
    const int nodes = this->addNodes(w, "node");
    const int elements = w.dimension("nele", 6);
    const int three = w.dimension("three", 3);
    const int layers = w.dimension("siglay", 2);
    const int lon = w.variable("lon", NC_FLOAT, { nodes });
    const int lat = w.variable("lat", NC_FLOAT, { nodes });
    const int x = w.variable("x", NC_DOUBLE, { nodes });
    const int y = w.variable("y", NC_DOUBLE, { nodes });
    const int nv = w.variable("nv", NC_INT, { three, elements });
    const int t = w.variable("time", NC_FLOAT, { time });
    w.text(t, "units", "days since 1858-11-17 00:00:00");
    const int days = w.variable("Itime", NC_INT, { time });
    w.text(days, "units", "days since 1858-11-17 00:00:00");
    const int parts = w.variable("Itime2", NC_INT, { time });
    w.variable("u", NC_FLOAT, { time, layers, elements });
    const int ua = w.variable("ua", NC_FLOAT, { time, elements });
    w.put(lon, isPlanar ? Doubles(5, 0) : this->X);
    w.put(lat, isPlanar ? Doubles(5, 0) : this->Y);
    w.put(x, this->X);
    w.put(y, this->Y);
    w.put(nv, { 1, 1, 4, 1, 1, 4, 2, 3, 3, 2, 3, 3, 3, 4, 5, 3, 4, 5 });
    w.put(t, { 58000, 58000 }); // equal as floats
    w.put(days, { 58000, 58000 });
    w.put(parts, { 0, 60000 });
    w.put(ua, { 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11 });
    const auto series = openMeshSeries(w.close());
    EXPECT_EQ("FVCOM", series->Kind);
    EXPECT_EQ((Doubles{ 58000, 58000 + 60000 / 86400000.0 }), series->Times);
    const SeriesMesh mesh = series->readMesh();
    EXPECT_EQ((Ids{ 0, 1, 2 }), Ids(mesh.Triangles.begin(), mesh.Triangles.begin() + 3));
    EXPECT_EQ(1, mesh.XY.at(2));
    ASSERT_EQ(1U, series->LeftOut.size());
    EXPECT_EQ("u", series->LeftOut[0].Name);
    Doubles values;
    series->read(findSeriesVariable(*series, "ua"), 1, values);
    EXPECT_EQ((Doubles{ 6, 7, 8, 9, 10, 11 }), values);
  }
}

TEST_F(NetcdfConventions, FesomIsReadFromRadiansAndATransposedMesh)
{
  constexpr double radians = 3.14159265358979323846 / 180;
  for (const std::string corners : { "elements", "elem" })
  {
    {
      NetcdfWriter w(this->path("fesom.mesh.diag.nc"));
      const int two = w.dimension("n2", 2);
      const int three = w.dimension("n3", 3);
      const int nodes = this->addNodes(w, "nod2");
      const int elements = w.dimension("elem_n", 6);
      const int positions = w.variable("nodes", NC_DOUBLE, { two, nodes });
      const int ids = w.variable(corners, NC_INT, { three, elements });
      Doubles both;
      for (const Doubles& some : { this->X, this->Y })
      {
        for (const double value : some)
        {
          both.push_back(value * radians);
        }
      }
      w.put(positions, both);
      w.put(ids, { 1, 1, 4, 1, 1, 4, 2, 3, 3, 2, 3, 3, 3, 4, 5, 3, 4, 5 });
    }
    NetcdfWriter w(this->path("sst.nc"));
    const int time = w.dimension("time", 1);
    const int nodes = this->addNodes(w, "nod2");
    const int t = w.variable("time", NC_DOUBLE, { time });
    const int sst = w.variable("sst", NC_DOUBLE, { time, nodes });
    w.put(t, { 5 });
    w.put(sst, { 1, 2, 3, 4, 5 });
    w.close();
    const auto series =
      openMeshSeries(this->path("fesom.mesh.diag.nc"), { { this->path("sst.nc") }, false });
    EXPECT_EQ("FESOM", series->Kind);
    const SeriesMesh mesh = series->readMesh();
    EXPECT_NEAR(0.4, mesh.XY.at(8), 1e-12);
    EXPECT_NEAR(2, mesh.XY.at(9), 1e-12);
    EXPECT_EQ((Ids{ 3, 2, 4 }), Ids(mesh.Triangles.begin() + 6, mesh.Triangles.begin() + 9));
    Doubles values;
    series->read(findSeriesVariable(*series, "sst"), 0, values);
    EXPECT_EQ((Doubles{ 1, 2, 3, 4, 5 }), values);
  }
}

TEST_F(NetcdfConventions, MpasIsReadAsPolygonsOrAsItsDualMesh)
{
  constexpr double radians = 3.14159265358979323846 / 180;
  for (const bool hasPolygons : { true, false })
  {
    NetcdfWriter w(this->path("mpas.nc"));
    const int nodes = this->addNodes(w, hasPolygons ? "nVertices" : "nCells");
    const int cells = w.dimension(hasPolygons ? "nCells" : "nVertices", hasPolygons ? 2 : 3);
    const int width = w.dimension("width", hasPolygons ? 4 : 3);
    const std::string on = hasPolygons ? "Vertex" : "Cell";
    const int x = w.variable("lon" + on, NC_DOUBLE, { nodes });
    const int y = w.variable("lat" + on, NC_DOUBLE, { nodes });
    const int corners =
      w.variable(hasPolygons ? "verticesOnCell" : "cellsOnVertex", NC_INT, { cells, width });
    const int counts = hasPolygons ? w.variable("nEdgesOnCell", NC_INT, { cells }) : -1;
    const int data = w.variable("bottomDepth", NC_DOUBLE, { hasPolygons ? cells : nodes });
    Doubles lon;
    Doubles lat;
    for (std::size_t i = 0; i < 5; ++i)
    {
      lon.push_back(this->X[i] * radians);
      lat.push_back(this->Y[i] * radians);
    }
    w.put(x, lon);
    w.put(y, lat);
    // A triangle of the dual mesh at the border lacks a corner.
    w.put(corners,
      hasPolygons ? Doubles{ 1, 2, 3, 4, 4, 3, 5, 5 } : Doubles{ 1, 2, 3, 1, 0, 3, 4, 3, 5 });
    if (hasPolygons)
    {
      w.put(counts, { 4, 3 });
    }
    w.put(data, hasPolygons ? Doubles{ 10, 20 } : Doubles{ 1, 2, 3, 4, 5 });
    const auto series = openMeshSeries(w.close());
    EXPECT_EQ("MPAS", series->Kind);
    const SeriesMesh mesh = series->readMesh();
    Doubles values;
    series->read(findSeriesVariable(*series, "bottomDepth"), 0, values);
    EXPECT_EQ(hasPolygons ? (Doubles{ 10, 10, 20 }) : (Doubles{ 1, 2, 3, 4, 5 }), values);
    EXPECT_EQ(hasPolygons ? (Ids{ 0, 0, 1 }) : (Ids{ 0, 2 }), mesh.OriginalCells);
    EXPECT_NEAR(0.4, mesh.XY.at(8), 1e-12);
  }
}

TEST_F(NetcdfConventions, MpasDatesBecomeSecondsOfItsCalendar)
{
  const auto write = [this](const std::string& calendar, const std::string& last)
  {
    NetcdfWriter w(this->path("mpas.nc"));
    const int nodes = this->addNodes(w, "nCells");
    const int cells = w.dimension("nVertices", 1);
    const int three = w.dimension("three", 3);
    const int time = w.dimension("Time", 2);
    const int length = w.dimension("StrLen", 64);
    w.text(NC_GLOBAL, "config_calendar_type", calendar);
    const int x = w.variable("lonCell", NC_DOUBLE, { nodes });
    const int y = w.variable("latCell", NC_DOUBLE, { nodes });
    const int corners = w.variable("cellsOnVertex", NC_INT, { cells, three });
    const int dates = w.variable("xtime", NC_CHAR, { time, length });
    const int ssh = w.variable("ssh", NC_DOUBLE, { time, nodes });
    w.put(x, this->X);
    w.put(y, this->Y);
    w.put(corners, { 1, 2, 3 });
    w.put(ssh, Doubles(10, 1));
    std::string text = "2004-02-28_12:00:00";
    text.resize(64, ' ');
    text += last;
    text.resize(128, ' ');
    NetcdfWriter::check(nc_put_var_text(w.file(), dates, text.c_str()));
    return w.close();
  };
  auto series = openMeshSeries(write("gregorian", "2004-03-01_00:00:30"));
  EXPECT_EQ((Doubles{ 0, 1.5 * 86400 + 30 }), series->Times);
  EXPECT_EQ("seconds since 2004-02-28 12:00:00", series->TimeUnits);
  EXPECT_EQ("proleptic_gregorian", series->Calendar);
  series.reset(); // which has the file open
  series = openMeshSeries(write("gregorian_noleap", "2004-03-01_00:00:30"));
  EXPECT_EQ((Doubles{ 0, 0.5 * 86400 + 30 }), series->Times);
  EXPECT_EQ("noleap", series->Calendar);
  series.reset();
  for (const char* const last : { "later", "2004-04-31_00:00:00" })
  {
    series = openMeshSeries(write("gregorian", last));
    EXPECT_EQ((Doubles{ 0, 1 }), series->Times);
    EXPECT_EQ("time", series->LeftOut.at(0).Name);
    EXPECT_EQ(0U, series->LeftOut.at(0).Reason.find("has the date '" + std::string(last)));
    series.reset();
  }
  const std::string path = write("360day", "2004-03-01_00:00:30");
  expectIOError(path, "only those of gregorian", [&] { openMeshSeries(path); });
}

TEST_F(NetcdfConventions, NodesAreReadAsPointsWhateverTheCells)
{
  NetcdfWriter w(this->path("fort.63.nc"));
  const int nodes = w.dimension("node", 3);
  const int elements = w.dimension("nele", 1);
  const int three = w.dimension("nvertex", 3);
  const int x = w.variable("x", NC_DOUBLE, { nodes });
  w.text(x, "units", "degrees_east");
  const int y = w.variable("y", NC_DOUBLE, { nodes });
  const int element = w.variable("element", NC_INT, { elements, three });
  const int depth = w.variable("depth", NC_DOUBLE, { nodes });
  w.put(x, { 179, -179, -178 });
  w.put(y, { 0, 0, 1 });
  w.put(element, { 1, 2, 3 });
  w.put(depth, { 7, 8, 9 });
  const std::string path = w.close();
  expectIOError(path, "give --wrap", [&] { readModelMesh(path, ModelPart::Triangles); });
  const ModelMesh mesh = readModelMesh(path, ModelPart::Nodes);
  EXPECT_EQ((Doubles{ 179, 0, -179, 0, -178, 1 }), mesh.XY);
  ASSERT_EQ(1U, mesh.Columns.size());
  EXPECT_EQ("depth", mesh.Columns[0].Name);
  EXPECT_EQ((Doubles{ 7, 8, 9 }), mesh.Columns[0].Values);
}

TEST_F(NetcdfConventions, CornersThatAreNoNodesAreNamed)
{
  this->writeUgrid(this->path("u.nc"), 0, false, true);
  int file = 0;
  int corners = 0;
  NetcdfWriter::check(nc_open(this->path("u.nc").c_str(), NC_WRITE, &file));
  NetcdfWriter::check(nc_inq_varid(file, "corners", &corners));
  const std::size_t at[2] = { 1, 2 };
  const int wrong = 5;
  NetcdfWriter::check(nc_put_var1_int(file, corners, at, &wrong));
  NetcdfWriter::check(nc_close(file));
  expectIOError(this->path("u.nc"), "cell 1 (from 0) names node 5, but there are 5 nodes",
    [&] { openMeshSeries(this->path("u.nc"))->readMesh(); });
}

TEST_F(NetcdfConventions, AStartIndexOtherThanZeroOrOneIsRefused)
{
  this->writeUgrid(this->path("u.nc"), 0, false, true);
  int file = 0;
  int corners = 0;
  NetcdfWriter::check(nc_open(this->path("u.nc").c_str(), NC_WRITE, &file));
  NetcdfWriter::check(nc_inq_varid(file, "corners", &corners));
  NetcdfWriter::check(nc_redef(file));
  const int start = 5;
  NetcdfWriter::check(nc_put_att_int(file, corners, "start_index", NC_INT, 1, &start));
  NetcdfWriter::check(nc_close(file));
  expectIOError(this->path("u.nc"), "states that its nodes are counted from 5",
    [&] { openMeshSeries(this->path("u.nc"))->readMesh(); });
  NetcdfWriter::check(nc_open(this->path("u.nc").c_str(), NC_WRITE, &file));
  NetcdfWriter::check(nc_redef(file));
  NetcdfWriter::check(nc_put_att_text(file, corners, "start_index", 3, "one"));
  NetcdfWriter::check(nc_close(file));
  expectIOError(this->path("u.nc"), "has the start_index 'one', which is no number",
    [&] { openMeshSeries(this->path("u.nc"))->readMesh(); });
}

TEST_F(NetcdfConventions, WrittenUgridKeepsEachWholeNumber)
{
  const std::vector<std::int32_t> ids{ 0, NC_FILL_INT, 2 };
  UgridContent content;
  content.Nodes = 3;
  content.Triangles = 1;
  content.Node = [](std::int64_t node) { return Point2{ double(node % 2), double(node / 2) }; };
  content.Corner = [](std::int64_t, int corner) { return corner; };
  content.Arrays.push_back({ "id", "", "", Scalar::Int32, false, false,
    [&ids](std::size_t) { return static_cast<const void*>(ids.data()); } });
  ASSERT_TRUE(tipp::writeUgrid(this->path("u.nc"), content, std::nullopt, {}));
  int file = 0;
  int id = 0;
  int hasNoFill = 0;
  NetcdfWriter::check(nc_open(this->path("u.nc").c_str(), NC_NOWRITE, &file));
  NetcdfWriter::check(nc_inq_varid(file, "id", &id));
  NetcdfWriter::check(nc_inq_var_fill(file, id, &hasNoFill, nullptr));
  std::vector<std::int32_t> values(3);
  NetcdfWriter::check(nc_get_var_int(file, id, values.data()));
  NetcdfWriter::check(nc_close(file));
  EXPECT_EQ(1, hasNoFill);
  EXPECT_EQ(ids, values);
}

TEST_F(NetcdfConventions, AFileWithoutAMeshIsRefused)
{
  NetcdfWriter w(this->path("a.nc"));
  w.variable("v", NC_DOUBLE, { w.dimension("n", 3) });
  w.close();
  expectIOError(this->path("a.nc"), "has no mesh", [&] { openMeshSeries(this->path("a.nc")); });
}

TEST_F(NetcdfConventions, TheReferenceSystemIsThatOfTheGridMapping)
{
  this->writeUgrid(this->path("u.nc"), 0, false, true);
  NetcdfWriter w(this->path("v.nc"));
  w.close();
  int file = 0;
  NetcdfWriter::check(nc_open(this->path("u.nc").c_str(), NC_WRITE, &file));
  NetcdfWriter::check(nc_redef(file));
  int id = 0;
  NetcdfWriter::check(nc_def_var(file, "crs", NC_INT, 0, nullptr, &id));
  const int code = 28992;
  NetcdfWriter::check(nc_put_att_int(file, id, "epsg", NC_INT, 1, &code));
  NetcdfWriter::check(nc_inq_varid(file, "nx", &id));
  NetcdfWriter::check(nc_put_att_text(file, id, "grid_mapping", 3, "crs"));
  NetcdfWriter::check(nc_close(file));
  EXPECT_EQ("EPSG:28992", openMeshSeries(this->path("u.nc"))->Crs);
}

} // namespace
