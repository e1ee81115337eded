# The ParaView plugin. Here the libraries are built against ParaView's own VTK. They are beside the plugin, with the
# Python package in a folder there, so that they are not confused with those for the other VTK.
find_package(ParaView 5.11 REQUIRED
  COMPONENTS RemotingCore RemotingServerManager RemotingApplication)

set(tipp_plugins_subdirectory "${PARAVIEW_PLUGIN_SUBDIR}")
set(tipp_library_destination
  "${CMAKE_INSTALL_LIBDIR}/${tipp_plugins_subdirectory}/TIPPPlugin")
set(tipp_library_suffix "pv${ParaView_VERSION_MAJOR}.${ParaView_VERSION_MINOR}")
set(tipp_python_destination "${tipp_library_destination}/python")
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/${tipp_library_destination}")

function (tipp_build_paraview_plugin)
  paraview_plugin_scan(
    PLUGIN_FILES "${PROJECT_SOURCE_DIR}/Plugins/TIPPPlugin/paraview.plugin"
    PROVIDES_PLUGINS plugins
    ENABLE_BY_DEFAULT ON
    HIDE_PLUGINS_FROM_CACHE ON)
  set(CMAKE_INSTALL_RPATH "$ORIGIN")
  # paraview_plugin_build appends the plugin's own folder.
  set(CMAKE_LIBRARY_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/${CMAKE_INSTALL_LIBDIR}")
  paraview_plugin_build(
    PLUGINS ${plugins}
    PLUGINS_COMPONENT plugin
    TARGET_COMPONENT plugin
    AUTOLOAD ${plugins}
    PLUGINS_FILE_NAME "tipp.plugins.xml"
    LIBRARY_SUBDIRECTORY "${tipp_plugins_subdirectory}"
    ADD_INSTALL_RPATHS OFF
    INSTALL_HEADERS OFF
    DISABLE_XML_DOCUMENTATION ON)
endfunction ()
