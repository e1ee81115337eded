// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSharedData_h
#define tippSharedData_h

#include <filesystem>

/// Sets the path of a real data file, or skips the test if the file does not exist.
#define TIPP_REQUIRE_DATA(path, name)                                                              \
  const std::string path = std::string(TIPP_SHARED_DATA) + "/" + (name);                           \
  if (!std::filesystem::exists(path))                                                              \
  {                                                                                                \
    GTEST_SKIP() << "there is no " << path << "; name the data's folder by -DTIPP_SHARED_DATA=";   \
  }

#endif
