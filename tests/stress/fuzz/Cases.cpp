// Lists of cases of tyndall-regress, and the pattern that chooses among them: what stands before the first zero byte.
#include "Fuzz.h"
#include "regress/CaseList.h"

#include <algorithm>
#include <scene/Error.h>
#include <set>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto* zero = std::find(data, data + size, std::uint8_t{0});
  const bool hasPattern = zero != data + size;
  const std::string pattern = hasPattern ? std::string(data, zero) : "*";
  const std::uint8_t* text = hasPattern ? zero + 1 : data;
  const std::filesystem::path file = fuzz::fileOf("cases.json", text, static_cast<std::size_t>(data + size - text));
  fuzz::accepts<std::runtime_error>([&] {
    std::vector<regress::Case> cases;
    if (!fuzz::accepts<host::Error>([&] { cases = regress::readCases(file, "scenes"); })) return;
    std::set<std::string> names;
    for (const regress::Case& one : cases) {
      fuzz::require(names.insert(one.name).second, "names are unique");
      fuzz::require(!one.options.scene.empty() && one.options.out.empty(), "a case has a scene, and no output");
      fuzz::require(one.tolerance.rRmse >= 0 && one.tolerance.p99 >= 0, "tolerances are not negative");
    }
    for (const regress::Case& one : regress::shareOf(cases, {1, 2}))
      fuzz::require(names.count(one.name) == 1, "a share is of the list");
    fuzz::accepts<render::UsageError>([&] { regress::only(cases, pattern); });
  });
  return 0;
}
