// SPDX-License-Identifier: BSD-3-Clause
#include "ExpectIOError.h"
#include "Netcdf/NetcdfFile.h"
#include "NetcdfWriter.h"
#include "TemporaryFolder.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace
{

using namespace tipp;
using namespace tipp::test;

class NetcdfFiles : public testing::Test
{
protected:
  TemporaryFolder Folder;
};

TEST_F(NetcdfFiles, HaveDimensionsVariablesAndAttributes)
{
  for (const int format : { 0, NC_64BIT_OFFSET, NC_64BIT_DATA, NC_NETCDF4 })
  {
    NetcdfWriter writer(this->Folder.path("a.nc"), format);
    const int rows = writer.dimension("rows", 2);
    const int columns = writer.dimension("columns", 3);
    const int variable = writer.variable("heights", NC_FLOAT, { rows, columns });
    writer.text(variable, "units", "m");
    writer.number(variable, "range", NC_DOUBLE, { 1, 2.5 });
    writer.put(variable, { 1, 2, 3, 4, 5, 6 });
    NetcdfFile file(writer.close());
    const NetcdfVariable* const found = file.content().find("heights");
    ASSERT_TRUE(found);
    EXPECT_EQ((std::vector<std::int64_t>{ 2, 3 }), file.content().shape(*found));
    EXPECT_EQ("m", found->text("units"));
    ASSERT_TRUE(found->find("range"));
    EXPECT_EQ((std::vector<double>{ 1, 2.5 }), found->find("range")->Numbers);
    EXPECT_EQ(Scalar::Float32, found->unpackedType());
    EXPECT_EQ((std::vector<double>{ 1, 2, 3, 4, 5, 6 }), file.read(*found));
    std::vector<double> part;
    file.read(*found, { 0, 1 }, { 2, 2 }, part);
    EXPECT_EQ((std::vector<double>{ 2, 3, 5, 6 }), part);
  }
}

TEST_F(NetcdfFiles, GiveWhatIsAskedForWhateverIsPrefetched)
{
  NetcdfWriter writer(this->Folder.path("a.nc"));
  const int rows = writer.dimension("rows", 3);
  const int variable = writer.variable("v", NC_DOUBLE, { rows });
  writer.put(variable, { 1, 2, 3 });
  NetcdfFile file(writer.close());
  const NetcdfVariable& v = *file.content().find("v");
  std::vector<double> values;
  file.prefetch(v, { 1 }, { 1 });
  file.prefetch(v, { 2 }, { 1 });
  file.read(v, { 1 }, { 1 }, values);
  EXPECT_EQ(2, values.at(0));
  file.prefetch(v, { 1 }, { 1 });
  file.read(v, { 2 }, { 1 }, values);
  EXPECT_EQ(3, values.at(0));
  file.read(v, { 0 }, { 1 }, values);
  EXPECT_EQ(1, values.at(0));
}

TEST_F(NetcdfFiles, AreReadAgainAfterARest)
{
  NetcdfWriter writer(this->Folder.path("a.nc"));
  const int v = writer.variable("v", NC_DOUBLE, { writer.dimension("many", 3) });
  writer.put(v, { 1, 2, 3 });
  NetcdfFile file(writer.close());
  const NetcdfVariable& variable = *file.content().find("v");
  EXPECT_EQ((std::vector<double>{ 1, 2, 3 }), file.read(variable));
  file.prefetch(variable, { 1 }, { 2 });
  file.rest();
  std::vector<double> values;
  file.read(variable, { 1 }, { 2 }, values);
  EXPECT_EQ((std::vector<double>{ 2, 3 }), values);
  EXPECT_EQ(&variable, file.content().find("v"));
}

TEST_F(NetcdfFiles, LargerThanMemoryAreRefused)
{
  NetcdfWriter writer(this->Folder.path("a.nc"));
  const int many = writer.dimension("many", 1000000000000);
  writer.variable("v", NC_DOUBLE, { many });
  const std::string path = writer.close();
  NetcdfFile file(path);
  expectIOError(
    path, "'v' has 1000000000000 values", [&] { file.read(*file.content().find("v")); });
}

TEST_F(NetcdfFiles, IntegersMayHaveADecimalPoint)
{
  NetcdfWriter writer(this->Folder.path("a.nc"));
  const int rows = writer.dimension("rows", 2);
  const int whole = writer.variable("whole", NC_DOUBLE, { rows });
  const int broken = writer.variable("broken", NC_DOUBLE, { rows });
  writer.put(whole, { 7, NC_FILL_DOUBLE });
  writer.put(broken, { 1, 2.5 });
  const std::string path = writer.close();
  NetcdfFile file(path);
  EXPECT_EQ((std::vector<std::int64_t>{ 7, NetcdfFile::Missing }),
    file.readIntegers(*file.content().find("whole")));
  expectIOError(path, "the value 2.5", [&] { file.readIntegers(*file.content().find("broken")); });
}

TEST_F(NetcdfFiles, OfOtherKindsAreRefused)
{
  const std::string text = this->Folder.file("a.nc", "1 2 3\n");
  expectIOError(text, "is not a NetCDF file", [&] { const NetcdfFile file(text); });
  const std::string empty = this->Folder.file("b.nc", "");
  expectIOError(empty, "is not a NetCDF file", [&] { const NetcdfFile file(empty); });
  const std::string none = this->Folder.path("c.nc");
  expectIOError(none, "cannot be opened", [&] { const NetcdfFile file(none); });
}

} // namespace
