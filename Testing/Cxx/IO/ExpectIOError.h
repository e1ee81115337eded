// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippExpectIOError_h
#define tippExpectIOError_h

#include "Files/IOError.h"

#include <gtest/gtest.h>

#include <string>

namespace tipp
{
namespace test
{

/// Expects that the action throws an IOError of one sentence that starts with the path and contains
/// `words`.
template <typename Action>
void expectIOError(const std::string& path, const std::string& words, Action action)
{
  try
  {
    action();
    ADD_FAILURE() << "no IOError about " << path;
  }
  catch (const IOError& error)
  {
    const std::string text = error.what();
    EXPECT_EQ(0U, text.find(path)) << text;
    EXPECT_NE(std::string::npos, text.find(words)) << text;
    EXPECT_EQ('.', text.back()) << text;
    EXPECT_EQ(std::string::npos, text.find('\n')) << text;
  }
}

} // namespace test
} // namespace tipp

#endif
