// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippClassicHeader_h
#define tippClassicHeader_h

#include "Files/InputFile.h"

namespace tipp
{

/// Checks a file of NetCDF's classic formats (CDF-1, CDF-2 and CDF-5): the header is well-formed,
/// and the file is long enough for the values that it announces. The NetCDF library reads values
/// beyond the end of a file as zeros. Throws IOError.
/// https://docs.unidata.ucar.edu/netcdf-c/current/file_format_specifications.html
void checkClassicFile(const InputFile& file);

} // namespace tipp

#endif
