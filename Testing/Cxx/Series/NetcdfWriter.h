// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippNetcdfWriter_h
#define tippNetcdfWriter_h

#include <netcdf.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace tipp
{
namespace test
{

/// Writes a NetCDF file by the library's C interface.
class NetcdfWriter
{
public:
  /// `format`: NC_NETCDF4, or 0 for the classic one.
  explicit NetcdfWriter(std::string path, int format = NC_NETCDF4)
    : Path(std::move(path))
  {
    check(nc_create(this->Path.c_str(), format | NC_CLOBBER, &this->Root));
    this->File = this->Root;
  }
  ~NetcdfWriter() { this->close(); }
  NetcdfWriter(const NetcdfWriter&) = delete;
  NetcdfWriter& operator=(const NetcdfWriter&) = delete;

  /// Begins a group: what is defined next is in it.
  void group(const std::string& name, int in = -1)
  {
    check(nc_def_grp(in < 0 ? this->Root : in, name.c_str(), &this->File));
  }

  int dimension(const std::string& name, std::size_t size)
  {
    int id = 0;
    check(nc_def_dim(this->File, name.c_str(), size, &id));
    return id;
  }

  int variable(const std::string& name, nc_type type, const std::vector<int>& dimensions)
  {
    int id = 0;
    check(
      nc_def_var(this->File, name.c_str(), type, int(dimensions.size()), dimensions.data(), &id));
    return id;
  }

  void text(int variable, const std::string& name, const std::string& value)
  {
    check(nc_put_att_text(this->File, variable, name.c_str(), value.size(), value.c_str()));
  }

  /// A number of the given type.
  void number(
    int variable, const std::string& name, nc_type type, const std::vector<double>& values)
  {
    check(
      nc_put_att_double(this->File, variable, name.c_str(), type, values.size(), values.data()));
  }

  /// Writes all values; ends the definitions.
  void put(int variable, const std::vector<double>& values)
  {
    nc_enddef(this->File);
    check(nc_put_var_double(this->File, variable, values.data()));
  }

  /// Writes values from a start on, such as a record.
  void putAt(int variable, const std::vector<std::size_t>& start,
    const std::vector<std::size_t>& count, const std::vector<double>& values)
  {
    nc_enddef(this->File);
    check(nc_put_vara_double(this->File, variable, start.data(), count.data(), values.data()));
  }

  int file() const { return this->File; }

  const std::string& close()
  {
    if (this->Root >= 0)
    {
      check(nc_close(this->Root));
      this->Root = -1;
    }
    return this->Path;
  }

  static void check(int status)
  {
    if (status != NC_NOERR)
    {
      throw std::runtime_error(nc_strerror(status));
    }
  }

private:
  std::string Path;
  int Root = -1; ///< the file
  int File = -1; ///< the group
};

} // namespace test
} // namespace tipp

#endif
