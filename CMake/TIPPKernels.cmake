# tipp_embed_kernels(<target> <file.cl>...)
# Embeds the text of each .cl file into a target: Folder/Name.cl becomes the header Folder/Name.cl.h
# in the build tree, which defines `const KernelSource NameKernels` (OpenCL/ComputeDevice.h). The target
# <target>_kernels makes only these headers, for programs that analyse the sources.
set(tipp_embed_kernel_script "${CMAKE_CURRENT_LIST_DIR}/EmbedKernel.cmake")

function (tipp_embed_kernels target)
  tipp_real_target(real_target "${target}")
  set(headers "")
  foreach (file IN LISTS ARGN)
    set(source "${CMAKE_CURRENT_SOURCE_DIR}/${file}")
    set(header "${CMAKE_CURRENT_BINARY_DIR}/${file}.h")
    get_filename_component(folder "${source}" DIRECTORY)
    file(GLOB parts CONFIGURE_DEPENDS "${folder}/*.cl") # the file may include these
    add_custom_command(OUTPUT "${header}"
      COMMAND "${CMAKE_COMMAND}" "-DSOURCE=${source}" "-DHEADER=${header}"
        -P "${tipp_embed_kernel_script}"
      DEPENDS ${parts} "${tipp_embed_kernel_script}"
      COMMENT "Embedding ${file}"
      VERBATIM)
    target_sources(${real_target} PRIVATE "${header}")
    list(APPEND headers "${header}")
  endforeach ()
  string(REPLACE "TIPP::" "" name "${target}")
  add_custom_target(${name}_kernels DEPENDS ${headers})
endfunction ()
