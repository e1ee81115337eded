// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippOpenCLHeaders_h
#define tippOpenCLHeaders_h

// Every driver supports OpenCL 1.2, including PoCL and NVIDIA's.
#define CL_TARGET_OPENCL_VERSION 120
#define CL_HPP_TARGET_OPENCL_VERSION 120
#define CL_HPP_MINIMUM_OPENCL_VERSION 120
#define CL_HPP_ENABLE_EXCEPTIONS
#include <CL/opencl.hpp>

#endif
