#include "host/opencl.h"

#include <fmt/format.h>

namespace clucida::host {
namespace {

struct Known {
    cl_int code;
    const char* name;
    const char* advice; ///< empty where the name says it all
};
constexpr Known known[] = {
    {CL_DEVICE_NOT_FOUND, "CL_DEVICE_NOT_FOUND", "the platform has no such device"},
    {CL_DEVICE_NOT_AVAILABLE, "CL_DEVICE_NOT_AVAILABLE", "the device is busy, was lost or was switched off"},
    {CL_COMPILER_NOT_AVAILABLE, "CL_COMPILER_NOT_AVAILABLE", "the implementation has no compiler"},
    {CL_MEM_OBJECT_ALLOCATION_FAILURE, "CL_MEM_OBJECT_ALLOCATION_FAILURE",
     "the device's memory does not suffice: try a smaller --tile or another --device"},
    {CL_OUT_OF_RESOURCES, "CL_OUT_OF_RESOURCES",
     "the device ran out of resources or stopped the kernel: try a smaller --tile or another --device"},
    {CL_OUT_OF_HOST_MEMORY, "CL_OUT_OF_HOST_MEMORY", "this computer's memory does not suffice"},
    {CL_BUILD_PROGRAM_FAILURE, "CL_BUILD_PROGRAM_FAILURE", "the kernels could not be compiled"},
    {CL_INVALID_VALUE, "CL_INVALID_VALUE", ""},
    {CL_INVALID_DEVICE, "CL_INVALID_DEVICE", "the device was lost"},
    {CL_INVALID_CONTEXT, "CL_INVALID_CONTEXT", ""},
    {CL_INVALID_COMMAND_QUEUE, "CL_INVALID_COMMAND_QUEUE",
     "the device was lost or an earlier command failed: try a smaller --tile or another --device"},
    {CL_INVALID_BINARY, "CL_INVALID_BINARY", ""},
    {CL_INVALID_BUILD_OPTIONS, "CL_INVALID_BUILD_OPTIONS", ""},
    {CL_INVALID_PROGRAM, "CL_INVALID_PROGRAM", ""},
    {CL_INVALID_PROGRAM_EXECUTABLE, "CL_INVALID_PROGRAM_EXECUTABLE", ""},
    {CL_INVALID_KERNEL_NAME, "CL_INVALID_KERNEL_NAME", ""},
    {CL_INVALID_KERNEL_ARGS, "CL_INVALID_KERNEL_ARGS", ""},
    {CL_INVALID_ARG_INDEX, "CL_INVALID_ARG_INDEX", "host and kernel disagree about the arguments"},
    {CL_INVALID_ARG_SIZE, "CL_INVALID_ARG_SIZE", "host and kernel disagree about the arguments"},
    {CL_INVALID_WORK_GROUP_SIZE, "CL_INVALID_WORK_GROUP_SIZE", ""},
    {CL_INVALID_BUFFER_SIZE, "CL_INVALID_BUFFER_SIZE", "a buffer is larger than the device allows"},
    {CL_INVALID_EVENT_WAIT_LIST, "CL_INVALID_EVENT_WAIT_LIST", ""},
    {CL_EXEC_STATUS_ERROR_FOR_EVENTS_IN_WAIT_LIST, "CL_EXEC_STATUS_ERROR_FOR_EVENTS_IN_WAIT_LIST",
     "a command failed on the device: try a smaller --tile or another --device"},
    {-1001, "CL_PLATFORM_NOT_FOUND_KHR", "no OpenCL implementation is installed"},
};

} // namespace

std::string cl_error_name(cl_int code)
{
    for (const Known& k : known)
        if (k.code == code) return k.name;
    return fmt::format("OpenCL error {}", code);
}

std::string explain(const cl::Error& error)
{
    for (const Known& k : known)
        if (k.code == error.err() && *k.advice) return fmt::format("{} ({} from {})", k.advice, k.name, error.what());
    return fmt::format("OpenCL failed: {} from {}", cl_error_name(error.err()), error.what());
}

} // namespace clucida::host
