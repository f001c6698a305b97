// Command lines: a word a line. The first byte says of which tool.
#include "regress/Arguments.h"
#include "Fuzz.h"
#include "bench/Options.h"
#include "render/Options.h"

#include <scene/Error.h>

namespace {

using Parse = void (*)(int argc, const char* const* argv);

void parseRender(int argc, const char* const* argv) {
  const render::Options options = render::parseOptions(argc, argv);
  fuzz::require(!options.scene.empty(), "there is a scene");
  fuzz::require(settings::renderedWidth(options) >= 1 && settings::renderedWidth(options) <= tyndall::kMaxImageSize &&
                    settings::renderedHeight(options) >= 1 &&
                    settings::renderedHeight(options) <= tyndall::kMaxImageSize,
                "the picture has a size");
  const std::string problem = settings::problemIn(options);
  fuzz::require(problem.empty(), "options keep the rules of states: " + problem);
  fuzz::require(options.out.size() <= 2, "there are two outputs at most");
  if (options.frames && options.frames->count() < 1000) render::framesOf(options);
}

void parseRegress(int argc, const char* const* argv) { regress::parseCommand(argc, argv); }

void parseBench(int argc, const char* const* argv) { bench::parseOptions(argc, argv); }

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  constexpr Parse kParsers[] = {parseRender, parseRegress, parseBench};
  const Parse parse = kParsers[data[0] % std::size(kParsers)];
  std::vector<std::string> words = {"tool"};
  const std::string text = fuzz::textOf(data + 1, size - 1);
  for (const std::string& word : render::split(text, '\n'))
    words.emplace_back(word.c_str()); // which ends at a zero byte, as arguments do
  std::vector<const char*> arguments;
  for (const std::string& word : words)
    arguments.push_back(word.c_str());
  arguments.push_back(nullptr);
  fuzz::accepts<host::Error>([&] {
    fuzz::accepts<render::UsageError>([&] {
      try {
        parse(static_cast<int>(words.size()), arguments.data());
      } catch (const render::Answer& answer) {
        fuzz::require(!answer.text.empty(), "who asks for help is answered");
      }
    });
  });
  return 0;
}
