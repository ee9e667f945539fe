#include "wire/request.hpp"

#include <algorithm>
#include <utility>

namespace cairn::wire {

RequestRetry::Step RequestRetry::step(std::int64_t now_us) {
  if (tries_ > 0 && now_us < next_us_) {
    return Step::kWait;
  }
  if (tries_ >= options_.tries) {
    return Step::kGiveUp;
  }
  ++tries_;
  next_us_ = now_us + wait_us_;
  wait_us_ = std::min(static_cast<std::int64_t>(static_cast<double>(wait_us_) * options_.growth),
                      options_.longest_wait_us);
  return Step::kSend;
}

void RequestRetry::accepted(std::int64_t now_us) {
  tries_ = 1;
  wait_us_ = options_.longest_wait_us;
  next_us_ = now_us + wait_us_;
}

void RequestRetry::busy(std::int64_t now_us, std::int64_t retry_after_us) {
  tries_ = std::max(1, tries_ - 1);
  next_us_ = now_us + std::clamp<std::int64_t>(retry_after_us, options_.first_wait_us,
                                               10 * options_.longest_wait_us);
}

const ResultCache::Result* ResultCache::find(std::int64_t client_id,
                                             std::int32_t request_id) const {
  for (const Client& client : clients_) {
    if (client.id != client_id) {
      continue;
    }
    for (const Entry& entry : client.entries) {
      if (entry.request_id == request_id) {
        return &entry.result;
      }
    }
  }
  return nullptr;
}

void ResultCache::store(std::int64_t client_id, std::int32_t request_id, Result result) {
  const auto known = std::find_if(clients_.begin(), clients_.end(),
                                  [&](const Client& client) { return client.id == client_id; });
  Client client{client_id, {}};
  if (known != clients_.end()) {
    client = std::move(*known);
    clients_.erase(known);
  } else if (clients_.size() == kClients) {
    clients_.pop_front();
  }
  std::erase_if(client.entries, [&](const Entry& entry) { return entry.request_id == request_id; });
  if (client.entries.size() == kResultsPerClient) {
    client.entries.pop_front();
  }
  client.entries.push_back({request_id, std::move(result)});
  clients_.push_back(std::move(client));
}

}  // namespace cairn::wire
