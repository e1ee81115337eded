cmake_minimum_required(VERSION 3.22)
# The installed Python package must run with only PYTHONPATH set.
execute_process(COMMAND "${CMAKE_COMMAND}" -E env --unset=LD_LIBRARY_PATH
  "PYTHONPATH=${PREFIX}/lib/python3/dist-packages" "${PYTHON}" "${PROGRAM}"
  COMMAND_ERROR_IS_FATAL ANY)
