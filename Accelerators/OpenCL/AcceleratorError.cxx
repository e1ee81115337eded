// SPDX-License-Identifier: BSD-3-Clause
#include "OpenCL/AcceleratorError.h"

namespace tipp
{

AcceleratorError::AcceleratorError(const std::string& problem)
  : std::runtime_error(problem)
{
}

AcceleratorError::~AcceleratorError() = default;

} // namespace tipp
