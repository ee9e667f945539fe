#include "service/mapping_service.hpp"

#include <utility>

#include "base/check.hpp"
#include "service/pipeline.hpp"

namespace cairn {

MappingService::MappingService(const ServiceOptions& options, StageObserver observer)
    : pipeline_(std::make_unique<Pipeline>(options, std::move(observer))) {
  CAIRN_CHECK(validate(options).ok());
}

MappingService::~MappingService() = default;

Updates MappingService::absorb(const OdometrySample& sample) {
  pipeline_->join(sample);
  return pipeline_->perceive_joined();
}

Updates MappingService::absorb(LaserScan scan) {
  pipeline_->join(std::move(scan));
  return pipeline_->perceive_joined();
}

Updates MappingService::finish() {
  pipeline_->flush();
  Updates updates = pipeline_->perceive_joined();
  pipeline_->close_open_visits(&updates);
  return updates;
}

void MappingService::recall(PerceivedScan scan) {
  pipeline_->recall(std::move(scan));
}
Status MappingService::recall(Visit visit) {
  return pipeline_->recall(std::move(visit));
}
Updates MappingService::resume() {
  return pipeline_->resume();
}
std::shared_ptr<const MapState> MappingService::state() const {
  return pipeline_->state();
}
Result<std::shared_ptr<const MapState>> MappingService::state_of(std::int64_t hypothesis) const {
  return pipeline_->state_of(hypothesis);
}
std::int64_t MappingService::revision() const {
  return pipeline_->revision();
}
const Experience& MappingService::experience() const {
  return pipeline_->experience();
}
const HypothesisTree& MappingService::tree() const {
  return pipeline_->tree();
}
const OccupancyGrid& MappingService::local_map() const {
  return pipeline_->local_map();
}
const LocalisationHealth& MappingService::health() const {
  return pipeline_->health();
}
double MappingService::distinctiveness() const {
  return pipeline_->distinctiveness();
}

std::int64_t MappingService::local_map_restarts() const {
  return pipeline_->local_map_restarts();
}
const JoinerCounters& MappingService::joiner_counters() const {
  return pipeline_->joiner_counters();
}
const PlaceDetectorReport& MappingService::place_report() const {
  return pipeline_->place_report();
}
void MappingService::name_place_of(VisitId visit, const std::string& name) {
  pipeline_->name_place_of(visit, name);
}
Result<AssertionReport> MappingService::assert_places(VisitId a,
                                                      VisitId b,
                                                      bool is_same,
                                                      const Operator& by) {
  return pipeline_->assert_places(a, b, is_same, by);
}
Result<AssertionReport> MappingService::retract(int assertion, const Operator& by) {
  return pipeline_->retract(assertion, by);
}
std::optional<VisitId> MappingService::first_visit(int place) const {
  return pipeline_->first_visit(place);
}
GaussianPose MappingService::T_global_robot() const {
  return pipeline_->T_global_robot();
}

}  // namespace cairn
