// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippOpenCLHeaders_h
#define tippOpenCLHeaders_h

// OpenCL 1.2 is what every driver offers, PoCL and those of NVIDIA included.
#define CL_TARGET_OPENCL_VERSION 120
#define CL_HPP_TARGET_OPENCL_VERSION 120
#define CL_HPP_MINIMUM_OPENCL_VERSION 120
#define CL_HPP_ENABLE_EXCEPTIONS
#include <CL/opencl.hpp>

#endif
