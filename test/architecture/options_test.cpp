// Every option stands in four places: its default in code, config/cairnd.json, the schema, and
// docs/configuration.md. They must agree.

#include <gmock/gmock.h>

#include "runtime/daemon_options.hpp"
#include "support/files.hpp"

namespace cairn {
namespace {

using ::testing::HasSubstr;

const std::filesystem::path kSource = CAIRN_SOURCE_DIR;

TEST(Options, DefaultsAreTheConfigurationFile) {
  DaemonOptions options;
  EXPECT_EQ(describe(&options).write().dump(2) + "\n",
            test::content_of(kSource / "config/cairnd.json"))
      << "renew it: cairnd --dump-config > config/cairnd.json";
}

TEST(Options, TheSchemaIsTheOneInTheTree) {
  DaemonOptions options;
  EXPECT_EQ(describe(&options).schema().dump(2) + "\n",
            test::content_of(kSource / "config/cairnd.schema.json"))
      << "renew it: cairnd --dump-schema > config/cairnd.schema.json";
}

TEST(Options, TheTableIsInTheDocumentation) {
  DaemonOptions options;
  EXPECT_THAT(test::content_of(kSource / "docs/configuration.md"),
              HasSubstr(describe(&options).table()))
      << "renew it: cairnd --dump-options";
}

TEST(Options, DefaultsAreSound) {
  EXPECT_TRUE(validate(DaemonOptions()).ok());
}

TEST(Options, TheConfigurationFileReadsBackAsTheDefaults) {
  const Result<DaemonOptions> options =
      read_options(test::content_of(kSource / "config/cairnd.json"));
  ASSERT_TRUE(options.ok());
  DaemonOptions read = *options;
  DaemonOptions defaults;
  EXPECT_EQ(describe(&read).write(), describe(&defaults).write());
}

TEST(Options, AreAllOfThemReadFromTheFile) {
  DaemonOptions defaults;
  Json changed = describe(&defaults).write();
  changed["lpm"]["map"]["cell_m"] = 0.1;
  changed["topology"]["preference"] = "simplest";
  changed["inlets"]["lasers"] = {{{"channel", "FRONT"}, {"x_m", 0.25}}};
  const Result<DaemonOptions> options = read_options(changed.dump());
  ASSERT_TRUE(options.ok()) << options.error().message;
  EXPECT_EQ(options->service.lpm.map.cell_m, 0.1);
  EXPECT_EQ(options->service.topology.preference, Preference::kSimplest);
  ASSERT_EQ(options->lasers.size(), 1U);
  EXPECT_EQ(to_inlet_options(*options).lasers.front().T_robot_laser.x(), 0.25);
}

/// Sets every number of the configuration to a bound of its range in turn.
void expect_bounds_are_accepted(const Json& schema,
                                const Json& defaults,
                                const Json::json_pointer& at,
                                int* checked) {
  for (const auto& [key, property] : schema["properties"].items()) {
    const Json::json_pointer here = at / key;
    if (property["type"] == "object") {
      expect_bounds_are_accepted(property, defaults, here, checked);
      continue;
    }
    for (const char* const bound : {"minimum", "maximum"}) {
      if (property.contains(bound)) {
        Json changed = defaults;
        changed[here] = property[bound];
        if (property["type"] == "integer") {
          changed[here] = property[bound].get<std::int64_t>();
        }
        const Result<DaemonOptions> options = read_options(changed.dump());
        EXPECT_TRUE(options.ok()) << here.to_string() << ": " << options.error().message;
        ++*checked;
      }
    }
  }
}

TEST(Options, TheBoundsThatAreToldAreAccepted) {
  DaemonOptions options;
  int checked = 0;
  expect_bounds_are_accepted(describe(&options).schema(), describe(&options).write(),
                             Json::json_pointer(""), &checked);
  EXPECT_GT(checked, 100);
}

TEST(Options, UnknownAndOutOfRangeOnesAreToldInOneRound) {
  const Result<DaemonOptions> options =
      read_options(R"({"lpm": {"map": {"cell_m": -1}, "colour": 3}, "topology": 7})");
  ASSERT_FALSE(options.ok());
  EXPECT_THAT(options.error().message, HasSubstr("lpm.map.cell_m must be in [0.01, 0.5], is -1"));
  EXPECT_THAT(options.error().message, HasSubstr("lpm.colour is not an option"));
  EXPECT_THAT(options.error().message, HasSubstr("topology must be an object, is 7"));
}

TEST(Options, TextThatIsNoJsonIsToldWithItsPlace) {
  const Result<DaemonOptions> options = read_options("{\n \"lpm\": }");
  ASSERT_FALSE(options.ok());
  EXPECT_EQ(options.error().code, ErrorCode::kMalformed);
  EXPECT_THAT(options.error().message, HasSubstr("line 2"));
}

}  // namespace
}  // namespace cairn
