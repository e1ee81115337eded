// SPDX-License-Identifier: BSD-3-Clause
#include "Flat/FlatMesh.h"

#include <gtest/gtest.h>

TEST(ArrayFileName, KeepsBlanksAndLetters)
{
  EXPECT_EQ("Material #", tipp::arrayFileName("Material #"));
  EXPECT_EQ("h\xc3\xb6he", tipp::arrayFileName("h\xc3\xb6he"));
}

TEST(ArrayFileName, EncodesCharactersThatFileNamesMayNotHave)
{
  EXPECT_EQ("a%2Fb", tipp::arrayFileName("a/b"));
  EXPECT_EQ("%2E.", tipp::arrayFileName(".."));
  EXPECT_EQ("100%25", tipp::arrayFileName("100%"));
  EXPECT_EQ("a%0Ab", tipp::arrayFileName("a\nb"));
}

TEST(ArrayFileName, IsDecodedToTheSameName)
{
  for (const std::string name :
    { "a/b", "..", ".hidden", "100%", "%2F", "a\\b", "%", "%4", "tab\there", "plain" })
  {
    EXPECT_EQ(name, tipp::arrayNameOf(tipp::arrayFileName(name)));
  }
}

TEST(ArrayFileName, APercentSignWithoutDigitsIsItself)
{
  EXPECT_EQ("50%", tipp::arrayNameOf("50%"));
  EXPECT_EQ("50%zz", tipp::arrayNameOf("50%zz"));
}
