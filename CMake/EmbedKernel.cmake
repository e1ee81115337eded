cmake_minimum_required(VERSION 3.22)
# Writes HEADER, a C++ header with the text of the OpenCL file SOURCE; see tipp_embed_kernels.
file(READ "${SOURCE}" text)
# A device's compiler gets a single text, so the files that SOURCE includes from its folder are inserted.
get_filename_component(folder "${SOURCE}" DIRECTORY)
string(REGEX MATCHALL "#include \"[A-Za-z0-9]+\\.cl\"\n" includes "${text}")
foreach (include IN LISTS includes)
  string(REGEX REPLACE "#include \"([A-Za-z0-9]+\\.cl)\"\n" "\\1" included "${include}")
  file(READ "${folder}/${included}" part)
  string(REPLACE "${include}" "${part}" text "${text}")
endforeach ()
get_filename_component(name "${SOURCE}" NAME_WE)
file(WRITE "${HEADER}"
"// Made from ${name}.cl.
#include \"OpenCL/ComputeDevice.h\"
namespace tipp
{
const KernelSource ${name}Kernels = { \"${name}\", R\"opencl(${text})opencl\" };
}
")
