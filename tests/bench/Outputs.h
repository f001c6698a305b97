// Results as a terminal table, CSV and JSON.
#pragma once

#include "Analysis.h"

#include <filesystem>

namespace bench {

/// Where and when the results were made.
struct Machine {
  std::string processor;
  int cores = 0;
  std::uint64_t memory = 0; ///< bytes
  std::string system;
  std::string commit;
  std::string date;
};

Machine thisMachine();

void printTable(const std::vector<Result>& results);
void printFloors(const std::vector<Result>& results);
void printCalls(const std::vector<Result>& results);
void printEqualErrors(const std::vector<EqualError>& rows);
void printGrowths(const std::vector<Growth>& rows);

/// Throws host::Error.
void writeCsv(const std::filesystem::path& file, const std::vector<Result>& results);
void writeJson(const std::filesystem::path& file, const Machine& machine, const std::vector<Result>& results);

} // namespace bench
