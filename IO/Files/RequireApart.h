// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRequireApart_h
#define tippRequireApart_h

#include "vtkTIPPIOModule.h"

#include <string>
#include <vector>

namespace tipp
{

/// Throws IOError if an output is also an input or another output, under any name or link, or is a
/// folder that holds one. Folders and .pvtu files stand for the files that they consist of; empty
/// names are ignored. Call it before any work.
VTKTIPPIO_EXPORT void requireApart(
  const std::vector<std::string>& outputs, const std::vector<std::string>& inputs);

/// Returns the entry for the list of outputs that stands for a run's files in a scratch folder,
/// which may hold other outputs.
inline std::string scratchIn(const std::string& folder)
{
  return folder.empty() ? "" : folder + "/.scratch";
}

} // namespace tipp

#endif
