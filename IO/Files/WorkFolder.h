// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippWorkFolder_h
#define tippWorkFolder_h

#include "vtkTIPPIOModule.h"

#include <string>

namespace tipp
{

/// Returns "." + name + ending, shortened so that with a suffix it is still a valid file name;
/// different names give different results.
VTKTIPPIO_EXPORT std::string hiddenName(const std::string& name, const std::string& ending);

/// Creates a folder for temporary files, or reuses an existing one if it is empty or was created
/// here for the same purpose: a file in it that holds `purpose` marks it. Throws IOError.
VTKTIPPIO_EXPORT void claimWorkFolder(const std::string& folder, const std::string& purpose);

/// Whether a folder is marked or holds no files.
bool isWorkFolder(const std::string& folder);

/// Removes the mark: from now on the folder and its content belong to the user.
void unmarkWorkFolder(const std::string& folder);

/// Removes the files that runs write and folders that become empty, but not the folder itself.
/// Other files stay, since they are not ours.
VTKTIPPIO_EXPORT void clearWorkFolder(const std::string& folder);

/// As clearWorkFolder(), and removes the mark, and the folder if nothing else is left in it.
VTKTIPPIO_EXPORT void removeWorkFolder(const std::string& folder);

} // namespace tipp

#endif
