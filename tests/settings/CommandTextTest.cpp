// States as commands: tyndall-render reads the same state from them.
#include "RandomState.h"
#include "render/Options.h"
#include "support/Catch.h"

#include <settings/CommandText.h>

namespace {

/// What a shell makes of single quotes.
std::vector<std::string> wordsOf(const std::string& command) {
  std::vector<std::string> words(1);
  bool isQuoted = false, isEscaped = false;
  for (const char c : command) {
    if (isEscaped || (isQuoted && c != '\'')) {
      words.back() += c;
      isEscaped = false;
    } else if (c == '\'') {
      isQuoted = !isQuoted;
    } else if (c == '\\') {
      isEscaped = true;
    } else if (c == ' ') {
      words.emplace_back();
    } else {
      words.back() += c;
    }
  }
  return words;
}

render::Options parsed(const std::string& command) {
  const std::vector<std::string> words = wordsOf(command);
  std::vector<const char*> arguments;
  for (const std::string& word : words)
    arguments.push_back(word.c_str());
  return render::parseOptions(static_cast<int>(arguments.size()), arguments.data());
}

} // namespace

TEST_CASE("a state's command has tyndall-render begin with the same state") {
  for (unsigned seed = 0; seed < 200; ++seed) {
    settings::State state = tests::randomState(seed);
    state.compared.reset(); // which tyndall-render leaves alone
    state.path.clear();
    const std::string command = settings::commandOf(state);
    CAPTURE(seed, command);
    std::vector<std::string> different = tests::differences(state, parsed(command));
    CHECK(different == std::vector<std::string>());
  }
}

TEST_CASE("a state's command tells only what is not at its default") {
  settings::State state;
  state.scene = "nave.glb";
  CHECK(settings::commandOf(state) == "tyndall-render nave.glb --size 1280x720 --out picture.png");
  state.profile = tyndall::Profile::Performance;
  state.settings = tyndall::settingsOf(state.profile);
  state.settings.breakThreshold = 0.3F;
  state.exposureStops = -2;
  state.avsm = false;
  CHECK(settings::commandOf(state) ==
        "tyndall-render nave.glb --size 1280x720 --profile performance --exposure=-2 --no-avsm "
        "--break-threshold 0.3 --out picture.png");
}

TEST_CASE("words are quoted for a shell where they must be") {
  CHECK(settings::quoted("build/scenes/nave.glb") == "build/scenes/nave.glb");
  CHECK(settings::quoted("") == "''");
  CHECK(settings::quoted("it's $HOME") == "'it'\\''s $HOME'");
}
