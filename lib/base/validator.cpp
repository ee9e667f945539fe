#include "base/validator.hpp"

#include <array>
#include <cmath>
#include <cstdio>

namespace cairn {
namespace {

std::string text_of(double value) {
  std::array<char, 32> text{};
  static_cast<void>(std::snprintf(text.data(), text.size(), "%.10g", value));
  return text.data();
}

}  // namespace

Validator& Validator::within(std::string_view field, double value, double low, double high) {
  if (!(value >= low && value <= high)) {
    complain(field, "be in [" + text_of(low) + ", " + text_of(high) + "], is " + text_of(value));
  }
  return *this;
}

Validator& Validator::positive(std::string_view field, double value) {
  if (!(value > 0.0 && std::isfinite(value))) {
    complain(field, "be > 0, is " + text_of(value));
  }
  return *this;
}

Validator& Validator::require(std::string_view field, bool holds, std::string_view rule) {
  if (!holds) {
    complain(field, std::string(rule));
  }
  return *this;
}

Status Validator::status() const {
  if (complaints_.empty()) {
    return {};
  }
  return Error{ErrorCode::kInvalidValue, complaints_};
}

void Validator::complain(std::string_view field, const std::string& rule_and_value) {
  if (!complaints_.empty()) {
    complaints_ += "; ";
  }
  complaints_ += object_ + "." + std::string(field) + " must " + rule_and_value;
}

}  // namespace cairn
