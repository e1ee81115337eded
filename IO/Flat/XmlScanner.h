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

/// The tags of an XML text, one after the other; what stands between them is passed over. Knows as
/// much of XML as VTK's writers use: no document types, no sections of character data.
class XmlScanner
{
public:
  struct Tag
  {
    enum Kind
    {
      Open,
      Close,
      Empty ///< opens and closes
    };
    Kind What = Open;
    std::string Name;
    std::vector<std::pair<std::string, std::string>> Attributes;

    /// Null if there is no such attribute.
    const std::string* find(std::string_view name) const;
  };

  explicit XmlScanner(std::string_view text)
    : Text(text)
  {
  }

  /// False at the text's end, and for good where the text is not well formed: failed() tells.
  bool next(Tag& tag);
  bool failed() const { return this->Failed; }
  /// How far it has come, in bytes.
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
