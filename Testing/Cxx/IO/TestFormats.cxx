// SPDX-License-Identifier: BSD-3-Clause
#include "Files/Formats.h"
#include "Files/IOError.h"
#include "Files/TextFile.h"
#include "Points/ReadPoints.h"
#include "Vtk/DataSets.h"

#include "vtkDataSet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

namespace
{

using tipp::Opener;
using tipp::Use;

TEST(Formats, ChoosesByExtensionAndUse)
{
  EXPECT_EQ(tipp::openerOf("a/b.LAZ", Use::Points), Opener::Las);
  EXPECT_EQ(tipp::openerOf("zones.csv", Use::Zones), Opener::Gdal);
  EXPECT_EQ(tipp::openerOf("points.csv", Use::Points), Opener::Text);
  EXPECT_EQ(tipp::openerOf("-", Use::Points), Opener::Text);
  EXPECT_EQ(tipp::openerOf("-", Use::Constraints), Opener::None);
  EXPECT_EQ(tipp::openerOf("mesh.tipp/", Use::WritesPieces), Opener::Pieces);
  EXPECT_EQ(tipp::openerOf("a.tsv", Use::Constraints), Opener::None);
  EXPECT_EQ(tipp::formatOf("las", Use::Points), nullptr);
  EXPECT_TRUE(tipp::isOpenedBy("a.TIFF", Opener::GeoTiff));
  EXPECT_FALSE(tipp::isOpenedBy("a.asc", Opener::GeoTiff));
}

TEST(Formats, ListsExtensionsForMessages)
{
  EXPECT_EQ(tipp::listFormats(Use::WritesRasters), ".tif, .npy or .vti");
  EXPECT_EQ(tipp::listFormats(Use::WritesPieces), ".tipp");
  EXPECT_EQ(tipp::listFormats(Use::Points, " or one of VTK's"),
    ".npy, .csv, .txt, .xyz (or these as .gz, .xz or .zst), .las, .laz, .gpkg, .shp, .geojson, "
    ".fgb, .kml, .dxf, .14, .grd, .gr3, .2dm, .nc, .slf, .msh, .node or one of VTK's");
}

/// Every format of points has a reader: a file that is damaged, or that this build cannot read, is
/// refused for another reason than its extension.
TEST(Formats, OfPointsHaveReaders)
{
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "Formats";
  std::filesystem::create_directory(folder);
  for (const std::string& extension : tipp::extensionsFor(Use::Points))
  {
    const std::string path = (folder / ("empty" + extension)).string();
    std::ofstream(path).close();
    try
    {
      tipp::readPoints(path);
    }
    catch (const tipp::IOError& error)
    {
      const std::string message = error.what();
      EXPECT_EQ(message.find("kind"), std::string::npos) << message;
    }
  }
  std::filesystem::remove_all(folder);
}

std::vector<std::string> wordsOf(const std::string& text)
{
  std::istringstream stream(text);
  return { std::istream_iterator<std::string>(stream), {} };
}

/// The extensions of the file choosers with this description in ParaView's panels.
std::vector<std::vector<std::string>> chosenIn(const std::string& name, const std::string& kind)
{
  const std::string xml = tipp::readTextFile(TIPP_PLUGIN "/" + name);
  std::vector<std::vector<std::string>> lists;
  const std::string start = "extensions=\"";
  for (std::size_t at = xml.find(start); at != std::string::npos; at = xml.find(start, at))
  {
    at += start.size();
    const std::size_t end = xml.find('"', at);
    const std::size_t close = xml.find('>', end);
    if (xml.substr(end, close - end).find("\"" + kind + "\"") != std::string::npos)
    {
      lists.push_back(wordsOf(xml.substr(at, end - at)));
    }
  }
  return lists;
}

void expectInParaView(const std::string& name, const std::string& kind, unsigned uses)
{
  const auto lists = chosenIn(name, kind);
  ASSERT_FALSE(lists.empty());
  std::vector<std::string> wanted;
  for (const std::string& extension : tipp::extensionsFor(uses))
  {
    wanted.push_back(extension.substr(1));
  }
  for (const std::vector<std::string>& list : lists)
  {
    EXPECT_EQ(list, wanted) << name << ", " << kind;
  }
}

TEST(Formats, AreThoseOfParaViewsFileChoosers)
{
  const std::string panel = "OutOfCoreDelaunay2D.xml";
  expectInParaView(panel, "Points", Use::Points);
  expectInParaView(panel, "Constraints", Use::Constraints);
  expectInParaView(panel, "Boundary", Use::Constraints);
  expectInParaView(panel, "Partitioned mesh (TIPP)", Use::WritesPieces);
  expectInParaView("Writer.xml", "Partitioned mesh (TIPP)", Use::WritesPieces);
  expectInParaView("Reader.xml", "Partitioned meshes (TIPP)", Use::WritesPieces);
}

} // namespace
