// Loads scenes on a thread of its own.
#pragma once

#include <atomic>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <scene/Scene.h>
#include <string>
#include <thread>

namespace viewer {

class SceneLoader {
public:
  SceneLoader() = default;
  ~SceneLoader() { cancel(); }
  SceneLoader(const SceneLoader&) = delete;
  SceneLoader& operator=(const SceneLoader&) = delete;

  /// Instead of what is being loaded.
  void start(const std::filesystem::path& file);
  /// Waits for the thread, which ends at the next stage of its work.
  void cancel();

  bool isLoading() const { return thread_.joinable(); }
  bool isDone() const { return isDone_ && thread_.joinable(); } ///< take() has something
  const std::filesystem::path& file() const { return file_; }
  std::string stage() const; ///< what it does
  double share() const { return share_; }

  struct Result {
    std::filesystem::path file;
    std::unique_ptr<host::Scene> scene; ///< null if it failed
    std::string error;                  ///< one line
  };
  /// What came of it, once; none while it is being loaded.
  std::optional<Result> take();

private:
  void run();

  std::thread thread_;
  std::filesystem::path file_;
  std::atomic<bool> isCancelled_ = false, isDone_ = false;
  std::atomic<double> share_ = 0;
  mutable std::mutex mutex_; ///< of the stage
  std::string stage_;
  Result result_;
};

} // namespace viewer
