// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippChildProcess_h
#define tippChildProcess_h

#include "vtkTIPPIOModule.h"

#include <functional>
#include <string>

namespace tipp
{

/// Runs work in a process of its own, so that the libraries it opens take no memory of this one,
/// and returns what it returns. Throws IOError with the same sentence where the work does.
VTKTIPPIO_EXPORT std::string runInChild(const std::function<std::string()>& work);

} // namespace tipp

#endif
