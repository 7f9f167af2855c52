/// OpenCL's C++ binding as this program uses it: version 1.2, with exceptions; and what its errors mean.
#pragma once

#define CL_HPP_TARGET_OPENCL_VERSION 120
#define CL_HPP_MINIMUM_OPENCL_VERSION 120
#define CL_HPP_ENABLE_EXCEPTIONS
#define CL_TARGET_OPENCL_VERSION 120
#include <CL/opencl.hpp>

#include <string>

namespace clucida::host {

/// The name of an error code, as the specification has it: "CL_OUT_OF_RESOURCES".
std::string cl_error_name(cl_int code);

/// What failed, why, and what to do about it, in a sentence.
std::string explain(const cl::Error& error);

} // namespace clucida::host
