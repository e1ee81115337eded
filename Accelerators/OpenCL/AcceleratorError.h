// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippAcceleratorError_h
#define tippAcceleratorError_h

#include "vtkTIPPAcceleratorsModule.h"

#include <stdexcept>
#include <string>

namespace tipp
{

/// Thrown if a device cannot do a computation, or if the input is invalid. what() is one sentence
/// for the user: which device or input, what is wrong and what to do.
class VTKTIPPACCELERATORS_EXPORT AcceleratorError : public std::runtime_error
{
public:
  explicit AcceleratorError(const std::string& problem);
  ~AcceleratorError() override;
};

} // namespace tipp

#endif
