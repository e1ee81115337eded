// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/Report.h"

#include "Files/IOError.h"
#include "Files/PendingFile.h"

#include <fstream>

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
  std::ofstream file(pending.temporaryPath());
  // File names need not be UTF-8.
  file << json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << '\n';
  file.close();
  if (!file)
  {
    throw IOError(path, "cannot be written; check the disk's space and the folder's permissions.");
  }
  pending.commit();
}

} // namespace tipp
