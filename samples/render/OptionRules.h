// Rules of options for which CLI11 has no words, and values that are chosen by name.
#pragma once

#include "CommandLine.h"

#include <CLI/CLI.hpp>

namespace render {

/// A number for which `holds`, or else the rule is named: "must be ...".
CLI::Validator numberThat(const std::string& rule, const std::function<bool(double)>& holds);

template <typename Value>
using Names = std::vector<std::pair<std::string, Value>>;

extern const Names<host::ContextKind> kContextNames;

/// The option takes one of the names, and stores what it stands for.
template <typename Value>
CLI::Option* chooseFrom(const Names<Value>& names, CLI::Option* option) {
  CLI::Transformer toValue(names);
  toValue.description("");
  return option->transform(toValue)->transform(CLI::IsMember(names))->type_name("NAME");
}

/// For addList(): one of these names.
std::function<std::string(const std::string&)> oneOf(const std::string& option, const std::vector<std::string>& names);

/// An option of values that single commas separate, none of them twice; `read` makes each one of its text. "all" stands
/// for the values of `all`, if there are any.
template <typename Value, typename Read>
CLI::Option* addList(CLI::App& app, const std::string& name, std::vector<Value>& list, const Read& read,
                     const std::string& help, const std::vector<Value>& all = {}) {
  const auto readAll = [name, &list, read, all](const std::string& text) {
    list = text == "all" ? all : std::vector<Value>();
    if (!list.empty()) return;
    for (const std::string& part : splitList(name, text))
      list.push_back(read(part));
  };
  return app.add_option_function<std::string>(name, readAll, help)->type_name("LIST");
}

} // namespace render
