#include "SceneLoader.h"

#include <exception>
#include <scene/FileIo.h>
#include <scene/GltfLoader.h>

namespace viewer {

namespace {

struct Cancelled {};

} // namespace

void SceneLoader::start(const std::filesystem::path& file) {
  cancel();
  file_ = file;
  isCancelled_ = isDone_ = false;
  share_ = 0;
  stage_ = "file";
  result_ = {file, nullptr, {}};
  thread_ = std::thread([this] { run(); });
}

void SceneLoader::cancel() {
  isCancelled_ = true;
  if (thread_.joinable()) thread_.join();
  result_ = {};
}

std::string SceneLoader::stage() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return stage_;
}

void SceneLoader::run() {
  const auto watch = [this](const char* stage, double share) {
    if (isCancelled_) throw Cancelled();
    share_ = share;
    const std::lock_guard<std::mutex> lock(mutex_);
    stage_ = stage;
  };
  try {
    result_.scene = std::make_unique<host::Scene>(host::loadScene(file_, watch));
  } catch (const Cancelled&) {
    result_.error = "cancelled";
  } catch (const std::exception& error) {
    result_.error = error.what();
  }
  isDone_ = true;
}

std::optional<SceneLoader::Result> SceneLoader::take() {
  if (!isDone_ || !thread_.joinable()) return std::nullopt;
  thread_.join();
  return std::move(result_);
}

} // namespace viewer
