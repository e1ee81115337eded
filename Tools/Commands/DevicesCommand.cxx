// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/Commands.h"

#include "Console/MpiSession.h"
#include "OpenCL/Devices.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace tipp
{
namespace
{

constexpr const char* footer =
  R"(One line a device: INDEX, CPU, GPU or other, memory, whether it has the double
precision that resampling needs, NAME, and the driver. --device of other
commands takes opencl:INDEX or opencl:NAME, NAME being any part of the name.

Example:
  tipp devices
)";

const char* nameOf(DeviceType type)
{
  return type == DeviceType::Cpu ? "CPU" : type == DeviceType::Gpu ? "GPU" : "other";
}

void printDevices()
{
  if (listDevices().empty())
  {
    fmt::print("{}\n", noDeviceAdvice());
  }
  for (const DeviceDescription& device : listDevices())
  {
    fmt::print("{}  {}  {:.1f} GB  {}  {} ({})\n", device.Index, nameOf(device.Type),
      double(device.Memory) / 1e9, device.Double ? "double" : "no double", device.Name,
      device.Platform);
  }
}

} // namespace

void addDevicesCommand(CLI::App& app, int& exitCode)
{
  CLI::App* const command = app.add_subcommand("devices", "Lists this machine's OpenCL devices");
  command->footer(footer);
  command->callback(
    [&exitCode]
    {
      if (!isIdleRank())
      {
        printDevices();
      }
      exitCode = Success;
    });
}

} // namespace tipp
