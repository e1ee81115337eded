// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippReport_h
#define tippReport_h

#include <nlohmann/json.hpp>

#include <cstdint>
#include <string>

namespace tipp
{

/// Of this process, so far.
std::int64_t peakMemoryBytes();

/// Throws IOError.
void writeJson(const std::string& path, const nlohmann::ordered_json& json);

} // namespace tipp

#endif
