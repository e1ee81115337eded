cmake_minimum_required(VERSION 3.22)
# Writes HEADER, which holds the text of the OpenCL file SOURCE; see tipp_embed_kernels.
file(READ "${SOURCE}" text)
# A device's compiler sees one text: what the file includes from its folder becomes a part of it.
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
