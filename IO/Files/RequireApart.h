// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRequireApart_h
#define tippRequireApart_h

#include "vtkTIPPIOModule.h"

#include <string>
#include <vector>

namespace tipp
{

/// Throws IOError if an output is also an input or another output, under whatever name or link, or
/// is a folder that holds one. Folders and .pvtu files stand for the files that they consist of;
/// empty names are ignored. To be called before work begins.
VTKTIPPIO_EXPORT void requireApart(
  const std::vector<std::string>& outputs, const std::vector<std::string>& inputs);

/// Stands among the outputs for what a run writes into a scratch folder, which may hold other
/// outputs.
inline std::string scratchIn(const std::string& folder)
{
  return folder.empty() ? "" : folder + "/.scratch";
}

} // namespace tipp

#endif
