// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippWorkFolder_h
#define tippWorkFolder_h

#include "vtkTIPPIOModule.h"

#include <string>

namespace tipp
{

/// "." + name + ending, cut so that the whole and some more letters still make a file name; names
/// that differ stay different.
VTKTIPPIO_EXPORT std::string hiddenName(const std::string& name, const std::string& ending);

/// Makes a folder for temporary files, or takes the one that is there if it is empty or was made
/// here for the same purpose: a file in it, which holds `purpose`, marks it. Throws IOError.
VTKTIPPIO_EXPORT void claimWorkFolder(const std::string& folder, const std::string& purpose);

/// Whether a folder is marked, or has no files.
bool isWorkFolder(const std::string& folder);

/// From now on the folder and what is in it belongs to the user.
void unmarkWorkFolder(const std::string& folder);

/// Removes the files that runs write and the folders that are empty then, but not the folder
/// itself. Other files stay: somebody else has put them there.
VTKTIPPIO_EXPORT void clearWorkFolder(const std::string& folder);

/// Does the same, and removes the mark and the folder if nothing else is left in it.
VTKTIPPIO_EXPORT void removeWorkFolder(const std::string& folder);

} // namespace tipp

#endif
