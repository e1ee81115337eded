cmake_minimum_required(VERSION 3.22)
# Writes HEADER, which holds the text of the OpenCL file SOURCE; see tipp_embed_kernels.
file(READ "${SOURCE}" text)
get_filename_component(name "${SOURCE}" NAME_WE)
file(WRITE "${HEADER}"
"// Made from ${name}.cl.
#include \"OpenCL/ComputeDevice.h\"
namespace tipp
{
const KernelSource ${name}Kernels = { \"${name}\", R\"opencl(${text})opencl\" };
}
")
