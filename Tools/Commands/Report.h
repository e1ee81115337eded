// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippReport_h
#define tippReport_h

#include <nlohmann/json.hpp>

#include <cstdint>
#include <string>

namespace tipp
{

/// The peak memory of this process so far.
std::int64_t peakMemoryBytes();

/// Writes a JSON file; throws IOError.
void writeJson(const std::string& path, const nlohmann::ordered_json& json);

} // namespace tipp

#endif
