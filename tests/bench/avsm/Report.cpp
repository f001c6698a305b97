#include "Report.h"

#include <fmt/format.h>
#include <scene/FileIo.h>
#include <scene/Tool.h>

namespace avsmbench {

void printMarkdown(const std::vector<Row>& rows) {
  host::print(fmt::format(
      "| scene | method | error | KiB | build ms | look-up ms | own filter ms | of baseline | own of baseline |\n"
      "|---|---|---|---|---|---|---|---|---|\n"));
  for (const Row& row : rows)
    host::print(fmt::format("| {} | {} | {:.3f} % | {} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.2f} |\n", row.scene,
                            row.method, 100 * row.error, row.bytes / 1024, row.build, row.lookUp, row.ownLookUp,
                            row.ratio, row.ownRatio));
}

void writeCsv(const std::string& path, const std::vector<Row>& rows) {
  std::string text = "scene,method,error,bytes,list_bytes,build_ms,look_up_ms,own_look_up_ms,ratio,own_ratio\n";
  for (const Row& row : rows)
    text += fmt::format("{},{},{:.6g},{},{},{:.4g},{:.4g},{:.4g},{:.4g},{:.4g}\n", row.scene, row.method, row.error,
                        row.bytes, row.listBytes, row.build, row.lookUp, row.ownLookUp, row.ratio, row.ownRatio);
  host::writeText(path, text);
}

} // namespace avsmbench
