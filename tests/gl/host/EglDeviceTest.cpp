// Which of EGL's devices contexts are made on.
#include "gl/Context.h"
#include "gl/Driver.h"
#include "gl/EglDevices.h"
#include "scene/Error.h"
#include "support/Catch.h"

using host::devicesToTry;
using host::EglDevice;
using Numbers = std::vector<std::size_t>;

TEST_CASE("a software device is tried only where no other gives a context, wherever it is in the list",
          "[context][once]") {
  const EglDevice software{"software, llvmpipe", true}, one{"NVIDIA H100, /dev/dri/card0", false},
      other{"/dev/dri/card1", false};
  CHECK(devicesToTry({}, "").empty());
  CHECK(devicesToTry({software}, "").empty());
  CHECK(devicesToTry({software, one}, "") == Numbers{1});
  CHECK(devicesToTry({one, software, other}, "") == Numbers{0, 2});
}

TEST_CASE("a device is chosen by its number or a part of its name, and one that is not there is refused",
          "[context][once]") {
  const std::vector<EglDevice> devices = {
      {"software, llvmpipe", true}, {"NVIDIA H100, /dev/dri/card0", false}, {"NVIDIA H100, /dev/dri/card1", false}};
  CHECK(devicesToTry(devices, "0") == Numbers{0});
  CHECK(devicesToTry(devices, "2") == Numbers{2});
  CHECK(devicesToTry(devices, "software") == Numbers{0});
  CHECK(devicesToTry(devices, "NVIDIA") == Numbers{1});
  CHECK(devicesToTry(devices, "card1") == Numbers{2});
  for (const char* wanted : {"3", "-1", "Radeon"}) {
    try {
      devicesToTry(devices, wanted);
      FAIL_CHECK(wanted << " is no device");
    } catch (const host::Error& error) {
      CHECK(std::string(error.what()) ==
            "context egl: TYNDALL_EGL_DEVICE=" + std::string(wanted) +
                ": must be the number or a part of the name of one of EGL's devices: 0: software, llvmpipe, 1: NVIDIA "
                "H100, /dev/dri/card0, 2: NVIDIA H100, /dev/dri/card1");
    }
  }
  CHECK_THROWS_AS(devicesToTry({}, "0"), host::Error);
}

TEST_CASE("EGL's devices have names, and the driver is software exactly where its device is", "[context][once]") {
  const std::vector<EglDevice> devices = host::eglDevices();
  const auto context = host::Context::create(host::ContextKind::Egl);
  const std::string used = host::eglDisplayInUse();
  INFO(context->driver() << " on " << used << " of " << host::listOf(devices));
  CHECK_FALSE(used.empty());
  for (std::size_t i = 0; i < devices.size(); ++i) {
    CHECK_FALSE(devices[i].name.empty());
    if (used.rfind("device " + std::to_string(i) + ":", 0) == 0)
      CHECK(host::isSoftware(context->driver()) == devices[i].isSoftware);
  }
}
