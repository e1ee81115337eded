// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippVtkXml_h
#define tippVtkXml_h

#include "Files/InputFile.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tipp
{

/// Iterates over the tags of an XML text; text between tags is skipped. Supports the subset of XML
/// that VTK's writers use: no document types, no CDATA sections.
class XmlScanner
{
public:
  /// An opening, closing or empty tag, with its attributes.
  struct Tag
  {
    enum Kind
    {
      Open,
      Close,
      Empty ///< <name/>
    };
    Kind What = Open;
    std::string Name;
    std::vector<std::pair<std::string, std::string>> Attributes;

    /// The attribute's value; null if there is no such attribute.
    const std::string* find(std::string_view name) const;
  };

  explicit XmlScanner(std::string_view text)
    : Text(text)
  {
  }

  /// Reads the next tag. Returns false at the text's end, and from then on if the text is not well
  /// formed; see failed().
  bool next(Tag& tag);
  bool failed() const { return this->Failed; }
  /// The number of bytes consumed.
  std::size_t position() const { return this->At; }

private:
  bool fail();
  bool skipPast(std::string_view end);
  void skipBlanks();
  std::string takeName();
  bool takeAttribute(Tag& tag);

  std::string_view Text;
  std::size_t At = 0;
  bool Failed = false;
};

/// Checks that the arrays of a VTK XML file are complete. VTK's readers do not: if text is not
/// base64, or ends early, they leave values uninitialised.
class XmlDataCheck
{
public:
  /// Attributes of the file's VTKFile element.
  bool IsCompressed = false;
  bool IsBigEndian = false;
  std::uint64_t HeaderBytes = 4; ///< size of the byte count before each array

  /// Checks an array in base64 between its tags.
  bool isWholeText(std::string_view text) const;

  /// Checks the arrays at these offsets after the '_' at byte `begin`.
  bool areWhole(const InputFile& file, std::uint64_t begin, bool isEncoded,
    std::vector<std::uint64_t> offsets) const;

private:
  template <typename Text>
  bool isWhole(const Text& text) const;
  std::uint64_t number(const unsigned char* bytes) const;
  bool isWholeRaw(const InputFile& file, std::uint64_t begin, std::uint64_t end) const;
  bool isWholeEncoded(const InputFile& file, std::uint64_t begin, std::uint64_t end) const;
};

/// The beginning of a VTK XML file.
struct XmlHead
{
  std::string Text;            ///< up to the tag of the appended data, if there are any
  std::string Encoding;        ///< of the appended data
  std::uint64_t DataStart = 0; ///< offset of the appended data in the file; 0: there are none
};

/// Reads a file up to its appended data, whose tag is in the first `most` bytes or so.
XmlHead readXmlHead(const InputFile& file, std::uint64_t most);

/// VTK's name of a cell type; its number in a build without VTK.
VTKTIPPIO_EXPORT std::string cellTypeName(int type);

/// The text as it stands in an XML file: special characters as numbers, control characters that XML
/// does not have as question marks, and text that is not UTF-8 as Latin-1.
std::string escapedXml(const std::string& text);

} // namespace tipp

#endif
