#include "support/FailureReport.h"

#define CATCH_CONFIG_EXTERNAL_INTERFACES
#include "support/Catch.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <optional>
#include <reference/Metrics.h>
#include <scene/ImageFile.h>
#include <string>
#include <utility>

namespace tests {

namespace {

namespace fs = std::filesystem;

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

/// What makes a context: it stands before the command and in the folder's name.
const char* const kContextVariables[] = {"TYNDALL_TEST_CONTEXT", "TYNDALL_TEST_PROFILE", "MESA_GL_VERSION_OVERRIDE",
                                         "MESA_GLSL_VERSION_OVERRIDE", "GALLIUM_DRIVER"};

/// Quoted for a shell.
std::string quoted(const std::string& word) {
  std::string result = "'";
  for (const char c : word)
    result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

/// A case's name as Catch takes it on the command line, where some characters select by more than a name.
std::string escaped(const std::string& name) {
  std::string result = name.rfind('-', 0) == 0 ? "\\" : ""; // or it would be an option
  for (const char c : name) {
    if (std::string("[],\\").find(c) != std::string::npos) result += '\\';
    result += c;
  }
  return result;
}

std::string commandOf(const std::string& name) {
  std::string result;
  for (const char* variable : kContextVariables)
    if (const std::string value = environment(variable); !value.empty())
      result += std::string(variable) + "=" + quoted(value) + " ";
  // A window needs the server that this run may have had to itself.
  if (environment("TYNDALL_TEST_CONTEXT") == "glfw") result += "xvfb-run -a ";
  std::error_code error;
  return result + quoted(fs::read_symlink("/proc/self/exe", error).string()) + " " + quoted(escaped(name));
}

fs::path folderOf(const std::string& name) {
  std::string file;
  for (const char* variable : kContextVariables)
    if (const std::string value = environment(variable); !value.empty()) file += value + "-";
  for (const char c : name)
    file += std::isalnum(static_cast<unsigned char>(c)) ? c : '-';
  const std::string root = environment("TYNDALL_FAILED_DIR");
  return fs::path(root.empty() ? TYNDALL_FAILED_DIR : root) / file.substr(0, 120);
}

/// Numbers of any size, shown as colours: 1 is `white`. What is not finite is magenta.
void writePicture(const fs::path& file, const reference::Image& image, double white) {
  std::vector<float> rgb(image.rgb.size());
  for (std::size_t i = 0; i < rgb.size(); ++i)
    rgb[i] = static_cast<float>(image.rgb[i] / white);
  for (std::size_t i = 0; i + 2 < rgb.size(); i += 3)
    if (!std::isfinite(rgb[i] + rgb[i + 1] + rgb[i + 2])) rgb[i] = rgb[i + 2] = 1, rgb[i + 1] = 0;
  std::vector<float> fromTop(rgb.size());
  const std::size_t row = 3 * static_cast<std::size_t>(image.width);
  for (std::size_t y = 0; y < static_cast<std::size_t>(image.height); ++y)
    std::copy_n(rgb.begin() + static_cast<std::ptrdiff_t>(y * row), row,
                fromTop.end() - static_cast<std::ptrdiff_t>((y + 1) * row));
  host::writePng(file, image.width, image.height, host::encodeColours(fromTop.data(), image.width, image.height));
}

double largestFinite(const reference::Image& image) {
  double result = 0;
  for (const double value : image.rgb)
    if (std::isfinite(value)) result = std::max(result, std::abs(value));
  return result > 0 ? result : 1;
}

class Pictures {
public:
  void keep(const reference::Image& got, const reference::Image& wanted) { pair_ = {got, wanted}; }
  void forget() { pair_.reset(); }

  /// Writes what was kept; false if there is nothing, or nothing of a picture's form.
  bool write(const fs::path& folder, int number) {
    if (!pair_ || !isPicture(pair_->first) || !isPicture(pair_->second)) return false;
    const auto& [got, wanted] = *pair_;
    fs::create_directories(folder);
    const std::string start = (folder / std::to_string(number)).string();
    const double white = std::max(largestFinite(got), largestFinite(wanted));
    writePicture(start + "-got.png", got, white);
    writePicture(start + "-wanted.png", wanted, white);
    if (got.rgb.size() == wanted.rgb.size()) {
      const reference::Image difference = reference::differenceImage(got, wanted);
      writePicture(start + "-difference.png", difference, largestFinite(difference));
    }
    forget();
    return true;
  }

private:
  static bool isPicture(const reference::Image& image) {
    return image.width > 0 && image.height > 0 &&
           image.rgb.size() == reference::Image(image.width, image.height).rgb.size();
  }

  std::optional<std::pair<reference::Image, reference::Image>> pair_;
};

Pictures thePictures;

class FailureListener : public Catch::TestEventListenerBase {
public:
  using Catch::TestEventListenerBase::TestEventListenerBase;

  void testCaseStarting(const Catch::TestCaseInfo& info) override {
    folder_ = folderOf(info.name);
    written_ = 0;
    thePictures.forget();
    std::error_code error;
    fs::remove_all(folder_, error);
  }

  Catch::AssertionEnded assertionEnded(const Catch::AssertionStats& stats) override {
    if (!stats.assertionResult.isOk()) keepPictures();
    return Catch::AssertionEnded();
  }

  void testCaseEnded(const Catch::TestCaseStats& stats) override {
    if (stats.totals.assertions.failed == 0) return;
    std::cout << "run it alone: " << commandOf(Catch::nameOf(stats)) << "\n";
    if (written_ > 0) std::cout << "pictures it compared last before each failure: " << folder_.string() << "\n";
    std::cout.flush();
  }

private:
  void keepPictures() {
    constexpr int kEnough = 10;
    if (written_ >= kEnough) return;
    try {
      if (thePictures.write(folder_, written_ + 1)) ++written_;
    } catch (const std::exception& error) {
      std::cout << "the pictures of this failure could not be written: " << error.what() << "\n";
    }
  }

  fs::path folder_;
  int written_ = 0;
};

CATCH_REGISTER_LISTENER(FailureListener)

} // namespace

void reportFailures() {
  reference::setComparisonWatch(
      [](const reference::Image& got, const reference::Image& wanted) { thePictures.keep(got, wanted); });
}

} // namespace tests
