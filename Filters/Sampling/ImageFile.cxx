// SPDX-License-Identifier: BSD-3-Clause
#include "Sampling/ImageFile.h"

#include "Arrays/Decimal.h"
#include "Files/RawArray.h"
#include "Files/WriteVtkXml.h"
#include "Sampling/HiddenSamples.h"

#include <cstdint>

namespace tipp
{
namespace
{

XmlSection sectionOf(
  const std::string& name, const std::vector<ImageArray>& arrays, std::uint64_t tuples)
{
  XmlSection section{ name, {}, "" };
  for (const ImageArray& array : arrays)
  {
    const std::uint64_t bytes =
      tuples * std::uint64_t(array.Components) * std::uint64_t(scalarSize(array.Type));
    const auto* const values = static_cast<const char*>(array.Values);
    section.Arrays.push_back({ array.Name, array.Type, array.Components, bytes,
      [values, bytes](std::ostream& to) { to.write(values, std::streamsize(bytes)); },
      array.ComponentNames });
  }
  return section;
}

} // namespace

void writeVti(
  const std::string& path, const std::optional<PathState>& before, const ImageArrays& image)
{
  const Lattice& grid = image.Grid;
  writeXmlPiece(path, before,
    { "ImageData", {},
      { sectionOf("PointData", image.OfPoints, std::uint64_t(grid.samples())),
        sectionOf("CellData", image.OfCells, std::uint64_t(cellsBetween(grid))) },
      XmlGrid{ grid.Extent, grid.Min, grid.Delta } });
}

RasterGrid pixelsOf(const Lattice& lattice)
{
  RasterGrid grid;
  grid.Columns = lattice.size(0);
  grid.Rows = lattice.size(1);
  grid.Pixel = { lattice.Delta[0], lattice.Delta[1] };
  grid.West = gridPosition(lattice.Min[0], lattice.Delta[0], -1);
  grid.South = gridPosition(lattice.Min[1], lattice.Delta[1], -1);
  return grid;
}

} // namespace tipp
