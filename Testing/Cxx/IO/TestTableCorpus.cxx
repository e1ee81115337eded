// SPDX-License-Identifier: BSD-3-Clause
// Tables as instruments, GIS, spreadsheets and programs write them: each with the points that must
// be read from it, or the sentence that refuses it.
#include "ExpectIOError.h"
#include "Points/ReadPoints.h"
#include "TemporaryFolder.h"

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace
{

using namespace tipp;
using namespace tipp::test;

constexpr double missing = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();

/// x, y and z of the points that most tables hold.
const std::vector<double> pit{ 500000, 4000000, 10, 500010, 4000000, 11, 500000, 4000010, 12,
  500010, 4000010, 13 };
const std::vector<double> lake{ 12.5, 47.25, -3.5, 12.75, 47.25, -4.5, 12.5, 47.5, -5.25 };

struct Entry
{
  const char* Name;
  std::string Text;
  std::vector<double> XYZ; ///< z is NaN if it is missing
  PointOptions Options = {};
};

struct Refusal
{
  const char* Name;
  std::string Text;
  const char* Words;
  PointOptions Options = {};
};

PointOptions columns(const std::string& x, const std::string& y, const std::string& z = "")
{
  PointOptions options;
  options.X = x;
  options.Y = y;
  options.Z = z;
  return options;
}

PointOptions noData(double value)
{
  PointOptions options;
  options.NoData = value;
  return options;
}

/// The points of the pit with another z of the last point.
std::vector<double> pitWith(double z)
{
  std::vector<double> points = pit;
  points.back() = z;
  return points;
}

/// A table of the pit with a last line of another z.
std::string tableWith(const std::string& z)
{
  return "x,y,z\n500000,4000000,10\n500010,4000000,11\n500000,4000010,12\n500010,4000010," + z +
    "\n";
}

// clang-format off
const std::vector<Entry> tables = {
  // Spreadsheets, databases and plain CSV
  { "csv", "x,y,z\n500000,4000000,10\n500010,4000000,11\n500000,4000010,12\n500010,4000010,13\n", pit },
  { "csv with \\r\\n", "x,y,z\r\n500000,4000000,10\r\n500010,4000000,11\r\n500000,4000010,12\r\n500010,4000010,13\r\n", pit },
  { "csv with \\r", "x,y,z\r500000,4000000,10\r500010,4000000,11\r500000,4000010,12\r500010,4000010,13\r", pit },
  { "a row that begins with #N/A", "z,x,y\n10,500000,4000000\n#N/A,500010,4000000\n", { 500000, 4000000, 10, 500010, 4000000, missing } },
  { "csv with a byte order mark", "\xef\xbb\xbfX,Y,Z\n500000,4000000,10\n500010,4000000,11\n500000,4000010,12\n500010,4000010,13", pit },
  { "csv with a byte order mark and quotes", "\xef\xbb\xbf\"X\",\"Y\",\"Z\"\n500000,4000000,10\n500010,4000000,11\n500000,4000010,12\n500010,4000010,13", pit },
  { "all quoted", "\"id\",\"x\",\"y\",\"z\"\n\"1\",\"500000\",\"4000000\",\"10\"\n\"2\",\"500010\",\"4000000\",\"11\"\n\"3\",\"500000\",\"4000010\",\"12\"\n\"4\",\"500010\",\"4000010\",\"13\"\n", pit },
  { "semicolons", "X;Y;Z\n500000;4000000;10\n500010;4000000;11\n500000;4000010;12\n500010;4000010;13\n", pit },
  { "tabs", "X\tY\tZ\n500000\t4000000\t10\n500010\t4000000\t11\n500000\t4000010\t12\n500010\t4000010\t13\n", pit },
  { "tabs with commas in a text", "X\tY\tZ\tnote\n500000\t4000000\t10\ta, b, c, d\n500010\t4000000\t11\t\n500000\t4000010\t12\t\n500010\t4000010\t13\tx\n", pit },
  { "commas with semicolons in a text", "x,y,z,note\n500000,4000000,10,a;b\n500010,4000000,11,c;d;e\n500000,4000010,12,\n500010,4000010,13,\n", pit },
  { "trailing commas in the rows", "x,y,z\n500000,4000000,10,\n500010,4000000,11,\n500000,4000010,12,\n500010,4000010,13,\n", pit },
  { "several trailing commas in the rows", "x,y,z\n500000,4000000,10,,\n500010,4000000,11,,\n500000,4000010,12,,\n500010,4000010,13,,\n", pit },
  { "a trailing comma in the header", "x,y,z,\n500000,4000000,10\n500010,4000000,11\n500000,4000010,12\n500010,4000010,13\n", pit },
  { "trailing commas everywhere", "x,y,z,\n500000,4000000,10,\n500010,4000000,11,\n500000,4000010,12,\n500010,4000010,13,\n", pit },
  { "trailing semicolons after an id", "id;x;y;z\n7;500000;4000000;10;\n8;500010;4000000;11;\n9;500000;4000010;12;\n11;500010;4000010;13;\n", pit },
  { "a trailing tab", "id\tx\ty\tz\n7\t500000\t4000000\t10\t\n8\t500010\t4000000\t11\t\n9\t500000\t4000010\t12\t\n11\t500010\t4000010\t13\t\n", pit },
  { "commas in the last text", "id,x,y,z,remark\n7,500000,4000000,10,pipe, north\n8,500010,4000000,11,pipe\n9,500000,4000010,12,a, b, c\n11,500010,4000010,13,\n", pit },
  { "commas in the last text of the first row only", "id,x,y,z,remark\n7,500000,4000000,10,pipe, north, low\n8,500010,4000000,11,pipe\n9,500000,4000010,12,\n11,500010,4000010,13,\n", pit },
  { "the last text left out", "id,x,y,z,remark\n7,500000,4000000,10\n8,500010,4000000,11\n9,500000,4000010,12\n11,500010,4000010,13\n", pit },
  { "quotes in quotes", "id,remark,x,y,z\n7,\"5\"\" pipe, north\",500000,4000000,10\n8,\"\",500010,4000000,11\n9,\"\"\"a\"\"\",500000,4000010,12\n11,b,500010,4000010,13\n", pit },
  { "quotes in quotes at the end", "id,x,y,z,remark\n7,500000,4000000,10,\"5\"\" pipe, north\"\n8,500010,4000000,11,\"a,\"\"b\"\",c\"\n9,500000,4000010,12,\n11,500010,4000010,13,x\n", pit },
  { "blanks after commas", "x, y, z\n500000, 4000000, 10\n500010, 4000000, 11\n500000, 4000010, 12\n500010, 4000010, 13\n", pit },
  { "names with blanks", "Point No,X Coord,Y Coord,Z Coord\n7,500000,4000000,10\n8,500010,4000000,11\n9,500000,4000010,12\n11,500010,4000010,13\n", pit },
  { "units in the names", "ID,Easting (m),Northing (m),Elevation [m]\n7,500000,4000000,10\n8,500010,4000000,11\n9,500000,4000010,12\n11,500010,4000010,13\n", pit },
  { "units after the names", "id,x_m,y_m,z_m\n7,500000,4000000,10\n8,500010,4000000,11\n9,500000,4000010,12\n11,500010,4000010,13\n", pit },
  { "a row of units", "id,x,y,z\n-,m,m,m\n7,500000,4000000,10\n8,500010,4000000,11\n9,500000,4000010,12\n11,500010,4000010,13\n", pit },
  { "a row of units in brackets", "x;y;z\n[m];[m];[m]\n500000;4000000;10\n500010;4000000;11\n500000;4000010;12\n500010;4000010;13\n", pit },
  { "a title above the names", "Survey of the pit\nx,y,z\n500000,4000000,10\n500010,4000000,11\n500000,4000010,12\n500010,4000010,13\n", pit },
  { "titles above the names", "Job: pit 7\nDate: 2020-05-01\n\nid,x,y,z\n7,500000,4000000,10\n8,500010,4000000,11\n9,500000,4000010,12\n11,500010,4000010,13\n", pit },
  { "comments in the middle", "x,y,z\n500000,4000000,10\n# north\n500010,4000000,11\n// south\n500000,4000010,12\n% east\n! west\n500010,4000010,13\n", pit },
  { "names in upper case and other order", "Z,Y,X\n10,4000000,500000\n11,4000000,500010\n12,4000010,500000\n13,4000010,500010\n", pit },
  { "an id that is last", "x,y,z,id\n500000,4000000,10,7\n500010,4000000,11,8\n500000,4000010,12,9\n500010,4000010,13,11\n", pit },
  { "other separators in the header", "id,x,y,z\n7 500000 4000000 10\n8 500010 4000000 11\n9 500000 4000010 12\n11 500010 4000010 13\n", pit },
  { "blanks in the header", "id x y z\n7,500000,4000000,10\n8,500010,4000000,11\n9,500000,4000010,12\n11,500010,4000010,13\n", pit },
  { "semicolons in the header", "id;x;y;z\n7\t500000\t4000000\t10\n8\t500010\t4000000\t11\n9\t500000\t4000010\t12\n11\t500010\t4000010\t13\n", pit },
  { "a comment after the names", "id x y z # made by instrument\n7 500000 4000000 10\n8 500010 4000000 11\n9 500000 4000010 12\n11 500010 4000010 13\n", pit },
  { "a comment between tabs after a first row of few numbers", "y coord\tcode\tz\tx coord\n4000000\t\"\"\t****\t500000 # checked\n4000000\ttree 5\t\t500010\n4000010\t\t12\t500000\n", { 500000, 4000000, missing, 500010, 4000000, missing, 500000, 4000010, 12 } },
  { "a comment after a tab", "x\ty\tz\n500000\t4000000\t10\t# first\n500010\t4000000\t11\n500000\t4000010\t12\n500010\t4000010\t13 # last\n", pit },
  { "a title that begins with a number", "2.5 cm survey\nx,y,z\n500000,4000000,10\n500010,4000000,11\n500000,4000010,12\n500010,4000010,13\n", pit },
  { "a comment after a row", "id x y z\n7 500000 4000000 10 # first\n8 500010 4000000 11\n9 500000 4000010 12\n11 500010 4000010 13 # last\n", pit },
  { "gaps between names with blanks", "Point No   X Coord   Y Coord   Z Coord\n7   500000   4000000   10\n8   500010   4000000   11\n9   500000   4000010   12\n11   500010   4000010   13\n", pit },
  { "units in brackets between blanks", "E (m) N (m) H (m)\n500000 4000000 10\n500010 4000000 11\n500000 4000010 12\n500010 4000010 13\n", pit },
  { "leading blanks", "   x        y        z\n   500000  4000000   10\n   500010  4000000   11\n   500000  4000010   12\n   500010  4000010   13\n", pit },
  { "names with accents in Latin-1", "x,y,z,b\xe9ton\n500000,4000000,10,1\n500010,4000000,11,2\n500000,4000010,12,3\n500010,4000010,13,4\n", pit },

  // Commented headers
  { "numpy.savetxt", "# id x y z\n7 500000 4000000 10\n8 500010 4000000 11\n9 500000 4000010 12\n11 500010 4000010 13\n", pit },
  { "numpy.savetxt with commas", "# id,x,y,z\n7,500000,4000000,10\n8,500010,4000000,11\n9,500000,4000010,12\n11,500010,4000010,13\n", pit },
  { "numpy.savetxt with exponents", "# y x z\n4.000000000000000000e+06 5.000000000000000000e+05 1.000000000000000000e+01\n4.000000000000000000e+06 5.000100000000000000e+05 1.100000000000000000e+01\n4.000010000000000000e+06 5.000000000000000000e+05 1.200000000000000000e+01\n4.000010000000000000e+06 5.000100000000000000e+05 1.300000000000000000e+01\n", pit },
  { "#X,Y,Z without a blank", "#Y,X,Z\n4000000,500000,10\n4000000,500010,11\n4000010,500000,12\n4000010,500010,13\n", pit },
  { "// before the names", "// id x y z\n7 500000 4000000 10\n8 500010 4000000 11\n9 500000 4000010 12\n11 500010 4000010 13\n", pit },
  { "; before the names", "; id x y z\n7 500000 4000000 10\n8 500010 4000000 11\n9 500000 4000010 12\n11 500010 4000010 13\n", pit },
  { "% before the names", "% id x y z\n7 500000 4000000 10\n8 500010 4000000 11\n9 500000 4000010 12\n11 500010 4000010 13\n", pit },
  { "! before the names", "! id x y z\n7 500000 4000000 10\n8 500010 4000000 11\n9 500000 4000010 12\n11 500010 4000010 13\n", pit },
  { "comments around the names", "# made by a program\n# columns: id x y z\n# on a Monday\n7 500000 4000000 10\n8 500010 4000000 11\n9 500000 4000010 12\n11 500010 4000010 13\n", pit },
  { "a comment that names more", "# x y z of the pit\n500000 4000000 10\n500010 4000000 11\n500000 4000010 12\n500010 4000010 13\n", pit },
  { "a comment that is prose", "# Surveyed by the office in May\n500000 4000000 10\n500010 4000000 11\n500000 4000010 12\n500010 4000010 13\n", pit },
  { "CloudCompare", "//X Y Z R G B\n500000 4000000 10 1 2 3\n500010 4000000 11 1 2 3\n500000 4000010 12 1 2 3\n500010 4000010 13 1 2 3\n", pit },
  { "CloudCompare with the count", "//X;Y;Z;R;G;B\n4\n500000;4000000;10;1;2;3\n500010;4000000;11;1;2;3\n500000;4000010;12;1;2;3\n500010;4000010;13;1;2;3\n", pit },
  { "CloudCompare in another order", "//Y,X,Z\n4\n4000000,500000,10\n4000000,500010,11\n4000010,500000,12\n4000010,500010,13\n", pit },
  { "a .pts file", "4\n500000 4000000 10 -1 7 8 9\n500010 4000000 11 -1 7 8 9\n500000 4000010 12 -1 7 8 9\n500010 4000010 13 -1 7 8 9\n", pit },

  // Instruments
  { "point, northing, easting, elevation, description", "Point,Northing,Easting,Elevation,Description\n101,4000000,500000,10,EP\n102,4000000,500010,11,EP\n103,4000010,500000,12,TOP\n104,4000010,500010,13,TOP\n", pit },
  { "P,N,E,Z,D", "P,N,E,Z,D\n101,4000000,500000,10,EP\n102,4000000,500010,11,EP\n103,4000010,500000,12,TOP\n104,4000010,500010,13,TOP\n", pit },
  { "Pt,E,N,H,Code", "Pt,E,N,H,Code\nA1,500000,4000000,10,EP\nA2,500010,4000000,11,EP\nA3,500000,4000010,12,TOP\nA4,500010,4000010,13,TOP\n", pit },
  { "point numbers with letters", "Point Name,Northing,Easting,Height\n1,4000000,500000,10\n2A,4000000,500010,11\nP3,4000010,500000,12\n4,4000010,500010,13\n", pit },
  { "Trimble", "Point Id,Northing (m),Easting (m),Elevation (m),Feature Code\n1,4000000.000,500000.000,10.000,GND\n2,4000000.000,500010.000,11.000,GND\n3,4000010.000,500000.000,12.000,GND\n4,4000010.000,500010.000,13.000,\n", pit },
  { "Leica", "Point ID\tEasting\tNorthing\tOrtho. Height\tCode\nGS01\t500000.0000\t4000000.0000\t10.0000\t\nGS02\t500010.0000\t4000000.0000\t11.0000\tWL\nGS03\t500000.0000\t4000010.0000\t12.0000\t\nGS04\t500010.0000\t4000010.0000\t13.0000\t\n", pit },
  { "Topcon", "Name,Northing(m),Easting(m),Elev(m),Code\n1,4000000,500000,10,\n2,4000000,500010,11,\n3,4000010,500000,12,\n4,4000010,500010,13,\n", pit },
  { "German", "Punktnr;Rechtswert;Hochwert;H\xc3\xb6he;Bemerkung\n1;500000,000;4000000,000;10,000;\n2;500010,000;4000000,000;11,000;Mast\n3;500000,000;4000010,000;12,000;\n4;500010,000;4000010,000;13,000;\n", pit },
  { "German in Latin-1", "Nr;Rechtswert;Hochwert;Hoehe;Stra\xdf" "e\n1;500000,5;4000000,5;10,5;1\n2;500010,5;4000000,5;11,5;2\n", { 500000.5, 4000000.5, 10.5, 500010.5, 4000000.5, 11.5 } },
  { "Spanish", "Punto;Este;Norte;Cota\n1;500000;4000000;10\n2;500010;4000000;11\n3;500000;4000010;12\n4;500010;4000010;13\n", pit },
  { "Italian", "N,Est,Nord,Quota\n1,500000,4000000,10\n2,500010,4000000,11\n3,500000,4000010,12\n4,500010,4000010,13\n", pit },
  { "Dutch RD", "id,RD_X,RD_Y,Z\n1,500000,4000000,10\n2,500010,4000000,11\n3,500000,4000010,12\n4,500010,4000010,13\n", pit },
  { "numbers chosen in a headerless PENZD", "101,500000,4000000,10,EP\n102,500010,4000000,11,EP\n103,500000,4000010,12,TOP\n104,500010,4000010,13,TOP\n", pit, columns("1", "2", "3") },
  { "numbers chosen in a headerless PNEZD", "101,4000000,500000,10,EP\n102,4000000,500010,11,EP\n103,4000010,500000,12,TOP\n104,4000010,500010,13,TOP\n", pit, columns("2", "1", "3") },
  { "x, y and code without names", "500000,4000000,10,EP\n500010,4000000,11,EP\n500000,4000010,12,TOP\n500010,4000010,13,TOP\n", pit },

  // GIS
  { "ArcGIS", "OBJECTID,POINT_X,POINT_Y,GRID_CODE\n101,500000,4000000,10\n102,500010,4000000,11\n103,500000,4000010,12\n104,500010,4000010,13\n", pit },
  { "ArcGIS with thirty digits", "FID,Shape *,POINT_X,POINT_Y,POINT_Z\n0,Point ZM,500000.000000000000,4000000.000000000000,10.000000000000\n1,Point ZM,500010.000000000000,4000000.000000000000,11.000000000000\n2,Point ZM,500000.000000000000,4000010.000000000000,12.000000000000\n3,Point ZM,500010.000000000000,4000010.000000000000,13.000000000000\n", pit },
  { "ogr2ogr AS_XYZ", "X,Y,Z,fid,name\n500000,4000000,10,1,\"a\"\n500010,4000000,11,2,\"b\"\n500000,4000010,12,3,\n500010,4000010,13,4,\"d, e\"\n", pit },
  { "QGIS", "fid,id,X,Y,elev\n1,7,500000,4000000,10\n2,8,500010,4000000,11\n3,9,500000,4000010,12\n4,11,500010,4000010,13\n", pit },
  { "GBIF", "gbifID,decimalLatitude,decimalLongitude,elevation\n7,47.25,12.5,-3.5\n8,47.25,12.75,-4.5\n9,47.5,12.5,-5.25\n", lake },
  { "GPS", "name,lat,lon,alt\na,47.25,12.5,-3.5\nb,47.25,12.75,-4.5\nc,47.5,12.5,-5.25\n", lake },
  { "latitude before longitude", "Latitude,Longitude,Depth\n47.25,12.5,-3.5\n47.25,12.75,-4.5\n47.5,12.5,-5.25\n", lake },
  { "degrees in the names", "Lat (deg);Lon (deg);Height (m)\n47.25;12.5;-3.5\n47.25;12.75;-4.5\n47.5;12.5;-5.25\n", lake },
  { "decimal degrees", "lat_dd\tlon_dd\televation_m\n47.25\t12.5\t-3.5\n47.25\t12.75\t-4.5\n47.5\t12.5\t-5.25\n", lake },
  { "bathymetry", "12.5 47.25 -3.5\n12.75 47.25 -4.5\n12.5 47.5 -5.25\n", lake },
  { "GMT", "# lon lat depth\n> segment 1\n12.5\t47.25\t-3.5\n12.75\t47.25\t-4.5\n> segment 2\n12.5\t47.5\t-5.25\n", lake },
  { "GMT with NaN", "12.5\t47.25\t-3.5\n12.75\t47.25\t-4.5\n12.5\t47.5\tNaN\n", { 12.5, 47.25, -3.5, 12.75, 47.25, -4.5, 12.5, 47.5, missing } },
  { "Surfer", "\"X\" \"Y\" \"Z\"\n12.5 47.25 -3.5\n12.75 47.25 -4.5\n12.5 47.5 -5.25\n", lake },
  { "a grid of integers", "449000 5700000 23.5\n449001 5700000 23.25\n449002 5700000 24\n449000 5700001 22\n", { 449000, 5700000, 23.5, 449001, 5700000, 23.25, 449002, 5700000, 24, 449000, 5700001, 22 } },
  { "ParaView", "\"Points:0\",\"Points:1\",\"Points:2\",\"q\"\n500000,4000000,10,1\n500010,4000000,11,2\n500000,4000010,12,3\n500010,4000010,13,4\n", pit },

  // Programs
  { "pandas with an index", ",x,y,z\n0,500000.0,4000000.0,10.0\n1,500010.0,4000000.0,11.0\n2,500000.0,4000010.0,12.0\n3,500010.0,4000010.0,13.0\n", pit },
  { "pandas read and written again", "Unnamed: 0,x,y,z\n0,500000.0,4000000.0,10.0\n1,500010.0,4000000.0,11.0\n2,500000.0,4000010.0,12.0\n3,500010.0,4000010.0,13.0\n", pit },
  { "pandas with semicolons", ";x;y;z\n0;500000,0;4000000,0;10,0\n1;500010,0;4000000,0;11,0\n2;500000,0;4000010,0;12,0\n3;500010,0;4000010,0;13,0\n", pit },
  { "R's write.csv", "\"\",\"x\",\"y\",\"z\"\n\"1\",500000,4000000,10\n\"2\",500010,4000000,11\n\"3\",500000,4000010,12\n\"4\",500010,4000010,13\n", pit },
  { "R's write.table", "\"x\" \"y\" \"z\"\n\"1\" 500000 4000000 10\n\"2\" 500010 4000000 11\n\"3\" 500000 4000010 12\n\"4\" 500010 4000010 13\n", pit },
  { "R's write.table with names of rows", "\"x\" \"y\" \"z\"\n\"a b\" 500000 4000000 10\n\"c\" 500010 4000000 11\n\"d\" 500000 4000010 12\n\"e\" 500010 4000010 NA\n", pitWith(missing) },
  { "Fortran", "  0.5000000000D+06  0.4000000000D+07  0.1000D+02\n  0.5000100000D+06  0.4000000000D+07  0.1100D+02\n  0.5000000000D+06  0.4000010000D+07  0.1200D+02\n  0.5000100000D+06  0.4000010000D+07  0.1300D+02\n", pit },
  { "gnuplot", "# x y z\n\n500000 4000000 10\n500010 4000000 11\n\n500000 4000010 12\n500010 4000010 13\n", pit },

  // Missing and unusual values
  { "NULL", tableWith("NULL"), pitWith(missing) },
  { "None", tableWith("None"), pitWith(missing) },
  { "n/a", tableWith("n/a"), pitWith(missing) },
  { "#N/A", tableWith("#N/A"), pitWith(missing) },
  { "a star", tableWith("*"), pitWith(missing) },
  { "Fortran's stars", tableWith("******"), pitWith(missing) },
  { "\\N", tableWith("\\N"), pitWith(missing) },
  { "1.#QNAN", tableWith("1.#QNAN"), pitWith(missing) },
  { "-1.#IND", tableWith("-1.#IND"), pitWith(missing) },
  { "nan(ind)", tableWith("-nan(ind)"), pitWith(missing) },
  { "an empty field", tableWith(""), pitWith(missing) },
  { "a quoted empty field", tableWith("\"\""), pitWith(missing) },
  { "12.3m", tableWith("12.3m"), pitWith(missing) },
  { "1.5D+01", tableWith("1.5D+01"), pitWith(15) },
  { "1.5d1", tableWith("1.5d1"), pitWith(15) },
  { "+1.5E+01", tableWith("+1.5E+01"), pitWith(15) },
  { "inf", tableWith("inf"), pitWith(infinite) },
  { "-Infinity", tableWith("-Infinity"), pitWith(-infinite) },
  { "1.#INF", tableWith("1.#INF"), pitWith(infinite) },
  { "-1.#INF00", tableWith("-1.#INF00"), pitWith(-infinite) },
  { "-9999 without a word", tableWith("-9999"), pitWith(-9999) },
  { "-9999 that is said to be missing", tableWith("-9999"), pitWith(missing), noData(-9999) },
  { "a missing x", "x,y,z\nNULL,4000000,10\n500010,4000000,11\n", { missing, 4000000, 10, 500010, 4000000, 11 } },

  // Decimal commas
  { "decimal commas", "x;y;z\n12,5;47,25;-3,5\n12,75;47,25;-4,5\n12,5;47,5;-5,25\n", lake },
  { "decimal commas between tabs", "x\ty\tz\n12,5\t47,25\t-3,5\n12,75\t47,25\t-4,5\n12,5\t47,5\t-5,25\n", lake },
  { "decimal commas between blanks", "x y z\n12,5 47,25 -3,5\n12,75 47,25 -4,5\n12,5 47,5 -5,25\n", lake },
  { "three decimals that are clear elsewhere", "x;y\n3512345,123;5412345,456\n3512346,123;123,456\n", { 3512345.123, 5412345.456, missing, 3512346.123, 123.456, missing } },
};

const std::vector<Refusal> refusals = {
  { "headerless PENZD", "101,500000,4000000,10,EP\n102,500010,4000000,11,EP\n103,500000,4000010,12,TOP\n104,500010,4000010,13,TOP\n", "first column looks like numbers of points" },
  { "headerless PNEZD with decimals", "101 4000000.12 500000.34 10.1 EP\n99 4000000.12 500010.34 11.1 EP\n103 4000010.12 500000.34 12.1 TOP\n", "--x 1 --y 2 --z 3" },
  { "headerless names of points", "A1,500000,4000000,10\nA2,500010,4000000,11\n", "--x 2 --y 1 --z 3" },
  { "headerless id, x, y", "1 5.5 6.5\n2 7.5 8.5\n3 9.5 3.5\n", "first column looks like numbers of points" },
  { "names that do not tell", "station,speed,heading\n1,2,3\n4,5,6\n", "has the columns station, speed, heading" },
  { "names that tell x alone", "id,x,b,c\n1,2,3,4\n4,5,6,7\n", "choose the columns with --x, --y and --z" },
  { "an id and one coordinate", "id,value\n1,2\n4,5\n", "has the columns id, value" },
  { "two columns called x", "x,y,z,x\n1,2,3,4\n4,5,6,7\n", "two columns that may be x" },
  { "more names than fields", "id,x,y,z\n0,0,1\n10,0,2\n", "has 3 fields, but line 1 names 4 columns (id, x, y, z)" },
  { "fewer names than fields", "x,y,z\n7,0,0,1\n8,10,0,2\n", "has 4 fields, but line 1 names 3 columns (x, y, z)" },
  { "a short row", "x,y,z\n0,0,1\n10,0\n", "line 3: has 2 columns where line 1 names 3" },
  { "a long row", "x,y,z\n0,0,1\n10,0,2,5\n", "line 3: has 4 columns where line 1 names 3" },
  { "commas in a text in the middle", "id,remark,x,y,z\n7,pipe, north,0,0,1\n8,pipe,10,0,2\n", "line 2: has 6 fields" },
  { "commas in a text in the middle of a later row", "id,remark,x,y,z\n8,pipe,10,0,2\n7,pipe, north,0,0,1\n", "line 3: has 6 columns" },
  { "a first row without y", "500236.3 nan pipe\n500744.4 4000160.7 * W-1\n500910.1 4000404.5 37.2 B2\n", "is a title, or a point that lacks a coordinate" },
  { "a first row without y and decimals", "500236 nan pipe\n500744 4000160 * W-1\n", "is a title, or a point that lacks a coordinate" },
  { "a field too many before an empty one and a comment", "Y (m)\tX (m)\tDepth\tR\tremark\n9\t4000199,35\t500938,6\t\t30,0\t # checked\n4000670,0\t500821,2\t-44,3\t22,7\tTOP\n", "has 5 columns where the first row has 6" },
  { "a commented header of another width", "# id x y z\n0 0 1\n10 0 2\n", "has 3 fields, but line 1 names 4 columns" },
  { "a trailing comma that the first row lacks", "id,x,y,z,remark\n7,0,0,1,\n8,500667,35,5,6,\n", "line 3: has 6 columns where line 1 names 5" },
  { "a text that only the first row leaves out", "id,x,y,z,remark\n7,0,0,1\n8,10,0,2,pipe\n", "line 3: has 5 columns where the first row has 4" },
  { "a text that the first row does not leave out", "id,x,y,z,remark\n7,0,0,1,pipe\n8,10,0,2\n", "line 3: has 4 columns where line 1 names 5" },
  { "a break in quotes", "id,x,y,z,remark\n7,0,0,1,\"pipe\nnorth\"\n8,10,0,2,\n", "line 2: has a quote that does not end" },
  { "degrees and minutes", "x,y,z\n0,0,1\n12\xc2\xb0""30',5,5\n", "line 3: '12\xc2\xb0""30'' is not a number" },
  { "degrees with letters", "lat,lon\n47.5N,12.5E\n", "is not a number" },
  { "many texts in z", "x,y,z\n0,0,a1\n1,0,a2\n2,0,a3\n3,1,a4\n4,1,5\n", "has text that is not a number in column 'z', first 'a1' in line 2" },
  { "thousands in x", "x;y;z\n1,234,567;5;6\n", "'1,234,567' is not a number" },
  { "thousands with blanks", "x;y;z\n500 000;4 000 000;6\n", "has 4 fields" },
  { "thousands with apostrophes", "x;y;z\n500'000;4'000'000;6\n", "is not a number" },
  { "thousands with points", "x;y;z\n500.000,5;4,5;6\n", "is not a number" },
  { "commas that may be thousands", "x;y;z\n12,345;10,500;1,234\n12,345;11,500;1,234\n", "may be a decimal comma or separate thousands" },
  { "points that may be thousands", "x;y;z\n999,5;10,5;1,25\n1.000;10,5;1,25\n", "decimal point or thousands" },
  { "decimal commas between commas", "x,y,z\n12,5,47,25,3,5\n", "has 6 fields, but line 1 names 3 columns" },
  { "decimal commas between commas with blanks", "12,5, 47,25, 3,5\n", "some may be decimal commas" },
  { "pandas without names", ",0,1,2\n0,500000.5,4000000.5,10.5\n1,500010.5,4000000.5,11.5\n", "numbers of columns, as pandas writes them" },
  { "numbers of columns", "0,1,2\n500000.5,4000000.5,10.5\n500010.5,4000000.5,11.5\n", "numbers of columns, as pandas writes them" },
  { "UTF-16", std::string("\xff\xfex\0,\0y\0\n\0", 10), "is UTF-16 text" },
  { "a count that is wrong", "//X;Y;Z\n5\n0;0;1\n10;0;2\n", "announces 5 points in its first line and holds 2" },
  { "a column that is not there", "x,y,z\n0,0,1\n", "has no column 'q'", columns("x", "y", "q") },
  { "the same column twice", "x,y,z\n0,0,1\n", "cannot give the same column as z", columns("x", "y", "x") },
};
// clang-format on

void expectPoints(const std::vector<double>& expected, const PointTable& points)
{
  ASSERT_EQ(expected.size() / 3, points.size());
  const std::vector<std::string> names = points.names();
  const std::size_t z = findElevation(names);
  const auto same = [](double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); };
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const double height = z < names.size() ? points.Columns[z].Values[i] : missing;
    EXPECT_TRUE(same(expected[3 * i], points.XY[2 * i])) << points.XY[2 * i];
    EXPECT_TRUE(same(expected[3 * i + 1], points.XY[2 * i + 1])) << points.XY[2 * i + 1];
    EXPECT_TRUE(same(expected[3 * i + 2], height)) << height;
  }
}

} // namespace

