// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippChildProcess_h
#define tippChildProcess_h

#include "vtkTIPPIOModule.h"

#include <functional>
#include <string>

namespace tipp
{

/// Runs `work` in a child process, so that the libraries it loads take no memory in this one, and
/// returns its result. If `work` throws an IOError, throws one with the same message.
VTKTIPPIO_EXPORT std::string runInChild(const std::function<std::string()>& work);

} // namespace tipp

#endif
