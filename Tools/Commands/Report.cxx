// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/Report.h"

#include "Files/PendingFile.h"

#include <sys/resource.h>

namespace tipp
{

std::int64_t peakMemoryBytes()
{
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return std::int64_t(usage.ru_maxrss) * 1024; // Linux counts in KiB
}

void writeJson(const std::string& path, const nlohmann::ordered_json& json)
{
  PendingFile pending(path);
  // File names need not be UTF-8.
  const std::string text =
    json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + '\n';
  pending.file().write(0, text.data(), text.size());
  pending.commit();
}

} // namespace tipp
