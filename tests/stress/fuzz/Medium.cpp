// Medium files, those of tyndall-render and the part of a state. What is accepted keeps the effect's rules, and is what
// it was once it has been written and read back.
#include "CheckFrame.h"
#include "Fuzz.h"

#include <scene/Error.h>
#include <scene/MediumFile.h>
#include <settings/StateFile.h>

namespace {

void requireRules(const tyndall::Medium& medium) {
  tyndall::Frame frame;
  frame.viewport = {0, 0, 16, 16};
  frame.colour = 1;
  frame.camera.clipFromView = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, -1, 0, 0, -2, 0};
  frame.medium = medium;
  const tyndall::Status status = tyndall::checkValues(frame);
  // Which no field can tell by itself.
  const bool isOfRange = status.message.find("32-bit floats, relative to the eye") != std::string::npos;
  fuzz::require(status || isOfRange, "the effect takes the medium: " + status.message);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::filesystem::path file = fuzz::fileOf("medium.json", data, size);
  fuzz::accepts<host::Error>([&] { requireRules(host::loadMedium(file)); });
  fuzz::accepts<host::Error>([&] {
    const tyndall::Medium medium = settings::parseMedium(fuzz::textOf(data, size), "--medium");
    requireRules(medium);
    const std::string text = settings::textOf(medium);
    fuzz::require(settings::textOf(settings::parseMedium(text, "--medium")) == text, "a medium is read back: " + text);
  });
  return 0;
}
