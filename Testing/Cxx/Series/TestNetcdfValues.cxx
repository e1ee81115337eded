// SPDX-License-Identifier: BSD-3-Clause
#include "ExpectIOError.h"
#include "Netcdf/NetcdfFile.h"
#include "NetcdfWriter.h"
#include "TemporaryFolder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace
{

using namespace tipp;
using namespace tipp::test;

class NetcdfValues : public testing::Test
{
protected:
  using Define = std::function<void(NetcdfWriter& writer, int variable)>;

  /// Returns the values as read, and -1000 where there is none.
  std::vector<double> read(nc_type type, const std::vector<double>& stored, const Define& define,
    int format = NC_NETCDF4) const
  {
    NetcdfWriter writer(this->Folder.path("a.nc"), format);
    const int rows = writer.dimension("rows", stored.size());
    const int variable = writer.variable("v", type, { rows });
    define(writer, variable);
    writer.put(variable, stored);
    NetcdfFile file(writer.close());
    std::vector<double> values = file.read(*file.content().find("v"));
    for (double& value : values)
    {
      value = std::isnan(value) ? -1000 : value;
    }
    return values;
  }

  static void nothing(NetcdfWriter&, int) {}

  TemporaryFolder Folder;
};

TEST_F(NetcdfValues, AreNoneAtTheFillValue)
{
  EXPECT_EQ((std::vector<double>{ 1, -1000 }),
    this->read(NC_FLOAT, { 1, -99999 },
      [](NetcdfWriter& w, int v) { w.number(v, "_FillValue", NC_FLOAT, { -99999 }); }));
}

TEST_F(NetcdfValues, AreNoneAtTheLibrarysFillValue)
{
  EXPECT_EQ((std::vector<double>{ 1, -1000 }), this->read(NC_INT, { 1, NC_FILL_INT }, nothing));
  EXPECT_EQ(
    (std::vector<double>{ 1, -1000 }), this->read(NC_DOUBLE, { 1, NC_FILL_DOUBLE }, nothing));
  EXPECT_EQ((std::vector<double>{ 1, -127 }), this->read(NC_BYTE, { 1, -127 }, nothing));
}

TEST_F(NetcdfValues, AreNoneAtEachMissingValue)
{
  EXPECT_EQ((std::vector<double>{ 1, -1000, -1000, -1000 }),
    this->read(NC_SHORT, { 1, 7, 8, 9 },
      [](NetcdfWriter& w, int v)
      {
        w.number(v, "_FillValue", NC_SHORT, { 9 });
        w.number(v, "missing_value", NC_SHORT, { 7, 8 });
      }));
}

TEST_F(NetcdfValues, AreNoneOutsideOfTheValidRange)
{
  EXPECT_EQ((std::vector<double>{ -1000, 0, 10, -1000 }),
    this->read(NC_SHORT, { -1, 0, 10, 11 },
      [](NetcdfWriter& w, int v) {
        w.number(v, "valid_range", NC_SHORT, { 0, 10 });
      }));
  EXPECT_EQ((std::vector<double>{ -1000, 0, 10, -1000 }),
    this->read(NC_SHORT, { -1, 0, 10, 11 },
      [](NetcdfWriter& w, int v)
      {
        w.number(v, "valid_min", NC_SHORT, { 0 });
        w.number(v, "valid_max", NC_SHORT, { 10 });
      }));
}

TEST_F(NetcdfValues, AreUnpackedAfterTheFillValueIsFound)
{
  EXPECT_EQ((std::vector<double>{ 102, 99, -1000 }),
    this->read(NC_SHORT, { 4, -2, 0 },
      [](NetcdfWriter& w, int v)
      {
        w.number(v, "_FillValue", NC_SHORT, { 0 });
        w.number(v, "scale_factor", NC_DOUBLE, { 0.5 });
        w.number(v, "add_offset", NC_DOUBLE, { 100 });
      }));
}

TEST_F(NetcdfValues, MayBePackedByNumbersWrittenAsText)
{
  EXPECT_EQ((std::vector<double>{ 2, -1 }),
    this->read(
      NC_SHORT, { 4, -2 }, [](NetcdfWriter& w, int v) { w.text(v, "scale_factor", "0.5"); }));
  expectIOError(this->Folder.path("a.nc"),
    "gives 'v' the scale_factor 'half', which is no finite number",
    [this]
    {
      this->read(
        NC_SHORT, { 4 }, [](NetcdfWriter& w, int v) { w.text(v, "scale_factor", "half"); });
    });
}

TEST_F(NetcdfValues, WithSeveralScalesAreRefused)
{
  expectIOError(this->Folder.path("a.nc"), "gives 'v' 2 values of scale_factor",
    [this]
    {
      this->read(NC_SHORT, { 4 },
        [](NetcdfWriter& w, int v) {
          w.number(v, "scale_factor", NC_DOUBLE, { 1, 2 });
        });
    });
}

TEST_F(NetcdfValues, AreNoneAtAMissingValueWrittenAsText)
{
  EXPECT_EQ((std::vector<double>{ 1, -1000 }),
    this->read(
      NC_FLOAT, { 1, -99 }, [](NetcdfWriter& w, int v) { w.text(v, "missing_value", "-99"); }));
}

TEST_F(NetcdfValues, OfClassicFilesMayBeUnsigned)
{
  EXPECT_EQ((std::vector<double>{ 200, 1, -1000 }),
    this->read(
      NC_BYTE, { -56, 1, -1 },
      [](NetcdfWriter& w, int v)
      {
        w.text(v, "_Unsigned", "true");
        w.number(v, "_FillValue", NC_BYTE, { -1 });
      },
      0));
}

TEST_F(NetcdfValues, OfEachTypeAreRead)
{
  for (const nc_type type : { NC_BYTE, NC_UBYTE, NC_SHORT, NC_USHORT, NC_INT, NC_UINT, NC_INT64,
         NC_UINT64, NC_FLOAT, NC_DOUBLE })
  {
    EXPECT_EQ((std::vector<double>{ 1, 100 }), this->read(type, { 1, 100 }, nothing)) << type;
  }
}

} // namespace
