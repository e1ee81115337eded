// SPDX-License-Identifier: BSD-3-Clause
#include "Flat/XmlScanner.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace tipp
{
namespace
{

// The five entities that XML itself knows; anything else stands as it is.
std::string decode(std::string_view text)
{
  constexpr std::array<std::pair<std::string_view, char>, 5> entities = { {
    { "&amp;", '&' },
    { "&lt;", '<' },
    { "&gt;", '>' },
    { "&quot;", '"' },
    { "&apos;", '\'' },
  } };
  std::string decoded;
  while (!text.empty())
  {
    std::size_t taken = 1;
    char character = text.front();
    for (const auto& [entity, value] : entities)
    {
      if (text.substr(0, entity.size()) == entity)
      {
        taken = entity.size();
        character = value;
      }
    }
    decoded += character;
    text.remove_prefix(taken);
  }
  return decoded;
}

} // namespace

const std::string* XmlScanner::Tag::find(std::string_view name) const
{
  for (const auto& [key, value] : this->Attributes)
  {
    if (key == name)
    {
      return &value;
    }
  }
  return nullptr;
}

bool XmlScanner::fail()
{
  this->Failed = true;
  return false;
}

bool XmlScanner::skipPast(std::string_view end)
{
  const std::size_t found = this->Text.find(end, this->At);
  if (found == std::string_view::npos)
  {
    return this->fail();
  }
  this->At = found + end.size();
  return true;
}

void XmlScanner::skipBlanks()
{
  while (this->At < this->Text.size() &&
    std::isspace(static_cast<unsigned char>(this->Text[this->At])) != 0)
  {
    ++this->At;
  }
}

std::string XmlScanner::takeName()
{
  const std::size_t end =
    std::min(this->Text.find_first_of(" \t\r\n=/><\"'", this->At), this->Text.size());
  std::string name(this->Text.substr(this->At, end - this->At));
  this->At = end;
  return name;
}

bool XmlScanner::takeAttribute(Tag& tag)
{
  std::string name = this->takeName();
  this->skipBlanks();
  if (name.empty() || this->Text.substr(this->At, 1) != "=")
  {
    return this->fail();
  }
  ++this->At;
  this->skipBlanks();
  const std::string_view quote = this->Text.substr(this->At, 1);
  const std::size_t end =
    quote == "\"" || quote == "'" ? this->Text.find(quote, this->At + 1) : std::string_view::npos;
  if (end == std::string_view::npos || tag.find(name))
  {
    return this->fail();
  }
  tag.Attributes.emplace_back(
    std::move(name), decode(this->Text.substr(this->At + 1, end - this->At - 1)));
  this->At = end + 1;
  return true;
}

bool XmlScanner::next(Tag& tag)
{
  if (this->Failed)
  {
    return false;
  }
  for (;;)
  {
    this->At = std::min(this->Text.find('<', this->At), this->Text.size());
    const std::string_view rest = this->Text.substr(this->At);
    const bool comment = rest.substr(0, 4) == "<!--";
    if (!comment && rest.substr(0, 2) != "<?")
    {
      break;
    }
    if (!this->skipPast(comment ? "-->" : "?>"))
    {
      return false;
    }
  }
  if (this->At == this->Text.size())
  {
    return false;
  }
  ++this->At;
  tag = Tag();
  if (this->Text.substr(this->At, 1) == "/")
  {
    ++this->At;
    tag.What = Tag::Close;
  }
  tag.Name = this->takeName();
  if (tag.Name.empty())
  {
    return this->fail();
  }
  for (this->skipBlanks(); this->At < this->Text.size(); this->skipBlanks())
  {
    if (this->Text[this->At] == '>')
    {
      ++this->At;
      return true;
    }
    if (tag.What == Tag::Open && this->Text.substr(this->At, 2) == "/>")
    {
      tag.What = Tag::Empty;
      this->At += 2;
      return true;
    }
    if (tag.What == Tag::Close || !this->takeAttribute(tag))
    {
      return this->fail();
    }
  }
  return this->fail();
}

} // namespace tipp
