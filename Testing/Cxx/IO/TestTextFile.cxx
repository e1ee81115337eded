// SPDX-License-Identifier: BSD-3-Clause
#include "Files/TextFile.h"

#include "ExpectIOError.h"
#include "TemporaryFolder.h"

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <random>
#include <string>

namespace
{

using namespace tipp;
using namespace tipp::test;
using Fields = std::vector<std::string_view>;

std::vector<std::string> linesOf(const std::string& text)
{
  LineReader reader(text);
  std::vector<std::string> lines;
  for (std::string_view line; reader.next(line);)
  {
    lines.emplace_back(line);
  }
  return lines;
}

Fields fieldsOf(std::string_view line, char delimiter)
{
  Fields fields{ "left over" };
  splitFields(line, delimiter, fields);
  return fields;
}

TEST(TextFile, IsReadCompletely)
{
  const TemporaryFolder folder;
  std::string text;
  for (int i = 0; i < 300000; ++i)
  {
    text += std::to_string(i) + "\n";
  }
  EXPECT_EQ(text, readTextFile(folder.file("large.txt", text)));
  EXPECT_EQ("", readTextFile(folder.file("empty.txt", "")));
}

TEST(TextFile, BinaryFilesAreRefused)
{
  const TemporaryFolder folder;
  const std::string path = folder.file("binary.txt", std::string("ab\0c", 4));
  expectIOError(path, "not a text file", [&] { readTextFile(path); });
}

TEST(TextFile, AMissingFileIsReported)
{
  const TemporaryFolder folder;
  const std::string path = folder.path("none.txt");
  expectIOError(path, "cannot be opened", [&] { readTextFile(path); });
}

TEST(LineReader, EndsOfEitherKindAndAByteOrderMarkAreLeftOut)
{
  EXPECT_EQ((std::vector<std::string>{ "a", "", "b", "c" }),
    linesOf("\xef\xbb\xbf"
            "a\r\n\nb\nc"));
  EXPECT_TRUE(linesOf("").empty());
  EXPECT_EQ(std::vector<std::string>{ "" }, linesOf("\n"));
}

TEST(LineReader, CountsLines)
{
  LineReader reader("a\nb\nc\n");
  std::string_view line;
  EXPECT_EQ(0, reader.lineNumber());
  ASSERT_TRUE(reader.next(line) && reader.next(line));
  EXPECT_EQ(2, reader.lineNumber());
  EXPECT_EQ("c\n", reader.rest());
}

TEST(NumberRows, SkipCommentsAndAcceptWholeNumbersOfEitherKind)
{
  const TemporaryFolder folder;
  NumberRows rows(folder.file("a.txt", "\n# none\n\n3 4.0 0.5 # row\n"), "a test", '#');
  EXPECT_LE(3, rows.remainingLines());
  rows.next(3, "a row");
  EXPECT_EQ(3U, rows.fields());
  EXPECT_EQ(3, rows.integer(0));
  EXPECT_EQ(4, rows.integer(1));
  EXPECT_EQ(0.5, rows.number(2));
  EXPECT_LE(0, rows.remainingLines());
  expectIOError(folder.path("a.txt"), "line 4: '0.5' is not an integer", [&] { rows.integer(2); });
  expectIOError(folder.path("a.txt"), "ends before a row", [&] { rows.next(1, "a row"); });
}

TEST(SplitFields, ADelimiterSeparatesEvenEmptyFields)
{
  EXPECT_EQ((Fields{ "1", "", "3", "" }), fieldsOf("1,,3,", ','));
  EXPECT_EQ(Fields{ "" }, fieldsOf("", ','));
}

TEST(SplitFields, ConsecutiveBlanksAreOneSeparator)
{
  EXPECT_EQ((Fields{ "1", "2", "3" }), fieldsOf("  1 \t2   3 ", ' '));
  EXPECT_TRUE(fieldsOf(" \t ", ' ').empty());
}

TEST(SplitFields, QuotedFieldsMayHoldTheDelimiter)
{
  EXPECT_EQ((Fields{ "\"a,b\"", "c" }), fieldsOf("\"a,b\",c", ','));
  EXPECT_EQ(Fields{ "\"never closed,c" }, fieldsOf("\"never closed,c", ','));
}

TEST(TrimField, RemovesBlanksAndOnePairOfQuotes)
{
  EXPECT_EQ("a b", trimField(" \" a b \"\t"));
  EXPECT_EQ("\"", trimField("\""));
}

TEST(ParseNumber, ParsesAWholeField)
{
  double value = 0;
  EXPECT_TRUE(parseNumber(" \"+1.5e3\" ", value));
  EXPECT_EQ(1500, value);
  EXPECT_TRUE(parseNumber("-0.25", value));
  EXPECT_EQ(-0.25, value);
  for (const char* wrong : { "", "1.5x", "1 2", "+-1", "--1", "abc" })
  {
    EXPECT_FALSE(parseNumber(wrong, value)) << wrong;
  }
}

TEST(ParseNumber, ShortNumbersAreTheNearestDoubles)
{
  std::mt19937_64 random(20261128);
  for (int i = 0; i < 100000; ++i)
  {
    std::string digits = std::to_string(random() >> (random() % 64));
    digits.insert(random() % (digits.size() + 1), random() % 4 == 0 ? "" : ".");
    const std::string text = (random() % 2 == 0 ? "-" : "") + digits;
    double value = 0;
    ASSERT_TRUE(parseNumber(text, value)) << text;
    const double nearest = std::strtod(text.c_str(), nullptr);
    ASSERT_EQ(std::memcmp(&value, &nearest, sizeof value), 0) << text;
  }
  for (const char* const wrong : { "", "-", ".", "-.", "1.2.3", "--1", "1-", "1 2", "1.5x" })
  {
    double value = 0;
    EXPECT_FALSE(parseNumber(wrong, value)) << wrong;
  }
}

TEST(ParseNumber, OutOfRangeGivesTheNearestDouble)
{
  double value = 0;
  EXPECT_TRUE(parseNumber("1e999", value));
  EXPECT_TRUE(std::isinf(value));
  EXPECT_TRUE(parseNumber("1e-999", value));
  EXPECT_EQ(0, value);
}

TEST(ParseInteger, ParsesAWholeFieldInRange)
{
  std::int64_t value = 0;
  EXPECT_TRUE(parseInteger(" -9223372036854775808 ", value));
  EXPECT_EQ(INT64_MIN, value);
  for (const char* wrong : { "", "1.0", "9223372036854775808", "1e3" })
  {
    EXPECT_FALSE(parseInteger(wrong, value)) << wrong;
  }
}

} // namespace
