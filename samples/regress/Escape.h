// Text inside XML and HTML.
#pragma once

#include <string>
#include <string_view>

namespace regress {

/// Of any bytes makes text that XML allows: markup escaped, what is no UTF-8 and control characters replaced by ?.
std::string escaped(std::string_view text);

/// Base64 of bytes, for data: URIs.
std::string base64(std::string_view bytes);

} // namespace regress
