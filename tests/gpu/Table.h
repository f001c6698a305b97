// Tables of Markdown.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace gpu {

class Table {
public:
  explicit Table(std::vector<std::string> columns) : columns_(std::move(columns)) {}

  void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }
  bool empty() const { return rows_.empty(); }

  std::string text() const {
    std::string text = lineOf(columns_) + "|";
    for (std::size_t i = 0; i < columns_.size(); ++i)
      text += "---|";
    text += "\n";
    for (const std::vector<std::string>& row : rows_)
      text += lineOf(row);
    return text + "\n";
  }

private:
  static std::string lineOf(const std::vector<std::string>& cells) {
    std::string line = "|";
    for (const std::string& cell : cells) {
      line += " ";
      for (const char c : cell)
        line += c == '|' ? std::string("\\|") : c == '\n' ? std::string(" ") : std::string(1, c);
      line += " |";
    }
    return line + "\n";
  }

  std::vector<std::string> columns_;
  std::vector<std::vector<std::string>> rows_;
};

} // namespace gpu
