// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippXmlScanner_h
#define tippXmlScanner_h

#include <cstddef>
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

} // namespace tipp

#endif
