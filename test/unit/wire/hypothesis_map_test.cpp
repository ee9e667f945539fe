// Maps of single hypotheses: documents that are made on request, of which several are about.

#include <memory>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "wire/document.hpp"
#include "wire/replication_client.hpp"
#include "wire/replication_server.hpp"

namespace cairn::wire {
namespace {

using Request = cairn_lcm::snapshot_request_t;
using ::testing::Each;
using ::testing::IsEmpty;

constexpr std::int64_t kSecond = 1'000'000;

class HypothesisMaps : public ::testing::Test {
 protected:
  void make_fetch(std::int64_t hypothesis_id) {
    ReplicationRequests requests;
    requests.client_id = 1 + hypothesis_id;
    requests.send_snapshot_request = [this](const Request& request) { asked_.push_back(request); };
    fetches_.push_back(
        std::make_unique<DocumentFetch>(Request::HYPOTHESIS_MAP, 0, requests, hypothesis_id));
  }
  void tick() {
    now_us_ += 20'000;
    for (const auto& fetch : fetches_) {
      fetch->tick(now_us_, now_us_);
    }
  }
  void hand_out(int times) {
    for (int i = 0; i < times; ++i) {
      now_us_ += 10'000;
      server_.pump(now_us_, now_us_);
    }
  }
  static Request request_of(std::int64_t hypothesis_id) {
    Request request{};
    request.what = Request::HYPOTHESIS_MAP;
    request.hypothesis_id = hypothesis_id;
    return request;
  }
  static Document document_of(std::uint8_t hypothesis) {
    return {42, 7, Bytes(100'000, hypothesis)};
  }

  std::int64_t now_us_ = kSecond;
  std::vector<Request> asked_;
  std::vector<std::unique_ptr<DocumentFetch>> fetches_;
  ReplicationServer server_{9,
                            [this](const cairn_lcm::snapshot_chunk_t& chunk) {
                              for (const auto& fetch : fetches_) {
                                fetch->on_chunk(now_us_, chunk);
                              }
                            },
                            [](const cairn_lcm::map_delta_t&) {}};
};

TEST_F(HypothesisMaps, EachClientGetsTheOneItAskedForThoughTheyComeTogether) {
  make_fetch(3);
  make_fetch(8);
  tick();
  ASSERT_EQ(asked_.size(), 2U);
  EXPECT_EQ(asked_[1].hypothesis_id, 8);

  server_.offer_hypothesis_map(now_us_, 8, document_of(8));
  server_.offer_hypothesis_map(now_us_, 3, document_of(3));
  hand_out(20);

  for (const auto& fetch : fetches_) {
    ASSERT_EQ(fetch->state(), DocumentFetch::State::kDone);
  }
  EXPECT_THAT(fetches_[0]->document(), Each(3));
  EXPECT_THAT(fetches_[1]->document(), Each(8));
}

TEST_F(HypothesisMaps, AreHandedOutAgainAsLongAsTheyAreYoungAndTheMapsStay) {
  EXPECT_FALSE(server_.on_request(now_us_, request_of(3)));
  server_.offer_hypothesis_map(now_us_, 3, document_of(3));

  EXPECT_TRUE(server_.on_request(now_us_ + 4 * kSecond, request_of(3)));
  EXPECT_FALSE(server_.on_request(now_us_ + 4 * kSecond, request_of(8)));
  EXPECT_FALSE(server_.on_request(now_us_ + 6 * kSecond, request_of(3)));

  server_.offer_hypothesis_map(now_us_, 3, document_of(3));
  server_.documents_changed();
  EXPECT_FALSE(server_.on_request(now_us_, request_of(3)));
}

TEST_F(HypothesisMaps, AClientWaitsForAsLongAsItHearsThatTheDaemonWorks) {
  make_fetch(3);
  for (int i = 0; i < 3'000; ++i) {
    tick();
    fetches_[0]->accepted();
  }
  EXPECT_EQ(fetches_[0]->state(), DocumentFetch::State::kAsking);
  for (int i = 0; i < 3'000; ++i) {
    tick();
  }
  EXPECT_EQ(fetches_[0]->state(), DocumentFetch::State::kFailed);
  EXPECT_THAT(fetches_[0]->document(), IsEmpty());
}

}  // namespace
}  // namespace cairn::wire