TEST(TableCorpus, TablesGiveTheirPoints)
{
  const TemporaryFolder folder;
  for (const Entry& entry : tables)
  {
    SCOPED_TRACE(entry.Name);
    try
    {
      expectPoints(entry.XYZ, readPoints(folder.file("points.csv", entry.Text), entry.Options));
    }
    catch (const std::exception& error)
    {
      ADD_FAILURE() << error.what();
    }
  }
}

TEST(TableCorpus, StreamsGiveTheSamePoints)
{
  const TemporaryFolder folder;
  for (const Entry& entry : tables)
  {
    SCOPED_TRACE(entry.Name);
    try
    {
      const std::string path = folder.file("points.csv", entry.Text);
      const PointTable whole = readPoints(path, entry.Options);
      const auto stream = openPointStream({ path }, entry.Options);
      EXPECT_EQ(whole.names(), stream->columns());
      PointTable points;
      for (const std::string& name : stream->columns())
      {
        points.Columns.push_back({ name, {} });
      }
      stream->rewind();
      for (PointBlock block; stream->next(block, 3);)
      {
        append(block, points);
      }
      expectPoints(entry.XYZ, points);
      ASSERT_EQ(1U, stream->reports().size());
      EXPECT_EQ(whole.Reports[0].Columns, stream->reports()[0].Columns);
      EXPECT_EQ(whole.Reports[0].Warnings, stream->reports()[0].Warnings);
    }
    catch (const std::exception& error)
    {
      ADD_FAILURE() << error.what();
    }
  }
}

TEST(TableCorpus, OtherTablesAreRefused)
{
  const TemporaryFolder folder;
  for (const Refusal& refusal : refusals)
  {
    SCOPED_TRACE(refusal.Name);
    const std::string path = folder.file("points.csv", refusal.Text);
    expectIOError(path, refusal.Words, [&] { readPoints(path, refusal.Options); });
    expectIOError(path, refusal.Words, [&] { openPointStream({ path }, refusal.Options); });
  }
}
