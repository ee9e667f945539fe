#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include "support/files.hpp"
#include "unit/clients/sample_map.hpp"
#include "wire/log_reader.hpp"

namespace cairn::clients {
namespace {

using test::content_of;
using test::TemporaryFolder;

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

/// The built program, run as people run it.
class CairnProgram : public ::testing::Test {
 protected:
  int run(const std::string& arguments) {
    const std::string command =
        std::string(CAIRN_PROGRAM) + " " + arguments + " >" + path("out") + " 2>" + path("err");
    const int status = std::system(command.c_str());
    out_ = content_of(path("out"));
    err_ = content_of(path("err"));
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  [[nodiscard]] std::string path(const char* name) const { return (folder_ / name).string(); }

  TemporaryFolder folder_;
  std::string out_;
  std::string err_;
};

TEST_F(CairnProgram, KeepsDataAndMessagesApart) {
  write_sample_map(path("m.cairn"));

  EXPECT_EQ(run("places " + path("m.cairn")), 0);
  EXPECT_THAT(out_, HasSubstr("0>4 1>2"));
  EXPECT_THAT(err_, IsEmpty());

  EXPECT_EQ(run("map --svg " + path("m.svg") + " " + path("m.cairn")), 0);
  EXPECT_THAT(out_, IsEmpty());
  EXPECT_THAT(err_, StartsWith("wrote "));
}

TEST_F(CairnProgram, TellsByItsExitStatusWhatWentWrong) {
  write_sample_map(path("m.cairn"));
  EXPECT_EQ(run("--version"), 0);
  EXPECT_EQ(run("places --frob"), 64);
  EXPECT_EQ(run("status /dev/null"), 65);
  EXPECT_EQ(run("status --lcm-url memq:// --timeout 0.1"), 69);
  EXPECT_EQ(run("watch --lcm-url memq:// --timeout 0.1"), 69);
  EXPECT_EQ(run("map --png /no/such/folder.png " + path("m.cairn")), 73);
  EXPECT_EQ(run("status --lcm-url nonsense://"), 78);
}

TEST_F(CairnProgram, WritesToAFullDiskAreNoticed) {
  write_sample_map(path("m.cairn"));
  const std::string command =
      std::string(CAIRN_PROGRAM) + " places " + path("m.cairn") + " >/dev/full";
  EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 73);
}

TEST_F(CairnProgram, ConvertsACarmenLog) {
  std::ofstream(path("a.clf")) << "# a robot that stands\n"
                                  "ODOM 1.0 2.0 0.5 0 0 0 10.000000 host 0.0\n"
                                  "FLASER 3 1.0 2.0 3.0 1.0 2.0 0.5 1.0 2.0 0.5 10.100000 host "
                                  "0.1\n";

  ASSERT_EQ(run("log convert " + path("a.clf") + " " + path("a.log")), 0) << err_;
  EXPECT_THAT(err_, HasSubstr("wrote 3 messages"));

  auto log = wire::LogReader::open(path("a.log"));
  ASSERT_TRUE(log);
  const auto first = log->next();
  ASSERT_TRUE(first);
  EXPECT_EQ(first->channel, "ODOMETRY");
  EXPECT_EQ(first->utime, 10'000'000);

  EXPECT_EQ(run("log inspect " + path("a.log")), 0);
  EXPECT_THAT(out_, HasSubstr("cairn_lcm.laser_scan_t"));
  EXPECT_EQ(run("log convert " + path("a.clf") + " " + path("a.clf")), 64);
  EXPECT_EQ(run("log inspect " + path("no.log")), 65);
}

TEST_F(CairnProgram, ReadsADamagedLogUpToTheDamage) {
  std::ofstream(path("a.clf")) << "ODOM 1.0 2.0 0.5 0 0 0 10.0 host 0.0\n"
                                  "ODOM 1.0 2.0 0.5 0 0 0 11.0 host 0.0\n";
  ASSERT_EQ(run("log convert " + path("a.clf") + " " + path("a.log")), 0);
  const std::string whole = content_of(path("a.log"));
  std::ofstream(path("cut.log"), std::ios::binary) << whole.substr(0, whole.size() - 5);

  EXPECT_EQ(run("log inspect " + path("cut.log")), 65);
  EXPECT_THAT(out_, HasSubstr("ODOMETRY"));
  EXPECT_THAT(err_, HasSubstr("damaged"));
}

}  // namespace
}  // namespace cairn::clients
