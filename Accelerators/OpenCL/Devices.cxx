// SPDX-License-Identifier: BSD-3-Clause
#include "OpenCL/Devices.h"

#include <algorithm>
#include <cctype>

namespace tipp
{

AcceleratorError::~AcceleratorError() = default;
UnknownDevice::~UnknownDevice() = default;

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
  if (device.find_first_not_of("0123456789") != std::string::npos)
  {
    choice.Name = device;
    return choice;
  }
  try
  {
    choice.Index = std::stoi(device);
  }
  catch (const std::out_of_range&)
  {
    throw UnknownDevice("There is no OpenCL device " + device + ".");
  }
  return choice;
}

namespace
{

std::string lower(std::string text)
{
  std::transform(text.begin(), text.end(), text.begin(),
    [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

std::string namesOf(const std::vector<DeviceDescription>& devices)
{
  std::string names;
  for (const DeviceDescription& device : devices)
  {
    names += (names.empty() ? "" : ", ") + std::to_string(device.Index) + " '" + device.Name + "'" +
      (device.Platform.empty() ? "" : " of '" + device.Platform + "'");
  }
  return names;
}

[[noreturn]] void failMissing(
  const std::string& wanted, const std::vector<DeviceDescription>& devices)
{
  throw UnknownDevice("There is no OpenCL device " + wanted +
    (devices.empty() ? ". " + noDeviceAdvice() : "; there are: " + namesOf(devices) + "."));
}

/// The first device with double precision, or else the first one, whose property contains `wanted`,
/// which is in lower case; null if there is none.
const DeviceDescription* deviceWith(const std::string& wanted,
  std::string DeviceDescription::*property, const std::vector<DeviceDescription>& devices)
{
  const DeviceDescription* found = nullptr;
  for (const DeviceDescription& device : devices)
  {
    const bool matches = lower(device.*property).find(wanted) != std::string::npos;
    if (matches && (found == nullptr || (!found->Double && device.Double)))
    {
      found = &device;
    }
  }
  return found;
}

const DeviceDescription& deviceNamed(
  const std::string& name, const std::vector<DeviceDescription>& devices)
{
  const std::string wanted = lower(name);
  const DeviceDescription* found = deviceWith(wanted, &DeviceDescription::Name, devices);
  found = found ? found : deviceWith(wanted, &DeviceDescription::Platform, devices);
  if (found == nullptr)
  {
    failMissing("named '" + name + "'", devices);
  }
  return *found;
}

const DeviceDescription* firstWithDouble(
  const std::vector<DeviceDescription>& devices, bool gpuOnly)
{
  const auto found = std::find_if(devices.begin(), devices.end(),
    [gpuOnly](const DeviceDescription& device)
    { return device.Double && (!gpuOnly || device.Type == DeviceType::Gpu); });
  return found == devices.end() ? nullptr : &*found;
}

const DeviceDescription& deviceOf(
  const DeviceChoice& choice, const std::vector<DeviceDescription>& devices)
{
  if (choice.Index >= 0)
  {
    if (static_cast<std::size_t>(choice.Index) >= devices.size())
    {
      failMissing(std::to_string(choice.Index), devices);
    }
    return devices[static_cast<std::size_t>(choice.Index)];
  }
  if (!choice.Name.empty())
  {
    return deviceNamed(choice.Name, devices);
  }
  const DeviceDescription* gpu = firstWithDouble(devices, true);
  const DeviceDescription* any = gpu != nullptr ? gpu : firstWithDouble(devices, false);
  return any != nullptr ? *any : devices.front();
}

} // namespace

std::optional<DeviceDescription> chooseDevice(
  const DeviceChoice& choice, const std::vector<DeviceDescription>& devices)
{
  if (choice.Kind == Device::OpenMP)
  {
    return std::nullopt;
  }
  if (choice.Kind == Device::Auto)
  {
    const DeviceDescription* gpu = firstWithDouble(devices, true);
    return gpu != nullptr ? std::optional<DeviceDescription>(*gpu) : std::nullopt;
  }
  if (devices.empty() && choice.Index < 0 && choice.Name.empty())
  {
    throw AcceleratorError(noDeviceAdvice());
  }
  const DeviceDescription& device = deviceOf(choice, devices);
  if (!device.Double)
  {
    throw AcceleratorError("The OpenCL device '" + device.Name +
      "' has no double precision, which exact results need; choose another one, or OpenMP.");
  }
  return device;
}

std::vector<std::string> deviceChoices(const std::vector<DeviceDescription>& devices)
{
  std::vector<std::string> choices = { "auto", "openmp" };
  for (const DeviceDescription& device : devices)
  {
    if (device.Double)
    {
      const DeviceChoice byName = parseDeviceChoice("opencl:" + device.Name);
      const bool meant =
        !byName.Name.empty() && chooseDevice(byName, devices)->Index == device.Index;
      choices.push_back("opencl:" + (meant ? device.Name : std::to_string(device.Index)));
    }
  }
  return choices;
}

} // namespace tipp
