#include "bench/lab/text.hpp"

#include <filesystem>
#include <system_error>

#include "clients/common/failure.hpp"

namespace cairn::lab {

std::string grouped(std::int64_t number) {
  std::string digits = std::to_string(number);
  const std::size_t sign = number < 0 ? 1 : 0;
  for (std::size_t end = digits.size(); end > sign + 3; end -= 3) {
    digits.insert(end - 3, 1, ',');
  }
  return digits;
}

void check_outputs(const std::vector<std::string>& inputs,
                   const std::vector<std::string>& outputs) {
  const auto is_same = [](const std::string& a, const std::string& b) {
    std::error_code unknown;
    return a == b || std::filesystem::equivalent(a, b, unknown);
  };
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const std::filesystem::path folder = std::filesystem::path(outputs[i]).parent_path();
    if (!folder.empty() && !std::filesystem::is_directory(folder)) {
      throw clients::Failure(clients::ExitCode::kCannotCreate,
                             outputs[i] + ": there is no folder " + folder.string());
    }
    for (const std::string& input : inputs) {
      if (!outputs[i].empty() && !input.empty() && is_same(outputs[i], input)) {
        throw clients::Failure(clients::ExitCode::kUsage,
                               outputs[i] + " is read: choose another name to write to");
      }
    }
    for (std::size_t k = 0; k < i; ++k) {
      if (!outputs[i].empty() && is_same(outputs[i], outputs[k])) {
        throw clients::Failure(clients::ExitCode::kUsage,
                               outputs[i] + " is to be written twice: choose two names");
      }
    }
  }
}

}  // namespace cairn::lab
