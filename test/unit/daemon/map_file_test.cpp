#include "storage/map_file.hpp"

#include <filesystem>

#include <gmock/gmock.h>

#include "storage/journal_codec.hpp"
#include "support/experience.hpp"
#include "support/files.hpp"
#include "support/sqlite.hpp"

namespace cairn {
namespace {

using test::run_sql;

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class MapFileTest : public ::testing::Test {
 protected:
  [[nodiscard]] std::string path(const std::string& name = "a.cairn") const {
    return (folder_ / name).string();
  }

  static void write_journal(const std::string& file) {
    Result<MapFile> map = MapFile::open(file);
    ASSERT_TRUE(map.ok()) << map.error().message;
    for (int i = 0; i < 3; ++i) {
      ASSERT_TRUE(map->append(test::scan_at(i, Pose2(i, 0, 0), Pose2(1, 0, 0))).ok());
    }
    ASSERT_TRUE(map->append(Visit{test::corner_at({1, 0}), 1}).ok());
    ASSERT_TRUE(map->append(test::scan_at(3, Pose2(3, 0, 0), Pose2(1, 0, 0))).ok());
    ASSERT_TRUE(map->close().ok());
  }

  /// "s" for a scan, "v" for a visit, in the order read; the error's text at the end, if any.
  static std::vector<std::string> journal_of(const std::string& file) {
    std::vector<std::string> entries;
    Result<MapFile> map = MapFile::open(file);
    if (!map) {
      return {map.error().message};
    }
    const Status status =
        map->read_journal({[&](const PerceivedScan&) { entries.emplace_back("s"); },
                           [&](const Visit&) {
                             entries.emplace_back("v");
                             return Status();
                           },
                           [&](const OperatorOrder& order) {
                             entries.emplace_back("o" + std::to_string(order.request_id));
                             return Status();
                           }});
    if (!status) {
      entries.push_back(status.error().message);
    }
    return entries;
  }

  static OperatorOrder order(int request_id) {
    OperatorOrder order;
    order.kind = OperatorOrder::Kind::kDifferent;
    order.a = VisitId{0};
    order.b = VisitId{4};
    order.by = {"alice", time_of_utime(77)};
    order.client_id = 5;
    order.request_id = request_id;
    return order;
  }

  test::TemporaryFolder folder_;
};

TEST_F(MapFileTest, GivesTheJournalBackInItsOrder) {
  write_journal(path());
  EXPECT_THAT(journal_of(path()), ElementsAre("s", "s", "s", "v", "s"));
}

TEST_F(MapFileTest, WhatWasSeenOfAPlaceIsKeptBesideTheJournal) {
  write_journal(path());
  {
    Result<MapFile> map = MapFile::open(path());
    ASSERT_TRUE(map.ok());
    ASSERT_TRUE(map->append_perception(0, {1, 2, 3}).ok());
    ASSERT_TRUE(map->close().ok());
  }
  EXPECT_THAT(journal_of(path()), ElementsAre("s", "s", "s", "v", "s"));
  Result<MapFile> map = MapFile::open(path());
  EXPECT_THAT(*map->read_perception(0), ElementsAre(1, 2, 3));
  EXPECT_THAT(*map->read_perception(1), ::testing::IsEmpty());
}

TEST_F(MapFileTest, TheSameExperienceGivesTheSameBytes) {
  write_journal(path("a.cairn"));
  write_journal(path("b.cairn"));
  EXPECT_EQ(test::content_of(path("a.cairn")), test::content_of(path("b.cairn")));
  EXPECT_FALSE(std::filesystem::exists(path("a.cairn-wal")));
}

TEST_F(MapFileTest, IsNamedByItsFirstScanAndKeepsTheName) {
  write_journal(path());
  EXPECT_EQ(MapFile::open(path())->map_id(), 1'000'000);
}

TEST_F(MapFileTest, WhatWasRolledBackCanBeWrittenAgain) {
  Result<MapFile> map = MapFile::open(path());
  const PerceivedScan scan = test::scan_at(0, Pose2(), Pose2());
  ASSERT_TRUE(map->append(scan).ok());
  map->roll_back();
  EXPECT_EQ(map->scan_count(), 0);
  ASSERT_TRUE(map->append(scan).ok());
  ASSERT_TRUE(map->commit().ok());
  EXPECT_EQ(map->scan_count(), 1);
}

TEST_F(MapFileTest, KeepsNamesAndTakesThemAway) {
  write_journal(path());
  ASSERT_TRUE(MapFile::open(path())->write_name(0, "kitchen").ok());
  EXPECT_EQ(MapFile::open(path())->read_names()->at(0), "kitchen");
  ASSERT_TRUE(MapFile::open(path())->write_name(0, "").ok());
  EXPECT_TRUE(MapFile::open(path())->read_names()->empty());
}

TEST_F(MapFileTest, GivesOrdersBackWhereTheyWereMade) {
  {
    Result<MapFile> map = MapFile::open(path());
    ASSERT_TRUE(map->write_order(order(0)).ok());
    ASSERT_TRUE(map->append(test::scan_at(0, Pose2(), Pose2())).ok());
    ASSERT_TRUE(map->append(test::scan_at(1, Pose2(1, 0, 0), Pose2(1, 0, 0))).ok());
    ASSERT_TRUE(map->append(Visit{test::corner_at({1, 0}), 1}).ok());
    ASSERT_TRUE(map->write_order(order(1)).ok());
    ASSERT_TRUE(map->write_order(order(2)).ok());
    ASSERT_TRUE(map->append(test::scan_at(2, Pose2(2, 0, 0), Pose2(1, 0, 0))).ok());
    ASSERT_TRUE(map->write_order(order(3)).ok());
    ASSERT_TRUE(map->append(test::scan_at(3, Pose2(3, 0, 0), Pose2(1, 0, 0))).ok());
    ASSERT_TRUE(map->append(Visit{test::corner_at({3, 0}), 3}).ok());
    ASSERT_TRUE(map->commit().ok());
  }  // Not closed: as after kill -9.
  EXPECT_THAT(journal_of(path()),
              ElementsAre("o0", "s", "s", "v", "o1", "o2", "s", "o3", "s", "v"));
}

TEST_F(MapFileTest, KeepsAllThatAnOrderSays) {
  ASSERT_TRUE(MapFile::open(path())->write_order(order(9)).ok());
  OperatorOrder kept;
  ASSERT_TRUE(
      MapFile::open(path())
          ->read_journal({[](const PerceivedScan&) {}, [](const Visit&) { return Status(); },
                          [&](const OperatorOrder& read) {
                            kept = read;
                            return Status();
                          }})
          .ok());
  EXPECT_EQ(kept.kind, OperatorOrder::Kind::kDifferent);
  EXPECT_EQ(kept.a, VisitId{0});
  EXPECT_EQ(kept.b, VisitId{4});
  EXPECT_EQ(kept.by.who, "alice");
  EXPECT_EQ(kept.by.when, time_of_utime(77));
  EXPECT_EQ(kept.client_id, 5);
  EXPECT_EQ(kept.request_id, 9);
}

TEST_F(MapFileTest, AMapFromBeforeThereWereAssertionsIsTakenUp) {
  write_journal(path());
  run_sql(path(), "DROP TABLE assertion");
  EXPECT_THAT(journal_of(path()), ElementsAre("s", "s", "s", "v", "s"));
  ASSERT_TRUE(MapFile::open(path())->write_order(order(1)).ok());
  EXPECT_THAT(journal_of(path()), ElementsAre("s", "s", "s", "v", "s", "o1"));
}

TEST_F(MapFileTest, AnOrderOfNoKnownKindEndsTheJournal) {
  ASSERT_TRUE(MapFile::open(path())->write_order(order(1)).ok());
  run_sql(path(), "UPDATE assertion SET kind = 'perhaps'");
  EXPECT_THAT(journal_of(path()).back(), HasSubstr("assertion row 1 is damaged"));
}

TEST_F(MapFileTest, ADamagedRowEndsTheJournalWithItsName) {
  write_journal(path());
  run_sql(path(), "UPDATE scan SET bytes = x'00112233' WHERE number = 2");
  const std::vector<std::string> entries = journal_of(path());
  ASSERT_EQ(entries.size(), 3U);
  EXPECT_THAT(entries.back(), HasSubstr("scan 2 is damaged"));
}

TEST_F(MapFileTest, AMissingRowIsTold) {
  write_journal(path());
  run_sql(path(), "DELETE FROM scan WHERE number = 1");
  EXPECT_THAT(journal_of(path()).back(), HasSubstr("scan 1 is damaged: the row is missing"));
}

TEST_F(MapFileTest, RefusesWhatIsNoMap) {
  test::write_file(path("text"), "this is no database, and longer than a header of one: .........");
  EXPECT_EQ(MapFile::open(path("text")).error().code, ErrorCode::kMalformed);
  run_sql(path("other"), "CREATE TABLE cats(name)");
  EXPECT_THAT(MapFile::open(path("other")).error().message, HasSubstr("no cairn map"));
}

TEST_F(MapFileTest, RefusesANewerFormat) {
  write_journal(path());
  run_sql(path(), "UPDATE meta SET value = '99' WHERE key = 'format_version'");
  EXPECT_THAT(MapFile::open(path()).error().message, HasSubstr("map format 99"));
}

TEST_F(MapFileTest, IsHeldByOneAtATime) {
  const Result<MapFile> first = MapFile::open(path());
  const Result<MapFile> second = MapFile::open(path());
  ASSERT_TRUE(first.ok());
  ASSERT_FALSE(second.ok());
  EXPECT_THAT(second.error().message, HasSubstr("another cairnd holds this map file"));
}

TEST_F(MapFileTest, SaysThatAPathCannotBeWritten) {
  const Result<MapFile> map = MapFile::open(path("no/such/folder/a.cairn"));
  ASSERT_FALSE(map.ok());
  EXPECT_EQ(map.error().code, ErrorCode::kUnavailable);
  EXPECT_THAT(map.error().message, HasSubstr("there is no folder"));
}

}  // namespace
}  // namespace cairn
