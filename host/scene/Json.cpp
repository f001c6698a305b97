#include "Json.h"

namespace host {

namespace {

/// Counts values and levels without keeping any; ends at the first bound.
class Bounds : public nlohmann::json_sax<nlohmann::json> {
public:
  bool null() override { return value(); }
  bool boolean(bool) override { return value(); }
  bool number_integer(number_integer_t) override { return value(); }
  bool number_unsigned(number_unsigned_t) override { return value(); }
  bool number_float(number_float_t, const string_t&) override { return value(); }
  bool string(string_t&) override { return value(); }
  bool binary(binary_t&) override { return value(); }
  bool key(string_t&) override { return true; }
  bool start_object(std::size_t) override { return enter(); }
  bool start_array(std::size_t) override { return enter(); }
  bool end_object() override { return leave(); }
  bool end_array() override { return leave(); }
  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) override { return false; }

  std::string excess;

private:
  bool value() {
    if (++values_ <= kMaxJsonValues) return true;
    excess = "holds more than " + std::to_string(kMaxJsonValues) + " values";
    return false;
  }
  bool enter() {
    if (++depth_ <= kMaxJsonDepth) return value();
    excess = "nested deeper than " + std::to_string(kMaxJsonDepth) + " levels";
    return false;
  }
  bool leave() {
    --depth_;
    return true;
  }

  std::size_t values_ = 0;
  int depth_ = 0;
};

} // namespace

std::string excessOfJson(std::string_view text, bool mayHaveComments) {
  Bounds bounds;
  nlohmann::json::sax_parse(text.begin(), text.end(), &bounds, nlohmann::json::input_format_t::json, true,
                            mayHaveComments);
  return bounds.excess;
}

} // namespace host
