// SPDX-License-Identifier: BSD-3-Clause
#include "OpenCL/DeviceChoice.h"

#include "OpenCL/AcceleratorError.h"

#include <algorithm>
#include <cctype>
#include <stdexcept>

namespace tipp
{
namespace
{

bool isNumber(const std::string& text)
{
  return std::all_of(
    text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
}

int indexOf(const std::string& text)
{
  try
  {
    return std::stoi(text);
  }
  catch (const std::out_of_range&)
  {
    throw AcceleratorError("There is no OpenCL device " + text + ".");
  }
}

} // namespace

DeviceChoice parseDeviceChoice(const std::string& text)
{
  const std::string prefix = "opencl:";
  DeviceChoice choice;
  if (text == "auto")
  {
    return choice;
  }
  if (text == "openmp")
  {
    choice.Kind = Device::OpenMP;
    return choice;
  }
  choice.Kind = Device::OpenCL;
  if (text == "opencl")
  {
    return choice;
  }
  if (text.compare(0, prefix.size(), prefix) != 0 || text.size() == prefix.size())
  {
    throw AcceleratorError(
      "A device is auto, openmp, opencl, opencl:INDEX or opencl:NAME, not '" + text + "'.");
  }
  const std::string device = text.substr(prefix.size());
  if (isNumber(device))
  {
    choice.Index = indexOf(device);
  }
  else
  {
    choice.Name = device;
  }
  return choice;
}

} // namespace tipp
