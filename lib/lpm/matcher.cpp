#include "lpm/matcher.hpp"

namespace cairn {

std::string_view to_string(MatcherKind kind) {
  return kind == MatcherKind::kParticles ? "particles" : "correlative";
}

std::optional<MatcherKind> matcher_kind_of(std::string_view name) {
  for (const MatcherKind kind : {MatcherKind::kCorrelative, MatcherKind::kParticles}) {
    if (name == to_string(kind)) {
      return kind;
    }
  }
  return std::nullopt;
}

Matcher::Matcher(MatcherKind kind,
                 const ScanMatchOptions& options,
                 const ParticleOptions& particles)
    : matcher_(ScanMatcher(options)) {
  if (kind == MatcherKind::kParticles) {
    matcher_.emplace<ParticleMatcher>(options, particles);
  }
}

void Matcher::take(const ScanBeams& beams) {
  std::visit([&beams](auto& matcher) { matcher.take(beams); }, matcher_);
}

std::size_t Matcher::memory_bytes() const {
  return std::visit([](const auto& matcher) { return matcher.memory_bytes(); }, matcher_);
}

bool Matcher::is_blocked() const {
  return std::visit([](const auto& matcher) { return matcher.is_blocked(); }, matcher_);
}

ScanMatch Matcher::match(const ScrollingMap& map, const GaussianPose& predicted) {
  return std::visit([&](auto& matcher) { return matcher.match(map, predicted); }, matcher_);
}

}  // namespace cairn
