// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCheckTimes_h
#define tippCheckTimes_h

#include <string>
#include <vector>

namespace tipp
{

/// Throws IOError, with the first step that is wrong, unless the times are finite and ascending.
void checkTimes(const std::string& path, const std::vector<double>& times);

} // namespace tipp

#endif
