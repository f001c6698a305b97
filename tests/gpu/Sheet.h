// The pictures of tyndall-regress on one sheet.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gpu {

struct SheetPlace {
  int row = 0, column = 0; ///< from 1; a place is a triple: wanted, got, difference
};

inline constexpr int kSheetColumns = 3;
SheetPlace placeOnSheet(std::size_t index);

/// A triple for each case, in order. What a case lacks is grey. False, and nothing written, if none has a picture.
/// Throws host::Error.
bool writeSheet(const std::filesystem::path& file, const std::filesystem::path& pictures,
                const std::vector<std::string>& cases);

} // namespace gpu
