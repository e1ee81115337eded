// SPDX-License-Identifier: BSD-3-Clause
#include "OpenCL/Devices.h"

#include "ExpectAcceleratorError.h"

#include <gtest/gtest.h>

using tipp::chooseDevice;
using tipp::Device;
using tipp::DeviceChoice;
using tipp::DeviceDescription;
using tipp::DeviceType;

namespace
{

DeviceDescription device(int index, const char* name, DeviceType type, bool hasDouble)
{
  DeviceDescription description;
  description.Index = index;
  description.Name = name;
  description.Type = type;
  description.Double = hasDouble;
  return description;
}

std::vector<DeviceDescription> someDevices()
{
  return { device(0, "Small Processor", DeviceType::Cpu, false),
    device(1, "Large Processor", DeviceType::Cpu, true),
    device(2, "Phone GPU", DeviceType::Gpu, false),
    device(3, "Desktop GPU", DeviceType::Gpu, true) };
}

DeviceChoice openCl(int index, const char* name)
{
  DeviceChoice choice;
  choice.Kind = Device::OpenCL;
  choice.Index = index;
  choice.Name = name;
  return choice;
}

int chosen(const DeviceChoice& choice, const std::vector<DeviceDescription>& devices)
{
  const auto found = chooseDevice(choice, devices);
  return found ? found->Index : -1;
}

} // namespace

TEST(DeviceList, AutoTakesTheFirstGpuWithDoublePrecision)
{
  EXPECT_EQ(chosen({}, someDevices()), 3);
}

TEST(DeviceList, AutoIsOpenMPWithoutSuchAGpu)
{
  EXPECT_EQ(chosen({}, {}), -1);
  EXPECT_EQ(chosen({}, { device(0, "Processor", DeviceType::Cpu, true) }), -1);
  EXPECT_EQ(chosen({}, { device(0, "GPU", DeviceType::Gpu, false) }), -1);
}

TEST(DeviceList, OpenMPNeedsNoDevice)
{
  DeviceChoice choice;
  choice.Kind = Device::OpenMP;
  EXPECT_EQ(chosen(choice, someDevices()), -1);
}

TEST(DeviceList, OpenCLPrefersAGpuButAcceptsAnyDeviceWithDoublePrecision)
{
  EXPECT_EQ(chosen(openCl(-1, ""), someDevices()), 3);
  EXPECT_EQ(chosen(openCl(-1, ""), { device(0, "Processor", DeviceType::Cpu, true) }), 0);
}

TEST(DeviceList, ADeviceIsChosenByItsIndex)
{
  EXPECT_EQ(chosen(openCl(1, ""), someDevices()), 1);
}

TEST(DeviceList, ADeviceIsChosenByAPartOfItsNameInAnyCase)
{
  EXPECT_EQ(chosen(openCl(-1, "large proc"), someDevices()), 1);
  EXPECT_EQ(chosen(openCl(-1, "DESKTOP"), someDevices()), 3);
}

TEST(DeviceList, ADeviceIsChosenByAPartOfItsPlatformsNameIfNoDeviceHasThatName)
{
  std::vector<DeviceDescription> devices = someDevices();
  devices[1].Platform = "Intel(R) OpenCL";
  devices[3].Platform = "Portable Computing Language";
  EXPECT_EQ(chosen(openCl(-1, "intel"), devices), 1);
  EXPECT_EQ(chosen(openCl(-1, "portable"), devices), 3);
  devices[3].Name = "Intel(R) Arc";
  EXPECT_EQ(chosen(openCl(-1, "intel"), devices), 3);
}

TEST(DeviceList, OfEqualNamesTheFirstDeviceWithDoublePrecisionIsChosen)
{
  EXPECT_EQ(chosen(openCl(-1, "processor"), someDevices()), 1);
  EXPECT_EQ(chosen(openCl(-1, "gpu"), someDevices()), 3);
}

TEST(DeviceList, AMissingDeviceIsAnErrorThatNamesTheOthers)
{
  expectAcceleratorError([] { chooseDevice(openCl(4, ""), someDevices()); },
    "There is no OpenCL device 4; there are: 0 'Small Processor', 1 'Large Processor'");
  expectAcceleratorError([] { chooseDevice(openCl(-1, "Quantum"), someDevices()); },
    "There is no OpenCL device named 'Quantum'; there are: 0 'Small Processor'");
  std::vector<DeviceDescription> devices = someDevices();
  devices[0].Platform = "Intel(R) OpenCL";
  expectAcceleratorError([&] { chooseDevice(openCl(-1, "Quantum"), devices); },
    "there are: 0 'Small Processor' of 'Intel(R) OpenCL', 1");
}

TEST(DeviceList, ADeviceWithoutDoublePrecisionIsAnError)
{
  expectAcceleratorError(
    [] { chooseDevice(openCl(2, ""), someDevices()); }, "'Phone GPU' has no double precision");
  expectAcceleratorError([]
    { chooseDevice(openCl(-1, ""), { device(0, "Toy", DeviceType::Cpu, false) }); },
    "'Toy' has no double precision");
}

TEST(DeviceList, AMachineWithoutDevicesIsAnErrorThatSaysWhatToInstall)
{
  expectAcceleratorError(
    [] { chooseDevice(openCl(-1, ""), {}); }, "This machine has no OpenCL device");
  expectAcceleratorError([] { chooseDevice(openCl(-1, "intel"), {}); },
    "There is no OpenCL device named 'intel'. This machine has no OpenCL device");
  EXPECT_THROW(chooseDevice(openCl(0, ""), {}), tipp::UnknownDevice);
}

TEST(DeviceList, ChoicesAreTheUsableDevices)
{
  EXPECT_EQ(tipp::deviceChoices(someDevices()),
    (std::vector<std::string>{ "auto", "openmp", "opencl:Large Processor", "opencl:Desktop GPU" }));
}

TEST(DeviceList, ChoicesDistinguishDevicesOfEqualNames)
{
  const std::vector<DeviceDescription> twins = { device(0, "GPU", DeviceType::Gpu, true),
    device(1, "GPU", DeviceType::Gpu, true), device(2, "7", DeviceType::Cpu, true) };
  const std::vector<std::string> choices = tipp::deviceChoices(twins);
  ASSERT_EQ(choices.size(), 5u);
  for (int i = 0; i < 3; ++i)
  {
    EXPECT_EQ(chosen(tipp::parseDeviceChoice(choices[i + 2]), twins), i);
  }
}
