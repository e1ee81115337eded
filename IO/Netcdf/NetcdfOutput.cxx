// SPDX-License-Identifier: BSD-3-Clause
#include "Netcdf/NetcdfOutput.h"

#include "Files/IOError.h"

#include <dlfcn.h>
#include <netcdf.h>

#include <cstdint>
#include <limits>
#include <memory>
#include <utility>

namespace tipp
{
namespace
{

/// Calls a function of the HDF5 library that NetCDF is linked to; does nothing if there is none.
template <typename Function, typename... Arguments>
void callHdf5(const char* name, Arguments... arguments)
{
  if (const auto function = reinterpret_cast<Function>(dlsym(RTLD_DEFAULT, name)))
  {
    function(arguments...);
  }
}

/// HDF5 crashes when a file that could not be written, as on a full disk, is still open at the end
/// of the process. All files are closed here, so it has nothing to do then.
void keepHdf5FromExit()
{
  callHdf5<int (*)()>("H5dont_atexit");
}

/// Stops HDF5 from printing errors of this thread, which are exceptions here.
void silenceHdf5()
{
  callHdf5<int (*)(std::int64_t, void*, void*)>("H5Eset_auto2", std::int64_t(0), nullptr, nullptr);
}

nc_type netcdfTypeOf(Scalar type)
{
  switch (type)
  {
    case Scalar::Int8:
      return NC_BYTE;
    case Scalar::UInt8:
      return NC_UBYTE;
    case Scalar::Int16:
      return NC_SHORT;
    case Scalar::UInt16:
      return NC_USHORT;
    case Scalar::Int32:
      return NC_INT;
    case Scalar::UInt32:
      return NC_UINT;
    case Scalar::Int64:
      return NC_INT64;
    case Scalar::UInt64:
      return NC_UINT64;
    case Scalar::Float32:
      return NC_FLOAT;
    default:
      return NC_DOUBLE;
  }
}

} // namespace

struct NetcdfOutput::State
{
  State(const std::string& path, const std::optional<PathState>& before, std::string advice)
    : Path(path)
    , Advice(std::move(advice))
    , Pending(path, before)
  {
  }

  /// Throws if a call has failed. `name`: of the variable or attribute at which it may fail.
  void check(int status, const std::string& name = "")
  {
    if (status != NC_NOERR)
    {
      this->HasFailed = true;
      throw IOError(this->Path,
        std::string("cannot be written as NetCDF") + (name.empty() ? "" : ", at '" + name + "'") +
          ": " + nc_strerror(status) +
          (name.empty() ? "; is the disk full?" : "; " + this->Advice));
    }
  }

  const std::string Path;
  const std::string Advice;
  PendingFile Pending;
  int File = 0;
  bool IsOpen = false;
  bool HasFailed = false;
};

const int NetcdfOutput::global = NC_GLOBAL;

NetcdfOutput::NetcdfOutput(const std::string& path, const std::optional<PathState>& before,
  bool isClassic, std::string advice)
  : Own(std::make_unique<State>(path, before, std::move(advice)))
{
  this->Own->Pending.unlock();
  keepHdf5FromExit();
  const int kind = NC_NETCDF4 | (isClassic ? NC_CLASSIC_MODEL : 0);
  this->Own->check(
    nc_create(this->Own->Pending.temporaryPath().c_str(), NC_CLOBBER | kind, &this->Own->File));
  this->Own->IsOpen = true;
}

NetcdfOutput::~NetcdfOutput()
{
  // After a failed write, as on a full disk, HDF5 crashes when it is told to give up the file.
  if (this->Own->IsOpen && !this->Own->HasFailed)
  {
    nc_abort(this->Own->File);
  }
}

void NetcdfOutput::requireWriter(const std::string&) {}

void NetcdfOutput::setText(int variable, const char* name, const std::string& text) const
{
  if (!text.empty())
  {
    this->Own->check(nc_put_att_text(this->Own->File, variable, name, text.size(), text.c_str()));
  }
}

void NetcdfOutput::setInteger(int variable, const char* name, int value) const
{
  this->Own->check(nc_put_att_int(this->Own->File, variable, name, NC_INT, 1, &value));
}

int NetcdfOutput::addDimension(const std::string& name, std::size_t size) const
{
  int dimension = 0;
  this->Own->check(nc_def_dim(this->Own->File, name.c_str(), size, &dimension));
  return dimension;
}

int NetcdfOutput::addUnlimited(const std::string& name) const
{
  return this->addDimension(name, NC_UNLIMITED);
}

int NetcdfOutput::addVariable(
  const std::string& name, Scalar type, const std::vector<int>& dimensions) const
{
  int variable = 0;
  this->Own->check(nc_def_var(this->Own->File, name.c_str(), netcdfTypeOf(type),
                     int(dimensions.size()), dimensions.data(), &variable),
    name);
  return variable;
}

void NetcdfOutput::compress(int variable, const std::vector<std::size_t>& chunk) const
{
  this->Own->check(nc_def_var_chunking(this->Own->File, variable, NC_CHUNKED, chunk.data()));
  constexpr int fast = 1; // of 9: larger ones take twice the time for a few per cent
  this->Own->check(nc_def_var_deflate(this->Own->File, variable, 1, 1, fast));
}

void NetcdfOutput::fillWithNaN(int variable, Scalar type) const
{
  const double missing = std::numeric_limits<double>::quiet_NaN();
  this->Own->check(
    nc_put_att_double(this->Own->File, variable, "_FillValue", netcdfTypeOf(type), 1, &missing));
}

void NetcdfOutput::withoutFill(int variable) const
{
  this->Own->check(nc_def_var_fill(this->Own->File, variable, NC_NOFILL, nullptr));
}

void NetcdfOutput::endDefinitions() const
{
  this->Own->check(nc_enddef(this->Own->File));
}

void NetcdfOutput::write(int variable, const std::vector<std::size_t>& start,
  const std::vector<std::size_t>& count, const void* values) const
{
  silenceHdf5();
  this->Own->check(nc_put_vara(this->Own->File, variable, start.data(), count.data(), values));
}

void NetcdfOutput::close()
{
  silenceHdf5();
  this->Own->IsOpen = false;
  this->Own->check(nc_close(this->Own->File));
  this->Own->Pending.commit();
}

} // namespace tipp
