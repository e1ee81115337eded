// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippAcceleratorError_h
#define tippAcceleratorError_h

#include "vtkTIPPAcceleratorsModule.h"

#include <stdexcept>
#include <string>

namespace tipp
{

/// A computation that its device cannot do, or whose input makes no sense. what() is one sentence
/// for the user: which device or input, what is wrong and what to do.
class VTKTIPPACCELERATORS_EXPORT AcceleratorError : public std::runtime_error
{
public:
  explicit AcceleratorError(const std::string& problem);
  ~AcceleratorError() override;
};

} // namespace tipp

#endif
