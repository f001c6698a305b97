// The devices that EGL lists, and which of them contexts are made on: the GPU where one can be opened, and no software
// driver that happens to be listed first.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace host {

/// Names the device that contexts are to be made on: its number in the list, from 0, or a part of its name.
inline constexpr const char* kEglDeviceVariable = "TYNDALL_EGL_DEVICE";

struct EglDevice {
  std::string name; ///< what it says of itself: renderer, vendor, device file
  bool isSoftware = false;
};

/// In the order of libEGL, which may list none. Throws host::Error if it cannot be opened.
std::vector<EglDevice> eglDevices();

/// What contexts are made on: "device 1: NAME", "surfaceless" or "default display". Opens it if it is not open yet.
std::string eglDisplayInUse();

/// "0: NAME, 1: NAME", for people.
std::string listOf(const std::vector<EglDevice>& devices);

/// The devices to try, one after the other: the one that `wanted` names, as kEglDeviceVariable's value, or if it is
/// empty all that are not software. Throws host::Error if it names none.
std::vector<std::size_t> devicesToTry(const std::vector<EglDevice>& devices, const std::string& wanted);

} // namespace host
