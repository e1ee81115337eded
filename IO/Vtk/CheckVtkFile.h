// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCheckVtkFile_h
#define tippCheckVtkFile_h

#include "vtkTIPPIOModule.h"

#include <string>

namespace tipp
{

/// Reads the headers in a VTK file, XML or legacy, and throws IOError if they give counts that the
/// file's size cannot hold: VTK's readers would allocate that much memory, or loop that often. Of a
/// parallel file its pieces' files are checked, too. Files of other kinds are accepted.
VTKTIPPIO_EXPORT void checkVtkFile(const std::string& path);

} // namespace tipp

#endif
