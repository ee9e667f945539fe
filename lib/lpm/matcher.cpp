#include "lpm/matcher.hpp"

namespace cairn {

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
