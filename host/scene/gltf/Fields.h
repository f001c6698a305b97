// Typed access to the members of one JSON object, with the path for messages. A member of the wrong type is refused.
#pragma once

#include "Document.h"

#include <initializer_list>
#include <limits>
#include <optional>

namespace host::gltf {

enum class Need { Optional, Required };

class Fields {
public:
  Fields(Document& document, nlohmann::json& object, std::string path);

  bool has(const char* key) const { return object_.contains(key); }
  std::string path(const char* key) const { return path_.empty() ? key : path_ + "." + key; }
  const std::string& path() const { return path_; }

  /// A whole number in [low, high]; 3.0 counts as one and is rewritten as 3.
  std::optional<std::int64_t> integer(const char* key, std::int64_t low, std::int64_t high, Need need = Need::Optional);

  /// An index into the root array `collection`.
  std::optional<std::int64_t> index(const char* key, const char* collection, Need need = Need::Optional);

  /// An array of indices into `collection`, none twice.
  void indices(const char* key, const char* collection);

  std::optional<double> number(const char* key, Need need = Need::Optional);
  /// The same of fields that must be there.
  std::int64_t requiredInteger(const char* key, std::int64_t low, std::int64_t high);
  std::int64_t requiredIndex(const char* key, const char* collection);
  void numbers(const char* key, std::size_t length);
  void boolean(const char* key);

  /// A string; if `allowed` is not empty, one of these.
  std::string string(const char* key, Need need, std::initializer_list<const char*> allowed = {});

  /// An object or an array; null if absent.
  nlohmann::json* object(const char* key, Need need = Need::Optional);
  nlohmann::json* array(const char* key, Need need = Need::Optional);

  /// Runs check(Fields) on each element of an array of objects.
  template <typename Check>
  void each(const char* key, Need need, Check check) {
    nlohmann::json* list = array(key, need);
    if (list == nullptr) return;
    for (std::size_t i = 0; i < list->size(); ++i) {
      check(Fields(document_, (*list)[i], at(path(key), i)));
    }
  }

  [[noreturn]] void refuse(const char* key, const std::string& rule) const { document_.refuse(path(key), rule); }
  Document& document() const { return document_; }
  nlohmann::json& value() const { return object_; }

private:
  nlohmann::json* find(const char* key, Need need) const;

  Document& document_;
  nlohmann::json& object_;
  std::string path_;
};

} // namespace host::gltf
