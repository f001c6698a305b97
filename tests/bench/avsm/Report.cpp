#include "Report.h"

#include <fmt/format.h>
#include <fstream>
#include <scene/Error.h>

namespace avsmbench {

void printMarkdown(const std::vector<Row>& rows) {
  fmt::print(
      "| scene | method | error | KiB | build ms | look-up ms | own filter ms | of baseline | own of baseline |\n"
      "|---|---|---|---|---|---|---|---|---|\n");
  for (const Row& row : rows)
    fmt::print("| {} | {} | {:.3f} % | {} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.2f} |\n", row.scene, row.method,
               100 * row.error, row.bytes / 1024, row.build, row.lookUp, row.ownLookUp, row.ratio, row.ownRatio);
}

void writeCsv(const std::string& path, const std::vector<Row>& rows) {
  std::ofstream file(path);
  file << "scene,method,error,bytes,list_bytes,build_ms,look_up_ms,own_look_up_ms,ratio,own_ratio\n";
  for (const Row& row : rows)
    file << fmt::format("{},{},{:.6g},{},{},{:.4g},{:.4g},{:.4g},{:.4g},{:.4g}\n", row.scene, row.method, row.error,
                        row.bytes, row.listBytes, row.build, row.lookUp, row.ownLookUp, row.ratio, row.ownRatio);
  if (!file.flush()) throw host::Error(path + ": cannot be written");
}

} // namespace avsmbench
