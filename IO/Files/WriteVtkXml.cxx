// SPDX-License-Identifier: BSD-3-Clause
#include "Files/WriteVtkXml.h"

#include "Files/RawArray.h"
#include "Files/TextFile.h"
#include "Files/VtkXml.h"

namespace tipp
{
namespace
{

/// Returns the numbers with blanks between them, each so that reading it gives the same number.
template <std::size_t N, typename T>
std::string inOrder(const std::array<T, N>& numbers)
{
  std::string text;
  for (const T number : numbers)
  {
    text += (text.empty() ? "" : " ") + exactText(double(number));
  }
  return text;
}

std::string componentNames(const XmlArray& array)
{
  std::string text;
  for (std::size_t i = 0; i < array.ComponentNames.size(); ++i)
  {
    text +=
      " ComponentName" + std::to_string(i) + "=\"" + escapedXml(array.ComponentNames[i]) + "\"";
  }
  return text;
}

/// Returns the file's text up to the appended data.
std::string headOf(const XmlPiece& piece)
{
  std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"" + piece.Type +
    "\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n  <" + piece.Type;
  if (piece.Grid)
  {
    text += " WholeExtent=\"" + inOrder(piece.Grid->Extent) + "\" Origin=\"" +
      inOrder(piece.Grid->Origin) + "\" Spacing=\"" + inOrder(piece.Grid->Spacing) + "\"";
  }
  text += ">\n    <Piece";
  text += piece.Grid ? " Extent=\"" + inOrder(piece.Grid->Extent) + "\"" : "";
  for (const auto& [name, count] : piece.Counts)
  {
    text += " " + name + "=\"" + std::to_string(count) + "\"";
  }
  text += ">\n";
  std::uint64_t offset = 0;
  for (const XmlSection& section : piece.Sections)
  {
    text += "      <" + section.Name;
    text += section.Scalars.empty() ? ">\n" : " Scalars=\"" + escapedXml(section.Scalars) + "\">\n";
    for (const XmlArray& array : section.Arrays)
    {
      text += std::string("        <DataArray type=\"") + scalarName(array.Type) + "\" Name=\"" +
        escapedXml(array.Name) + "\" NumberOfComponents=\"" + std::to_string(array.Components) +
        "\"" + componentNames(array) + " format=\"appended\" offset=\"" + std::to_string(offset) +
        "\"/>\n";
      offset += sizeof(std::uint64_t) + array.Bytes;
    }
    text += "      </" + section.Name + ">\n";
  }
  return text + "    </Piece>\n  </" + piece.Type + ">\n  <AppendedData encoding=\"raw\">\n   _";
}

} // namespace

bool writeXmlPiece(const std::string& path, const std::optional<PathState>& before,
  const XmlPiece& piece, const std::function<bool()>& isStopped)
{
  PendingFile pending(path, before);
  OutputStream out(pending.file());
  out << headOf(piece);
  for (const XmlSection& section : piece.Sections)
  {
    for (const XmlArray& array : section.Arrays)
    {
      out.write(reinterpret_cast<const char*>(&array.Bytes), sizeof array.Bytes);
      array.Write(out);
    }
  }
  out << "\n  </AppendedData>\n</VTKFile>\n";
  out.finish();
  if (isStopped && isStopped())
  {
    return false;
  }
  pending.commit();
  return true;
}

} // namespace tipp
