// SPDX-License-Identifier: BSD-3-Clause
#include "Files/VtkXml.h"

#include <gtest/gtest.h>

namespace
{

using Tag = tipp::XmlScanner::Tag;

/// The tags of a text: "+name" opens, "-name" closes, "=name" is empty. A "!" at the end means that
/// the text is not well formed.
std::string outline(const std::string& text)
{
  tipp::XmlScanner scanner(text);
  std::string found;
  for (Tag tag; scanner.next(tag);)
  {
    found += (tag.What == Tag::Open ? '+' : tag.What == Tag::Close ? '-' : '=') + tag.Name;
  }
  return found + (scanner.failed() ? "!" : "");
}

} // namespace

TEST(XmlScanner, FindsTagsInOrder)
{
  EXPECT_EQ("+a=b-a", outline("<a> text <b/> more </a>"));
}

TEST(XmlScanner, IgnoresCommentsAndInstructions)
{
  EXPECT_EQ("+a-a", outline("<?xml version=\"1.0\"?><!-- <b> --><a><!----></a>"));
}

TEST(XmlScanner, DecodesAttributes)
{
  tipp::XmlScanner scanner("<a one='1' two = \"&lt;&amp;&gt; '\" three=''>");
  Tag tag;
  ASSERT_TRUE(scanner.next(tag));
  EXPECT_EQ("1", *tag.find("one"));
  EXPECT_EQ("<&> '", *tag.find("two"));
  EXPECT_EQ("", *tag.find("three"));
  EXPECT_EQ(nullptr, tag.find("four"));
}

TEST(XmlScanner, DecodesNumbersOfCharacters)
{
  tipp::XmlScanner scanner(
    "<a b='&#38;&#x3c;&#9;' c='&#233;&#x20AC;&#x1F600;' d='&#;&#38&#x110000;'>");
  Tag tag;
  ASSERT_TRUE(scanner.next(tag));
  EXPECT_EQ("&<\t", *tag.find("b"));
  EXPECT_EQ("\xC3\xA9\xE2\x82\xAC\xF0\x9F\x98\x80", *tag.find("c"));
  EXPECT_EQ("&#;&#38&#x110000;", *tag.find("d"));
}

TEST(XmlScanner, StopsWhereTheTextIsNotWellFormed)
{
  for (const char* text : { "<", "<a", "<a b", "<a b=", "<a b=c>", "<a b='c>", "<a b='1' b='2'>",
         "<!-- open", "<?open", "</a b='1'>", "<a/", "< a>", "</>" })
  {
    const std::string found = outline(text);
    EXPECT_EQ('!', found.back()) << text;
  }
}
