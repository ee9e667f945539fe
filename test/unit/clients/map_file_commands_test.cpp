#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sqlite3.h>

#include "clients/cairn/map_text.hpp"
#include "clients/cairn/program.hpp"
#include "support/files.hpp"
#include "support/program_run.hpp"
#include "support/sqlite.hpp"
#include "unit/clients/sample_map.hpp"

namespace cairn::clients {
namespace {

using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

using test::content_of;
using test::run_sql;
using test::TemporaryFolder;
using Outcome = test::ProgramRun;

Outcome run(const std::vector<std::string>& arguments) {
  return test::run_program(run_cairn, arguments);
}

class MapFileCommands : public ::testing::Test {
 protected:
  MapFileCommands() { write_sample_map(map_); }

  [[nodiscard]] std::string output(const char* name) const { return (folder_ / name).string(); }

  TemporaryFolder folder_;
  std::string map_ = (folder_ / "sample.cairn").string();
};

TEST_F(MapFileCommands, PlacesAreListedWithWhereTheirGatewaysLead) {
  const Outcome places = run({"places", map_});

  EXPECT_EQ(places.status, 0) << places.err;
  EXPECT_THAT(places.out, HasSubstr("0>4 1>2"));
  EXPECT_THAT(places.out, HasSubstr("0>3 1>1 2?"));
  EXPECT_THAT(places.out, HasSubstr("B\xC3\xBCro & Lab"));
  EXPECT_THAT(places.out, HasSubstr("5*"));
  EXPECT_THAT(places.err, IsEmpty());
}

TEST_F(MapFileCommands, ATravelAgainstTheMapIsNoLink) {
  cairn_lcm::topology_t topology = sample_topology();
  topology.segments.push_back(topology.segments[2]);
  topology.segments.back().to_place = 1;
  topology.segments.back().to_gateway = 1;
  topology.segments.back().is_broken = 1;
  topology.num_segments = 6;

  std::ostringstream out;
  print_places(out, topology);

  EXPECT_THAT(out.str(), HasSubstr("0>2 1>4!1"));
  EXPECT_THAT(out.str(), HasSubstr("0>4 1>2!3"));
}

TEST_F(MapFileCommands, JsonOfPlacesIsTheTopologyMessage) {
  const nlohmann::json json = nlohmann::json::parse(run({"places", "--json", map_}).out);

  ASSERT_EQ(json["places"].size(), 5U);
  EXPECT_EQ(json["places"][3]["gateways"][2]["is_pending"], true);
  EXPECT_EQ(json["places"][4]["name"], "B\xC3\xBCro & Lab");
  EXPECT_EQ(json["segments"].size(), 5U);
  EXPECT_EQ(json["probability"], 0.75);
}

TEST_F(MapFileCommands, ConsistencyNamesTheClosureThatIsInDoubt) {
  const Outcome consistency = run({"consistency", map_});
  EXPECT_EQ(consistency.status, 0) << consistency.err;
  EXPECT_THAT(consistency.out, HasSubstr("5 segments"));
  EXPECT_THAT(consistency.out, HasSubstr("2 of them checked"));
  EXPECT_THAT(consistency.out, HasSubstr("1 of 2 disagree"));
  EXPECT_THAT(consistency.out,
              HasSubstr("4.2  travel to visit 5, where place 1 was found again: that closure is in "
                        "doubt"));
  EXPECT_THAT(consistency.out, HasSubstr("0.7  travel to visit 1\n"));
  EXPECT_LT(consistency.out.find("visit 5"), consistency.out.find("visit 1\n"));
}

TEST_F(MapFileCommands, ConsistencyAsJsonListsTheWorstFirst) {
  const Outcome consistency = run({"consistency", map_, "--json"});
  EXPECT_EQ(consistency.status, 0) << consistency.err;
  const auto json = nlohmann::json::parse(consistency.out);
  EXPECT_EQ(json["num_segments"], 5);
  ASSERT_EQ(json["segments"].size(), 2U);
  EXPECT_EQ(json["segments"][0]["place_found_again"], 1);
  EXPECT_DOUBLE_EQ(json["segments"][0]["disagreement_sigmas"].get<double>(), 4.2);
  EXPECT_EQ(json["segments"][1]["place_found_again"], -1);
}

TEST_F(MapFileCommands, HypothesesSayWhetherTheGuaranteeHolds) {
  const Outcome hypotheses = run({"hypotheses", map_});

  EXPECT_EQ(hypotheses.status, 0);
  EXPECT_THAT(hypotheses.out, HasSubstr("0.7500        -10.500"));
  EXPECT_THAT(hypotheses.out, HasSubstr("2 live after 9 visits, 17 waiting, 41 refuted"));
  EXPECT_THAT(hypotheses.out, HasSubstr("guarantee kept"));
  EXPECT_THAT(hypotheses.out, HasSubstr("blamed    visit 4: misread star"));
}

TEST_F(MapFileCommands, AssertionsAreReadFromTheJournal) {
  EXPECT_THAT(run({"assertions", map_}).out, HasSubstr("nothing was ever asserted"));
  run_sql(
      map_,
      "CREATE TABLE assertion(step INTEGER PRIMARY KEY, after_scan INTEGER, after_visit INTEGER,"
      "  utime INTEGER, who TEXT, kind TEXT, visit_a INTEGER, visit_b INTEGER,"
      "  assertion INTEGER, client_id INTEGER, request_id INTEGER);"
      "INSERT INTO assertion VALUES (1, 9, 3, 1700000000000000, 'alice', 'same', 0, 2, 0, 7, 1),"
      "  (2, 9, 3, 1700000060000000, 'bob', 'retract', -1, -1, 1, 7, 2),"
      "  (3, 9, 3, 1700000060000001, 'eve' || char(27), 'different', 1, 2, 0, 7, 3);");

  const Outcome audit = run({"assertions", map_});
  EXPECT_EQ(audit.status, 0) << audit.err;
  EXPECT_THAT(
      audit.out,
      HasSubstr("1  visit 0 is the same place as visit 2; alice, 2023-11-14T22:13:20Z, after "
                "3 visits; taken back"));
  EXPECT_THAT(audit.out, HasSubstr("taken back by bob, 2023-11-14T22:14:20Z"));
  EXPECT_THAT(audit.out, HasSubstr("2  visit 1 is another place than visit 2; eve?,"));
  const nlohmann::json json = nlohmann::json::parse(run({"assertions", "--json", map_}).out);
  EXPECT_EQ(json["assertions"][0]["is_in_force"], false);
  EXPECT_EQ(json["assertions"][1]["is_in_force"], true);

  run_sql(map_, "UPDATE assertion SET assertion = 5 WHERE kind = 'retract'");
  EXPECT_EQ(run({"assertions", map_}).status, 65);
}

TEST_F(MapFileCommands, StatusCountsDocumentsAndJournal) {
  const Outcome status = run({"status", map_});
  EXPECT_EQ(status.status, 0);
  EXPECT_THAT(status.out,
              AllOf(HasSubstr("map_id = 7"), HasSubstr("5 places, 5 paths"),
                    HasSubstr("visit: 3 rows"), HasSubstr("trajectory at revision 31")));

  const nlohmann::json json = nlohmann::json::parse(run({"status", "--json", map_}).out);
  EXPECT_EQ(json["journal"], nlohmann::json({{"visit", 3}}));
  EXPECT_EQ(json["documents"]["global_map"]["revision"], 31);
}

TEST_F(MapFileCommands, ReadingLeavesNoFilesBesideTheMap) {
  run({"status", map_});
  EXPECT_EQ(run({"places", map_}).status, 0);

  EXPECT_FALSE(std::filesystem::exists(map_ + "-wal"));
  EXPECT_FALSE(std::filesystem::exists(map_ + "-shm"));
}

TEST_F(MapFileCommands, AMapThatADaemonHasOpenShowsWhatItLastSaved) {
  sqlite3* daemon = nullptr;
  ASSERT_EQ(sqlite3_open(map_.c_str(), &daemon), SQLITE_OK);
  // The first stays in the write-ahead log; the second is not committed.
  ASSERT_EQ(sqlite3_exec(daemon,
                         "INSERT INTO visit VALUES (4); BEGIN IMMEDIATE;"
                         "INSERT INTO visit VALUES (5)",
                         nullptr, nullptr, nullptr),
            SQLITE_OK);

  const Outcome status = run({"status", map_});
  sqlite3_close(daemon);

  EXPECT_EQ(status.status, 0) << status.err;
  EXPECT_THAT(status.out, HasSubstr("visit: 4 rows"));
}

TEST_F(MapFileCommands, TrajectoryKeepsTheMicrosecondsOfTheLog) {
  ASSERT_EQ(run({"export", "--trajectory", output("t.txt"), map_}).status, 0);

  const std::string text = content_of(output("t.txt"));
  EXPECT_THAT(text, StartsWith("1700000000.000001 0.000000000 0.000000000 0.300000000\n"
                               "1700000000.100001 0.100000000 "));
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 251);
}

TEST_F(MapFileCommands, CovariancesAreThoseOfTheKeyScans) {
  const std::string file = output("covariances.txt");
  EXPECT_EQ(run({"export", map_, "--covariances", file}).status, 0);
  const std::string text = content_of(file);
  EXPECT_THAT(text, StartsWith("# t xx xy yy x-theta y-theta theta-theta\n"));
  EXPECT_THAT(text, HasSubstr(" 0.010000000000 0.002000000000 0.020000000000 0.000000000000 "
                              "0.000000000000 0.003000000000\n"));
}

TEST_F(MapFileCommands, GridForRosIsFlippedAndHasItsOriginBesideIt) {
  ASSERT_EQ(run({"map", "--pgm", output("m.pgm"), map_}).status, 0);

  const std::string pgm = content_of(output("m.pgm"));
  // The walls stand one cell outside of the floor: 29 m by 14 m of it.
  EXPECT_THAT(pgm, StartsWith("P5\n582 282\n255\n"));
  const std::string pixels = pgm.substr(15);
  ASSERT_EQ(pixels.size(), 582U * 282U);
  EXPECT_EQ(pixels[0], '\0') << "the wall at the upper left";
  EXPECT_EQ(static_cast<unsigned char>(pixels[582 * 5 + 5]), 254) << "the corridor inside";
  EXPECT_EQ(static_cast<unsigned char>(pixels[582 * 100 + 200]), 205) << "within the loop";
  EXPECT_THAT(content_of(output("m.yaml")),
              AllOf(HasSubstr("image: m.pgm\n"), HasSubstr("resolution: 0.050000\n"),
                    HasSubstr("origin: [-1.050000, -3.050000, 0.0]\n")));
}

TEST_F(MapFileCommands, PictureIsAPngOfTheSizeAskedFor) {
  ASSERT_EQ(run({"map", "--png", output("m.png"), "--pixels", "800", "--trajectory", map_}).status,
            0);

  const std::string png = content_of(output("m.png"));
  EXPECT_THAT(png, StartsWith("\x89PNG\r\n\x1A\n"));
  EXPECT_EQ(png.substr(16, 4), std::string({0, 0, 3, 32})) << "width 800";
}

TEST_F(MapFileCommands, PicturesOfPlacesShowTheVisitOfTheMapOrAll) {
  const Outcome best = run({"places", "--png", output("best"), "--json", map_});
  EXPECT_EQ(best.status, 0) << best.err;
  EXPECT_THAT(best.err, HasSubstr("wrote 5 pictures to "));
  const nlohmann::json json = nlohmann::json::parse(best.out);
  ASSERT_EQ(json["pictures"].size(), 5U);
  EXPECT_EQ(json["pictures"][4]["place"], 5);
  EXPECT_EQ(json["pictures"][4]["visit"], 4);
  for (int place = 1; place <= 5; ++place) {
    const std::string png = content_of(output("best") + "/place-" + std::to_string(place) + ".png");
    EXPECT_THAT(png, StartsWith("\x89PNG\r\n\x1A\n"));
    EXPECT_EQ(png.substr(16, 4), std::string({0, 0, 3, static_cast<char>(132)})) << "width 900";
  }

  const Outcome all = run({"places", "--png", output("all"), "--all", map_});
  EXPECT_THAT(all.err, HasSubstr("wrote 6 pictures to "));
  EXPECT_TRUE(std::filesystem::exists(output("all") + "/place-1-visit-5.png"));
}

TEST_F(MapFileCommands, PicturesOfPlacesNeedAFolderAndPlaces) {
  std::ofstream(output("taken")) << "a file";
  const Outcome taken = run({"places", "--png", output("taken"), map_});
  EXPECT_EQ(taken.status, 73);
  EXPECT_THAT(taken.err, HasSubstr("taken is a file, and no folder to write into"));
  EXPECT_EQ(run({"places", "--png", "/dev/null/folder", map_}).status, 73);
  EXPECT_EQ(run({"places", "--all", map_}).status, 64);
  EXPECT_EQ(run({"map", "--places", "--svg", output("x.svg"), map_}).status, 64);

  run_sql(map_, "DELETE FROM perception WHERE visit = 3");
  EXPECT_THAT(run({"places", "--png", output("p"), map_}).err,
              HasSubstr("does not hold what was seen at visit 3"));
  run_sql(map_, "DROP TABLE perception");
  const Outcome old = run({"places", "--png", output("p"), map_});
  EXPECT_EQ(old.status, 65);
  EXPECT_THAT(old.err, HasSubstr("made by an earlier cairnd"));
}

TEST_F(MapFileCommands, ThePictureOfTheMapCanShowWhatWasSeenOfPlaces) {
  ASSERT_EQ(run({"map", "--png", output("plain.png"), map_}).status, 0);
  const Outcome seen = run({"map", "--png", output("seen.png"), "--places", map_});
  EXPECT_EQ(seen.status, 0) << seen.err;
  EXPECT_NE(content_of(output("seen.png")), content_of(output("plain.png")));
}

TEST_F(MapFileCommands, GraphFilesNameEveryPlaceAndEdge) {
  ASSERT_EQ(run({"export", "--dot", output("m.dot"), "--graphml", output("m.graphml"),
                 "--topology-svg", output("m.svg"), map_})
                .status,
            0);

  EXPECT_THAT(content_of(output("m.dot")),
              AllOf(HasSubstr("1 -- 2 [taillabel=\"1\", headlabel=\"2\""), EndsWith("}\n")));
  EXPECT_THAT(content_of(output("m.graphml")),
              AllOf(HasSubstr("<node id=\"p5\">"), HasSubstr("B\xC3\xBCro &amp; Lab"),
                    HasSubstr("<edge source=\"p2\" target=\"p5\">")));
  EXPECT_THAT(content_of(output("m.svg")),
              AllOf(HasSubstr("<title>place 5 B\xC3\xBCro &amp; Lab: [1+ 2-]</title>"),
                    HasSubstr("class=\"pending\""), HasSubstr(" m</text>")));
}

TEST_F(MapFileCommands, TheBestHypothesisByItsNumberIsTheMapOfTheFile) {
  const auto draw = [&](const char* name, std::vector<std::string> more) {
    more.insert(more.begin(), {"map", "--trajectory", "--png", output(name), map_});
    return run(more);
  };
  ASSERT_EQ(draw("best.png", {}).status, 0);
  const Outcome third = draw("3.png", {"--hypothesis", "3"});
  EXPECT_EQ(third.status, 0) << third.err;
  EXPECT_EQ(content_of(output("3.png")), content_of(output("best.png")));
}

TEST_F(MapFileCommands, AnotherHypothesisNeedsADaemonAndAnUnknownOneIsSaidToBeThat) {
  const Outcome other = run({"map", "--hypothesis", "8", "--png", output("8.png"), map_});
  EXPECT_EQ(other.status, 65);
  EXPECT_THAT(other.err, AllOf(HasSubstr("best hypothesis only, which is 3, not that of 8"),
                               HasSubstr("run cairnd --map with this file")));
  EXPECT_FALSE(std::filesystem::exists(output("8.png")));

  const Outcome unknown = run({"map", "--hypothesis", "99", "--png", output("99.png"), map_});
  EXPECT_EQ(unknown.status, 65);
  EXPECT_THAT(unknown.err, HasSubstr("no live hypothesis 99; expected one of 3, 8"));
}

TEST_F(MapFileCommands, PlanningFromAFileSaysThatItNeedsADaemon) {
  const Outcome path = run({"path", "--to", "3", map_});

  EXPECT_EQ(path.status, 69);
  EXPECT_THAT(path.err, HasSubstr("planning needs a running daemon: start `cairnd --map "));
}

TEST_F(MapFileCommands, OneFileIsNotWrittenTwice) {
  const Outcome map = run({"map", map_, "--png", output("same"), "--svg", output("same")});
  EXPECT_EQ(map.status, 64);
  EXPECT_THAT(map.err, HasSubstr("is to be written twice"));
}

TEST_F(MapFileCommands, AFileThatIsNoMapIsBadData) {
  std::ofstream(output("notes.txt")) << "Not a database, but long enough to look at: " << map_;
  run_sql(output("other.db"), "CREATE TABLE meta (key TEXT PRIMARY KEY, value TEXT)");
  run_sql(output("future.db"),
          "CREATE TABLE meta (key TEXT PRIMARY KEY, value TEXT);"
          "INSERT INTO meta VALUES ('application', 'cairn'), ('format_version', '4')");

  for (const auto& [name, reason] :
       std::map<std::string, std::string>{{"notes.txt", "is no cairn map"},
                                          {"other.db", "is no cairn map"},
                                          {"future.db", "format 4; this program reads format 3"},
                                          {"missing.db", "there is no such file"},
                                          {"", "expected a file, got a folder"}}) {
    const Outcome status = run({"status", output(name.c_str())});
    EXPECT_EQ(status.status, 65) << name;
    EXPECT_THAT(status.err, HasSubstr(reason));
    EXPECT_EQ(std::count(status.err.begin(), status.err.end(), '\n'), 1) << status.err;
  }
}

TEST_F(MapFileCommands, ADamagedDocumentIsBadDataAndTheOthersStillRead) {
  run_sql(map_,
          "UPDATE document SET bytes = x'28B52FFD2001000041' WHERE what = 1;"
          "DELETE FROM document WHERE what = 2");

  EXPECT_EQ(run({"places", map_}).status, 65);
  EXPECT_THAT(run({"hypotheses", map_}).err, HasSubstr("holds no list of hypotheses"));
  EXPECT_EQ(run({"export", "--trajectory", output("t.txt"), map_}).status, 0);
}

TEST_F(MapFileCommands, TruncationAtAnyPointIsNeverMoreThanAnError) {
  const std::string whole = content_of(map_);
  for (std::size_t size = 0; size < whole.size(); size += 1 + whole.size() / 23) {
    std::ofstream(output("cut.cairn"), std::ios::binary) << whole.substr(0, size);
    // Stored last, so that every cut hits it.
    EXPECT_EQ(run({"export", "--trajectory", output("t.txt"), output("cut.cairn")}).status, 65)
        << size;
  }
}

TEST_F(MapFileCommands, OutputThatCannotBeWrittenIsItsOwnError) {
  EXPECT_EQ(run({"map", "--png", output("no/such/folder.png"), map_}).status, 73);
}

TEST_F(MapFileCommands, WrongCommandLinesAreUsageErrors) {
  EXPECT_EQ(run({}).status, 64);
  EXPECT_EQ(run({"frobnicate"}).status, 64);
  EXPECT_EQ(run({"places", "--frob", map_}).status, 64);
  EXPECT_EQ(run({"map", map_}).status, 64) << "no output named";
  EXPECT_EQ(run({"map", "--svg", output("x.svg"), "--trajectory", map_}).status, 64);
  EXPECT_EQ(run({"watch", "--count", "0"}).status, 64);
  EXPECT_EQ(run({"path", "--to", "nan,1", map_}).status, 64);
}

TEST_F(MapFileCommands, HelpAndVersionAreData) {
  for (const char* command :
       {"status", "watch", "places", "hypotheses", "map", "path", "export", "log"}) {
    const Outcome help = run({command, "--help"});
    EXPECT_EQ(help.status, 0);
    EXPECT_THAT(help.out, HasSubstr("Usage:"));
    EXPECT_THAT(help.err, IsEmpty());
  }
  EXPECT_THAT(run({"--version"}).out, StartsWith("cairn 0."));
}

TEST_F(MapFileCommands, NamesCannotWriteToTheTerminal) {
  run_sql(map_, "INSERT INTO meta VALUES ('note', char(27) || ']0;owned' || char(7))");

  EXPECT_THAT(run({"status", map_}).out, AllOf(HasSubstr("?]0;owned?"), Not(HasSubstr("\x1B"))));
}

}  // namespace
}  // namespace cairn::clients
