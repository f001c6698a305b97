#include "Report.h"

#include "Escape.h"
#include "PageAssets.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <scene/FileIo.h>
#include <set>

namespace regress {

namespace {

struct Pictures {
  std::string got, wanted, difference; ///< data: URIs; empty where there is none
};

Pictures picturesOf(const Result& result, const Results& files) {
  constexpr std::uint64_t kMostBytes = 1U << 30;
  const auto uriOf = [&](const char* kind) -> std::string {
    if (std::find(result.pictures.begin(), result.pictures.end(), kind) == result.pictures.end()) return "";
    const std::vector<std::uint8_t> bytes = host::readFile(files.pictureFile(result.name, kind), kMostBytes);
    return "data:image/png;base64," + base64({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  };
  return {uriOf("got"), uriOf("wanted"), uriOf("difference")};
}

std::string percent(double value) { return textOf(value, true); }

std::string figureOf(const std::string& uri, const std::string& title, const std::string& alternative) {
  if (uri.empty()) return "";
  return fmt::format("<figure><figcaption>{}</figcaption><img src=\"{}\" alt=\"{}\"></figure>\n", title, uri,
                     alternative);
}

/// Wanted lies over got, cut where the slider stands.
std::string wipeOf(const Pictures& pictures, const std::string& name) {
  return fmt::format(
      R"(<figure class="wipe"><figcaption><span>wanted</span><span class="hint">drag, or arrow keys</span><span>got</span></figcaption>
<div class="stack"><img src="{1}" alt="{0}, got"><img class="over" src="{2}" alt="{0}, wanted"><span class="edge"></span>
<input type="range" min="0" max="100" value="50" step="0.5" aria-label="{0}: how much of the wanted picture covers the one that was got"></div></figure>
)",
      name, pictures.got, pictures.wanted);
}

std::string legendOf(const Result& result) {
  return fmt::format(R"(difference <span class="scale"><span>&minus;{0}</span><i></i><span>+{0}</span></span>)",
                     percent(result.range));
}

std::string figuresOf(const Result& result, const Results& files) {
  const Pictures pictures = picturesOf(result, files);
  const std::string name = escaped(result.name);
  if (result.isEqual)
    return fmt::format("<div class=\"pictures\">{}</div>", figureOf(pictures.got, "got = wanted", name));
  std::string html = "<div class=\"pictures\">";
  if (!pictures.difference.empty())
    html += wipeOf(pictures, name) + figureOf(pictures.difference, legendOf(result), name + ", difference");
  return html + figureOf(pictures.got, "got", name + ", got") + figureOf(pictures.wanted, "wanted", name + ", wanted") +
         "</div>";
}

std::string measuresOf(const Result& result) {
  if (!result.difference) return "";
  std::string rows;
  for (const Judgement& one : judge(*result.difference, result.tolerance)) {
    const double used = one.limit > 0 ? one.value / one.limit : one.value > 0 ? 1 : 0;
    const char* const kind = one.isKept() ? "kept" : "broken";
    rows += fmt::format("<tr class=\"{0}\"><th scope=\"row\">{1}</th><td>{2}</td><td>{3}</td><td><meter class=\"{0}\" "
                        "min=\"0\" max=\"1\" value=\"{4:.3f}\"></meter></td></tr>\n",
                        kind, one.name, textOf(one.value, one.isRelative), textOf(one.limit, one.isRelative),
                        std::min(used, 1.0));
  }
  return "<table class=\"measures\"><thead><tr><th>difference</th><th>is</th><th>may be</th><th></th></tr></thead>"
         "<tbody>" +
         rows + "</tbody></table>";
}

std::string originText(const Origin& origin) {
  return fmt::format("{}{}{}", escaped(origin.driver),
                     origin.context.empty() ? "" : " (" + escaped(origin.context) + ")",
                     origin.commit.empty() ? "" : ", commit " + escaped(origin.commit));
}

std::string factsOf(const Result& result) {
  std::string words;
  for (const std::string& word : result.words)
    words += (words.empty() ? "" : " ") + word;
  std::string facts = "<dl><dt>options</dt><dd><code>" + (words.empty() ? "none" : escaped(words)) + "</code></dd>";
  if (!result.origin.driver.empty()) facts += "<dt>got from</dt><dd>" + originText(result.origin) + "</dd>";
  if (!result.recorded.driver.empty()) facts += "<dt>wanted from</dt><dd>" + originText(result.recorded) + "</dd>";
  return facts + "</dl>";
}

/// What a line says after the verdict, which stands in a badge.
std::string reasonOf(const Result& result) {
  const std::string summary = summaryOf(result);
  const std::size_t colon = summary.find(": ");
  return result.verdict == Verdict::Failed ? ""
         : colon == std::string::npos      ? escaped(summary)
                                           : escaped(summary.substr(colon + 2));
}

std::string cardOf(const Result& result, const Results& files) {
  std::string notes = result.message.empty() ? "" : "<p class=\"cause\">" + escaped(result.message) + "</p>\n";
  for (const std::string& note : result.notes)
    notes += "<p class=\"note\">" + escaped(note) + "</p>\n";
  return fmt::format(R"(<details class="case {1}" id="{0}"{2}>
<summary><span class="badge {1}">{1}</span><h2>{0}</h2><span class="why">{3}</span></summary>
<div class="body">{4}{5}<div class="facts">{6}{7}</div>
</div></details>
)",
                     escaped(result.name), nameOf(result.verdict), result.verdict == Verdict::Same ? "" : " open",
                     reasonOf(result), notes, figuresOf(result, files), measuresOf(result), factsOf(result));
}

std::string rowOf(const Result& result) {
  const auto cells = [&]() -> std::string {
    if (!result.difference) return "<td colspan=\"5\">" + escaped(result.message) + "</td>";
    const Difference& d = *result.difference;
    return fmt::format("<td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td>", percent(d.rRmse), percent(d.p99),
                       percent(d.max), percent(d.over), textOf(d.flip, false));
  };
  return fmt::format(
      R"(<tr><td><span class="badge {1}">{1}</span></td><th scope="row"><a href="#{0}">{0}</a></th>{2}<td>{3:.1f}&thinsp;s</td></tr>
)",
      escaped(result.name), nameOf(result.verdict), cells(), result.seconds);
}

std::string overviewOf(const std::vector<Result>& results) {
  std::string rows;
  for (const Result& result : results)
    rows += rowOf(result);
  return "<div class=\"wide\"><table class=\"overview\"><thead><tr><th></th><th>case</th><th>rRMSE</th><th>p99</th>"
         "<th>max</th><th>pixels over</th><th>FLIP</th><th>time</th></tr></thead><tbody>" +
         rows + "</tbody></table></div>\n";
}

std::string environmentOf(const std::vector<Result>& results, const std::string& timestamp) {
  std::set<std::string> got, wanted;
  for (const Result& result : results) {
    if (!result.origin.driver.empty()) got.insert(originText(result.origin));
    if (!result.recorded.driver.empty()) wanted.insert(originText(result.recorded));
  }
  const std::string separator = "<br>";
  return fmt::format("<dl class=\"environment\"><dt>checked</dt><dd>{}</dd><dt>got from</dt><dd>{}</dd><dt>wanted "
                     "from</dt><dd>{}</dd></dl>\n",
                     escaped(timestamp), fmt::join(got, separator), fmt::join(wanted, separator));
}

std::string tilesOf(const std::vector<Result>& results) {
  std::string tiles;
  for (const Verdict verdict : {Verdict::Failed, Verdict::Different, Verdict::Same}) {
    const auto count =
        std::count_if(results.begin(), results.end(), [&](const Result& r) { return r.verdict == verdict; });
    tiles += fmt::format("<div class=\"tile {1}{2}\"><b>{0}</b>{1}</div>", count, nameOf(verdict),
                         count == 0 ? " none" : "");
  }
  return "<div class=\"tiles\">" + tiles + "</div>\n";
}

} // namespace

std::string reportPage(std::vector<Result> results, const Results& files, const std::string& list,
                       const std::string& timestamp) {
  std::stable_sort(results.begin(), results.end(),
                   [](const Result& a, const Result& b) { return a.badness() > b.badness(); });
  const auto bad =
      std::count_if(results.begin(), results.end(), [](const Result& r) { return r.verdict != Verdict::Same; });
  const std::string title = bad == 0 ? fmt::format("All {} cases are the same", results.size())
                                     : fmt::format("{} of {} cases are not the same", bad, results.size());
  std::string cards;
  for (const Result& result : results)
    cards += cardOf(result, files);
  return fmt::format(R"({0}
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark"><title>{1}: {2}</title>
<style>{3}</style></head>
<body><main><header><div><p class="list">{2}</p><h1>{1}</h1></div>{4}</header>
{5}{6}{7}</main>
<script>{8}</script></body></html>
)",
                     kReportMark, title, escaped(list), kPageStyle, tilesOf(results), environmentOf(results, timestamp),
                     overviewOf(results), cards, kPageScript);
}

} // namespace regress
