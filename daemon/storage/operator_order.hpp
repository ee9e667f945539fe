#pragma once

#include <cstdint>

#include "service/operator_log.hpp"

namespace cairn {

/// Something that an operator asked for, as it is journalled.
struct OperatorOrder {
  enum class Kind { kSame, kDifferent, kRetract };

  Kind kind = Kind::kSame;
  VisitId a;  ///< Of kSame and kDifferent.
  VisitId b;
  int assertion = 0;  ///< Number of the one that kRetract takes back.
  Operator by;
  /// Who asked, and which of its requests it was: a request that is repeated is carried out once.
  std::int64_t client_id = 0;
  std::int32_t request_id = 0;
};

}  // namespace cairn
