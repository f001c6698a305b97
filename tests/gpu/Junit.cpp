#include "Junit.h"

#include <regress/Escape.h>

namespace gpu {

namespace {

/// The texts between `<name ...>` and `</name>`.
std::vector<std::string> elementsOf(const std::string& xml, const std::string& name) {
  std::vector<std::string> texts;
  std::size_t at = 0;
  while ((at = xml.find("<" + name, at)) != std::string::npos) {
    const char next = xml[at + name.size() + 1];
    const std::size_t begin = xml.find('>', at);
    if (begin == std::string::npos) break;
    at = begin + 1;
    if (next != ' ' && next != '>' && next != '\n') continue; // another name that begins so
    if (xml[begin - 1] == '/') continue;
    const std::size_t end = xml.find("</" + name + ">", at);
    if (end == std::string::npos) break;
    texts.push_back(xml.substr(at, end - at));
    at = end;
  }
  return texts;
}

std::string unescaped(std::string text) {
  const std::pair<const char*, const char*> entities[] = {
      {"&lt;", "<"}, {"&gt;", ">"}, {"&quot;", "\""}, {"&amp;", "&"}};
  for (const auto& [entity, character] : entities)
    for (std::size_t at = 0; (at = text.find(entity, at)) != std::string::npos; ++at)
      text.replace(at, std::string(entity).size(), character);
  return text;
}

} // namespace

std::string failuresIn(const std::string& xml) {
  std::string all;
  for (const char* name : {"failure", "error"})
    for (const std::string& text : elementsOf(xml, name))
      all += unescaped(text) + "\n";
  return all;
}

std::string joinedJunit(const std::vector<std::string>& documents) {
  std::string suites;
  for (const std::string& document : documents) {
    const std::size_t begin = document.find("<testsuite "), end = document.rfind("</testsuite>");
    if (begin == std::string::npos || end == std::string::npos) continue;
    suites += document.substr(begin, end + std::string("</testsuite>").size() - begin) + "\n";
  }
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n" + suites + "</testsuites>\n";
}

std::string suiteOf(const std::string& name, const std::string& result, const std::string& message) {
  const bool isSkipped = result == "skipped";
  return std::string("<testsuite name=\"") + (isSkipped ? "skipped" : "ended") +
         "\" tests=\"1\" failures=\"0\" errors=\"" + (isSkipped ? "0" : "1") + "\"><testcase name=\"" +
         regress::escaped(name) + "\"><" + (isSkipped ? "skipped" : "error") + " message=\"" +
         regress::escaped(message) + "\"/></testcase></testsuite>";
}

} // namespace gpu
